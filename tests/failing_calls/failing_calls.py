#!/usr/bin/env python3
"""Runs a short fit on a machine that fails at its n-th call, and expects that the fit goes on to the same bits.

    tests/failing_calls/failing_calls.py --program build/bin/espalier --layer build/tests/libfailing_calls.so
                                         [--every K] [--first N] [--how error,kill,…] [--jobs N]

The layer (failing_calls.cpp) counts the calls that open, write, sync, rename, close, make or remove a file of the
run, and fails one of them: with an error, a kill, a torn write or a power cut. Then the fit is resumed (or begun, where
there was no record yet) without the layer, and what it leaves is compared with the unbroken run. Both a new fit and
one that is resumed half way are broken. --every 1, the default, tries every call of both, in all ways: some twenty
minutes on two processors. The exit code is 1 where one of them lost something."""

import argparse
import concurrent.futures
import dataclasses
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

TARGET = pathlib.Path(__file__).resolve().parents[2] / "targets" / "tr_birch.png"
FIT = ["fit", str(TARGET), "--start", "quaking_aspen", "--size", "32", "--evaluations", "60", "--branch-rounds", "1",
       "--max-stems", "150", "--seed", "1"]
WAYS = ["error", "kill", "torn", "cut", "zeros"]
RESULTS = ["best.toml", "best.png", "archive/1.toml", "overlay_full_size.png", "target.png"]
MOST_MESSAGE_BYTES = 300


@dataclasses.dataclass
class Case:
    how: str
    call: int
    resumed: bool  # a run that was stopped half way, else a new one

    def __str__(self):
        return f"{'resumed' if self.resumed else 'new'} fit, call {self.call}, {self.how}"


class Bench:
    """The program, the layer, and the runs to compare with."""

    def __init__(self, program, layer, scratch):
        self.program, self.layer, self.scratch = program, layer, scratch
        self.whole, self.half = scratch / "whole", scratch / "half"

    def run(self, arguments, **failing):
        environment = dict(os.environ, OMP_NUM_THREADS="1")
        if failing:
            environment |= {"LD_PRELOAD": str(self.layer)}
            environment |= {f"FAILING_CALLS_{name.upper()}": str(value) for name, value in failing.items()}
        return subprocess.run([self.program, *arguments], env=environment, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, errors="replace", timeout=120)

    def prepare(self):
        self.expect_done(self.run([*FIT, "--output", self.whole]))
        shutil.copytree(self.whole, self.half)
        log = self.half / "evaluations.bin"
        log.write_bytes(log.read_bytes()[:8 + 24 * 30 + 7])  # 30 evaluations and a torn one
        for name in ["branches.json", "summary.json", *RESULTS]:
            (self.half / name).unlink(missing_ok=True)

    @staticmethod
    def expect_done(done):
        if done.returncode != 0:
            sys.exit(f"the unbroken fit ended with {done.returncode}: {done.stderr}")

    def command(self, directory):
        """What a user would type next."""
        if (directory / "run.toml").exists():
            return ["fit", "--resume", str(directory)]
        return [*FIT, "--output", str(directory)]

    def begin(self, case, folder):
        directory = folder / "run"
        if case.resumed:
            shutil.copytree(self.half, directory)
        return directory

    def count(self, resumed):
        with tempfile.TemporaryDirectory(dir=self.scratch) as folder:
            folder = pathlib.Path(folder)
            directory = self.begin(Case("", 0, resumed), folder)
            self.expect_done(self.run(self.command(directory), below=directory, count=folder / "count"))
            return int((folder / "count").read_text())

    def faults(self, case):
        """What was lost or said wrongly, a line each."""
        with tempfile.TemporaryDirectory(dir=self.scratch) as folder:
            folder = pathlib.Path(folder)
            directory = self.begin(case, folder)
            broken = self.run(self.command(directory), below=directory, at=case.call, how=case.how)
            found = self.wrong_end(case, broken)
            again = self.run(self.command(directory))
            if again.returncode != 0:
                return found + [f"it does not go on: exit {again.returncode}: {again.stderr.strip()}"]
            return found + [f"{name} differs" for name in RESULTS if not self.is_same(directory, name)]

    @staticmethod
    def wrong_end(case, broken):
        """A call that fails is one line and exit code 2, or of no consequence; else the process was killed."""
        if case.how != "error":
            return [] if broken.returncode == -9 or case.how == "torn" else [f"exit {broken.returncode}, expected a kill"]
        lines = [line for line in broken.stderr.splitlines() if line.startswith("espalier")]
        if broken.returncode not in (0, 2):
            return [f"exit {broken.returncode}: {broken.stderr.strip()}"]
        if broken.returncode == 2 and (len(lines) != 1 or len(lines[0].encode()) > MOST_MESSAGE_BYTES):
            return [f"expected one line of at most {MOST_MESSAGE_BYTES} bytes: {broken.stderr.strip()}"]
        return []

    def is_same(self, directory, name):
        ours, whole = directory / name, self.whole / name
        return ours.exists() and ours.read_bytes() == whole.read_bytes()


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--program", required=True, type=pathlib.Path)
    parser.add_argument("--layer", required=True, type=pathlib.Path)
    parser.add_argument("--every", type=int, default=1, help="try each K-th call alone")
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--how", type=lambda text: text.split(","), default=WAYS)
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()

    with tempfile.TemporaryDirectory(prefix="failing_calls_") as scratch:
        bench = Bench(options.program.resolve(), options.layer.resolve(), pathlib.Path(scratch).resolve())
        bench.prepare()
        counts = {resumed: bench.count(resumed) for resumed in (False, True)}
        cases = [Case(how, call, resumed) for resumed, calls in counts.items() for way, how in enumerate(options.how)
                 for call in range(options.first + way, calls + 1, options.every)]
        wrong = 0
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for tried, (case, faults) in enumerate(zip(cases, pool.map(bench.faults, cases))):
                if tried % 100 == 0:
                    print(f"{tried} of {len(cases)} failures", file=sys.stderr, flush=True)
                for fault in faults:
                    print(f"{case}: {fault}", flush=True)
                wrong += bool(faults)
        print(f"{len(cases)} failures in a new fit of {counts[False]} calls and a resumed one of {counts[True]}: {wrong} wrong")
        return 1 if wrong or not cases else 0


if __name__ == "__main__":
    sys.exit(main())
