#!/usr/bin/env python3
"""Runs recorded fits anew and compares what they leave with what they left when they were recorded.

    tests/recorded_fits/recorded_fits.py --program build/bin/espalier [--only GLOB] [--part 1/4] [--jobs N]
    tests/recorded_fits/recorded_fits.py --program build/bin/espalier --record

fits.csv holds the arguments of short fits of pictures in targets/. runs/ holds what version 0.1.0 left of some runs
(run.toml, the log of evaluations, branches.json: all that resuming needs); each is resumed, with the arguments in
runs.csv, and repeated. `interrupted` was stopped by Ctrl-C in its finish, `killed` in its search, the last
record of its log torn; the others had ended. The pictures in their run.toml are names, and fits run in targets/.

Two digests are compared of every one: fitted, of the numbers (trees, measures, every evaluation, the rounds of
branches, the archive), and drawn, of the pixels of all pictures and of the charts. Left out is what differs between
two runs of one program: seconds, versions, and directories of pictures; and the count of pixels in which Embree
disagrees, which depends on the vectors that Embree chooses. Comments in TOML files are not compared.

The digests do not depend on the number of threads, on the vectors that Highway and Embree choose (SSE2 to AVX-512), or
on the processor and the version of the C library, whose exp, log and pow Espalier does not use (src/libm). They were
the same with GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-AVX and so on, of which ctest runs a fifth.

Version 0.1.0 used the C library's functions, so its candidates differ in last bits, and today's program refuses to go
on with its logs. The logs and branches.json in runs/ are therefore of today's candidates, in version 0.1.0's format.

A digest that differs means that the same command gives another tree than before. Record anew only where that is
meant, and write the reason into the commit message. Never record anew to make a restructuring pass."""

import argparse
import concurrent.futures
import csv
import dataclasses
import fnmatch
import hashlib
import json
import pathlib
import shlex
import shutil
import struct
import subprocess
import sys
import tempfile
import tomllib
import zlib

HERE = pathlib.Path(__file__).resolve().parent
TARGETS = HERE.parents[1] / "targets"  # where fits run: pictures go by their names
DIGESTS = ["fitted", "drawn"]
VARYING_KEYS = {"seconds", "evaluations_per_second", "embree_disagreement_pixels"}
LATER_KEYS = {"plant", "labels", "resembles", "confidence", "check"}  # of summary.json, in no run when these were recorded; nor was tree.png, nor a preset's seed; check is of branches.json
LATER_FILES = {"tree.png", "lock"}
LATER_STEM = "picture"  # copies of what was fitted: picture.png, picture_2.jpg
HEX_DIGITS = 16


# What a run directory holds, without what varies.


def without_varying(data):
    """Of JSON: the same without seconds and the like, and pictures by their names."""
    if isinstance(data, list):
        return [without_varying(value) for value in data]
    if not isinstance(data, dict):
        return data
    kept = {key: without_varying(value) for key, value in data.items() if key not in VARYING_KEYS | LATER_KEYS}
    if "pictures" in kept:
        kept["pictures"] = [pathlib.PurePath(picture).name for picture in kept["pictures"]]
    return kept


RECORDED_METRICS = ["pixel_accuracy", "iou", "dice", "tolerant_iou", "outline_iou", "truncated_distance", "gap_iou"]
LATER_METRICS = {"full_size": ["pixel_accuracy", "dice"], "without_training": ["pixel_accuracy", "dice"]}


def as_recorded(data):
    """Of JSON: measures as they were written when the digests were made, in branches.json without their names, and
    two fewer in parts of summary.json."""
    if isinstance(data, list):
        return [as_recorded(value) for value in data]
    if not isinstance(data, dict):
        return data
    kept = {key: as_recorded(value) for key, value in data.items()}
    if isinstance(kept.get("metrics"), dict):
        kept["metrics"] = [kept["metrics"][name] for name in RECORDED_METRICS]
    for part, names in LATER_METRICS.items():
        for name in names if part in kept else []:
            kept[part].pop(name, None)
    return kept


def canonical(data):
    """One text for one value, whatever its layout was; numbers keep all their bits."""
    return json.dumps(data, sort_keys=True).encode()


def json_content(path):
    return canonical(as_recorded(without_varying(json.loads(path.read_text()))))


def preset_content(path):
    preset = tomllib.loads(path.read_text())
    preset.pop("seed", None)
    if "description" in preset:
        preset["description"] = preset["description"].split(";")[0]  # then: what it needs beyond its species
    return canonical(preset)


def record_content(path):
    """Of run.toml only how the run ended: the rest was given, not found."""
    return canonical(tomllib.loads(path.read_text()).get("outcome"))


def counted_as_recorded(row):
    """Of a row of trace.csv: branch steps were evaluations when the digests were made."""
    steps = row.pop("branch_steps", None)
    if steps is not None:
        row["evaluations"] = str(int(row["evaluations"]) + int(steps))
    return row


def table_content(path):
    with path.open(newline="") as file:
        table = [counted_as_recorded(row) for row in csv.DictReader(file)]
    return canonical([[row[name] for name in row if name not in VARYING_KEYS] for row in table])


def evaluations_content(path):
    """Value and hash of every candidate; the four bytes between them are seconds. Since format 2 a number and a check
    follow."""
    log = path.read_bytes()
    record = "<8s4x4s" if log[:8] == b"espfit01" else "<8s4x4s8x"
    return b"".join(value + candidate for value, candidate in struct.iter_unpack(record, log[8:]))


def png_content(path):
    """Size, kind and filtered pixels: neither the compression nor the text chunks."""
    content, pixels, position = path.read_bytes(), b"", 8
    while position < len(content):
        length, kind = struct.unpack_from(">I4s", content, position)
        chunk = content[position + 8 : position + 8 + length]
        if kind == b"IHDR":
            header = chunk
        elif kind == b"IDAT":
            pixels += chunk
        position += 12 + length
    return header + zlib.decompress(pixels)


CONTENTS = [  # pattern of the file's name, digest it belongs to, what of it counts
    ("run.toml", "fitted", record_content),
    ("*.toml", "fitted", preset_content),
    ("*.json", "fitted", json_content),
    ("*.csv", "fitted", table_content),
    ("evaluations.bin", "fitted", evaluations_content),
    ("*.png", "drawn", png_content),
    ("*.svg", "drawn", pathlib.Path.read_bytes),
]


def kind_of(path):
    """The digest that a file belongs to, and what of it counts."""
    for pattern, digest, content in CONTENTS:
        if fnmatch.fnmatch(path.name, pattern):
            return digest, content
    raise ValueError(f"{path.name}: got a file that no digest knows, expected one of CONTENTS")


def is_compared(path):
    return path.is_file() and path.name not in LATER_FILES and path.stem.split("_")[0] != LATER_STEM


def digests_of(directory):
    """Both digests of a run directory: of all its files, in the order of their names."""
    hashes = {name: hashlib.sha256() for name in DIGESTS}
    for path in sorted(path for path in directory.rglob("*") if is_compared(path)):
        digest, content = kind_of(path)
        part = hashlib.sha256(content(path)).hexdigest()
        hashes[digest].update(f"{path.relative_to(directory)} {part}\n".encode())
    return {name: value.hexdigest()[:HEX_DIGITS] for name, value in hashes.items()}


# What is run.


@dataclasses.dataclass
class Check:
    """One command, and the row of a table that says what it should leave."""

    name: str
    row: dict
    prefix: str = ""  # of the columns in the row
    run: str = ""  # that is resumed or repeated; none: a fit of its own
    arguments: list = dataclasses.field(default_factory=list)


def read_table(name):
    with (HERE / name).open(newline="") as file:
        return list(csv.DictReader(file))


def write_table(name, rows):
    with (HERE / name).open("w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def checks_of(fits, runs):
    checks = [Check(row["name"], row, arguments=shlex.split(row["arguments"])) for row in fits]
    for row in runs:
        resumed = shlex.split(row["resume_arguments"])
        checks.append(Check(f"resume_{row['name']}", row, "resumed_", row["name"], resumed))
        checks.append(Check(f"repeat_{row['name']}", row, "repeated_", row["name"]))
    return checks


def chosen(checks, pattern, part):
    """Those whose name fits, and of them every N-th: a part has long and short ones."""
    first, step = (int(number) for number in part.split("/"))
    return [check for check in checks if fnmatch.fnmatch(check.name, pattern)][first - 1 :: step]


def fit_arguments(check, directory):
    """Arguments of `espalier fit` after which `directory` holds what is to be compared."""
    if not check.run:
        return [*check.arguments, "--out", directory]
    run = HERE / "runs" / check.run
    if check.prefix == "repeated_":
        return ["--repeat", run, "--out", directory]
    shutil.copytree(run, directory)
    return ["--resume", directory, *check.arguments]


def outcome_of(check, program, folder):
    """The digests of what the command leaves, or the last line of what it says when it fails."""
    directory = folder / check.name
    arguments = fit_arguments(check, directory)
    threads = [] if "--threads" in arguments else ["--threads", "1"]
    done = subprocess.run(
        [program, "fit", *arguments, *threads, "--quiet"], cwd=TARGETS, capture_output=True, text=True
    )
    if done.returncode != 0:
        said = (done.stderr or done.stdout).strip().splitlines()
        return said[-1] if said else f"exit status {done.returncode}"
    return digests_of(directory)


def outcomes_of(checks, program, folder, jobs):
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        return list(pool.map(lambda check: outcome_of(check, program, folder), checks))


# What is made of it.


def difference(check, got):
    """A line that says how an outcome differs from the recorded one; empty where it does not."""
    expected = {name: check.row[check.prefix + name] for name in DIGESTS}
    if isinstance(got, str):
        return f"{check.name}: got an error ({got}), expected a fit"
    parts = [f"{name} {got[name]}, expected {expected[name]}" for name in DIGESTS if got[name] != expected[name]]
    return f"{check.name}: got {'; '.join(parts)}" if parts else ""


def compare(checks, outcomes):
    lines = [difference(check, got) for check, got in zip(checks, outcomes)]
    differing = [line for line in lines if line]
    print(*differing, f"{len(checks) - len(differing)} of {len(checks)} as recorded", sep="\n")
    return 1 if differing or not checks else 0


def record(checks, outcomes, fits, runs):
    for check, got in zip(checks, outcomes):
        if isinstance(got, str):
            print(f"{check.name}: {got}; nothing is recorded")
            return 1
        check.row.update({check.prefix + name: got[name] for name in DIGESTS})
    write_table("fits.csv", fits)
    write_table("runs.csv", runs)
    print(f"{len(checks)} recorded")
    return 0


def read_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=pathlib.Path, required=True, help="the espalier to check")
    parser.add_argument("--only", default="*", metavar="GLOB", help="names of fits, resume_RUN and repeat_RUN")
    parser.add_argument("--part", default="1/1", metavar="I/N", help="every N-th of them, from the I-th")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="fits at a time")
    parser.add_argument("--record", action="store_true", help="write the digests instead of comparing them")
    parser.add_argument("--keep", type=pathlib.Path, metavar="DIRECTORY", help="leave what was run there")
    return parser.parse_args()


def main():
    arguments = read_arguments()
    fits, runs = read_table("fits.csv"), read_table("runs.csv")
    checks = chosen(checks_of(fits, runs), arguments.only, arguments.part)
    with tempfile.TemporaryDirectory() as temporary:
        folder = arguments.keep.resolve() if arguments.keep else pathlib.Path(temporary)
        outcomes = outcomes_of(checks, arguments.program.resolve(), folder, arguments.jobs)
    return record(checks, outcomes, fits, runs) if arguments.record else compare(checks, outcomes)


if __name__ == "__main__":
    sys.exit(main())
