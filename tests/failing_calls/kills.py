#!/usr/bin/env python3
"""Kills commands at moments by chance, goes on with them, and expects the files of the unbroken run.

    tests/failing_calls/kills.py --program build/bin/espalier [--kills 1000] [--seed N] [--jobs N] [--only GLOB]

Fits (plain with branches, trained, of an L-system, in the species space), a posterior and an experiment. A command is
killed up to three times, then it may end. Each process is the first of its own process namespace, as in a container
that starts anew, so that process numbers repeat; where that is not allowed, it is said and the kills are plain ones.
Half an hour for a thousand kills on two processors: run by hand. The exit code is 1 where something was lost."""

import argparse
import concurrent.futures
import dataclasses
import fnmatch
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
TARGETS = ROOT / "targets"
NAMESPACE = ["unshare", "--pid", "--fork", "--kill-child", "--mount-proc"]
MOST_KILLS_OF_ONE = 3

STUDY = """[fits]
targets = ["oc_palm"]
optimizers = ["cma_es", "LN_SBPLX"]
starts = ["palm"]
seeds = 2
evaluations = 40
size = 32
max_stems = 300
max_leaves = 3000
"""


@dataclasses.dataclass
class Kind:
    """A command that makes `directory`, that goes on with it, and what must be the same."""

    name: str
    begin: list
    files: list
    resumes: bool = True  # by --resume, where there is a record; else by the same command


FITTED = ["best.toml", "best.png", "archive/1.toml"]
SMALL = ["--size", "32", "--max-stems", "150", "--seed", "5"]
KINDS = [
    Kind("plain", ["fit", TARGETS / "tr_birch.png", *SMALL, "--start", "quaking_aspen", "--evaluations", "300", "--branch-rounds", "1"],
         FITTED),
    Kind("trained", ["fit", TARGETS / "oc_evergreen.png", *SMALL, "--start", "small_pine", "--train-to-target", "--evaluations", "200",
                     "--branch-rounds", "1"], FITTED),
    Kind("lsystem", ["fit", TARGETS / "tr_fir.png", "--size", "32", "--seed", "5", "--model", "monopodial.lsys", "--evaluations", "300"],
         FITTED),
    Kind("space", ["fit", TARGETS / "tr_peartree.png", *SMALL, "--space", "species:2", "--space-evaluations", "60", "--evaluations", "200",
                   "--branch-rounds", "0"], FITTED),
    Kind("posterior", ["posterior", TARGETS / "tr_birch.png", "--simulations", "2000", "--samples", "50", "--seed", "5"],
         ["intervals.csv", "samples.csv"], resumes=False),
    Kind("experiment", ["experiment", "run", "STUDY"], ["results.csv"], resumes=False),
]


class Killer:
    def __init__(self, program, scratch):
        self.program, self.scratch = program, scratch
        self.study = scratch / "study.toml"
        self.study.write_text(STUDY)
        probe = subprocess.run([*NAMESPACE, "true"], capture_output=True, check=False)
        self.namespace = NAMESPACE if probe.returncode == 0 else []
        if not self.namespace:
            print(f"no process namespaces ({probe.stderr.decode().strip()}): plain kills")
        self.whole, self.seconds = {}, {}

    def command(self, kind, directory):
        if kind.resumes and (directory / "run.toml").exists():
            return ["fit", "--resume", directory]
        begin = [self.study if word == "STUDY" else word for word in kind.begin]
        return [*begin, "--output", directory]

    def run(self, kind, directory, killed_after=None):
        """Whether it was killed; throws where it ends in another way than it should."""
        process = subprocess.Popen([*self.namespace, self.program, *self.command(kind, directory)], stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, errors="replace",
                                   env=dict(os.environ, OMP_WAIT_POLICY="passive"), start_new_session=True)
        try:
            said = process.communicate(timeout=killed_after)[1]
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            return True
        if process.returncode != 0:
            raise RuntimeError(f"exit {process.returncode}: {said.strip()[-300:]}")
        return False

    def prepare(self, kind):
        self.whole[kind.name] = self.scratch / f"whole_{kind.name}"
        begin = time.monotonic()
        self.run(kind, self.whole[kind.name])
        self.seconds[kind.name] = time.monotonic() - begin

    def broken(self, kind, seed):
        """The number of kills, and what differed afterwards."""
        chance = random.Random(seed)
        directory = self.scratch / f"{kind.name}_{seed}"
        kills = 0
        try:
            while kills < MOST_KILLS_OF_ONE and self.run(kind, directory, chance.uniform(0.0, self.seconds[kind.name])):
                kills += 1
            self.run(kind, directory)
            whole = self.whole[kind.name]
            return kills, [f"{name} differs" for name in kind.files if (directory / name).read_bytes() != (whole / name).read_bytes()]
        except (RuntimeError, OSError) as error:
            return kills, [str(error)]
        finally:
            shutil.rmtree(directory, ignore_errors=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--program", required=True, type=pathlib.Path)
    parser.add_argument("--kills", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=random.randrange(1 << 30))
    parser.add_argument("--only", default="*", metavar="GLOB", help="names of kinds")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    kinds = [kind for kind in KINDS if fnmatch.fnmatch(kind.name, options.only)]

    with tempfile.TemporaryDirectory(prefix="kills_") as scratch:
        killer = Killer(options.program.resolve(), pathlib.Path(scratch).resolve())
        for kind in kinds:
            killer.prepare(kind)
        kills, wrong = dict.fromkeys((kind.name for kind in kinds), 0), 0
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            attempt = options.seed
            while sum(kills.values()) < options.kills:
                print(f"{sum(kills.values())} of {options.kills} kills", file=sys.stderr, flush=True)
                round_of = [(kind, attempt + turn) for turn in range(options.jobs) for kind in kinds]
                attempt += options.jobs
                for (kind, seed), (count, faults) in zip(round_of, pool.map(lambda one: killer.broken(*one), round_of)):
                    kills[kind.name] += count
                    wrong += bool(faults)
                    for fault in faults:
                        print(f"{kind.name}, seed {seed}: {fault}", flush=True)
        print(f"{sum(kills.values())} kills from seed {options.seed} ({kills}): {wrong} lost something")
        return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
