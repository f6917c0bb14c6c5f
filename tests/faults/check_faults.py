#!/usr/bin/env python3
"""Do the tests see a broken operator? Each *.patch beside this file breaks one, and one test program is to
notice: the patch's first line says what is broken, its second line which program.

For each patch: applies it to a scratch copy of the tree, builds that program alone, and runs it until the
first test fails. Prints a table, and exits 1 where a fault goes unnoticed, 2 where one does not apply or build.

Not part of CI: the first run builds the test programs concerned, about 20 minutes on 2 cores; the copy is
kept (build/faults), so that a later one only compiles what has changed and each fault, 20 to 60 seconds a
fault. Faults of one program come one after the other, and the copy has no debug information, no benchmarks.

    tests/faults/check_faults.py                   all faults
    tests/faults/check_faults.py cma ga_elites     those whose name holds one of the words
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
LONGEST_RUN_S = 900  # a test program that hangs has noticed, too


class Fault:
    """A patch, what it breaks, and the program that is to notice."""

    def __init__(self, path):
        self.path = path
        self.name = path.stem
        lines = path.read_text().splitlines()
        self.breaks = lines[0]
        found = re.fullmatch(r"Noticed by: (test_\w+)", lines[1])
        if not found:
            sys.exit(f"{path}:2: got '{lines[1]}', expected 'Noticed by: test_ROOM'")
        self.program = found[1]


def tracked_files():
    """Of the working tree, with what is not committed yet."""
    out = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT,
                         check=True, capture_output=True, text=True).stdout
    return [name for name in out.split("\0") if name and (ROOT / name).is_file()]


def mirror(tree):
    """Makes the copy equal to the working tree; files that are equal keep their times, so they stay built."""
    names = tracked_files()
    for name in names:
        source, copy = ROOT / name, tree / name
        if copy.is_file() and copy.read_bytes() == source.read_bytes():
            continue
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, copy)
    kept = set(names)
    for folder in ("src", "fitting", "experiments", "tests", "cmake"):
        for copy in (tree / folder).rglob("*"):
            if copy.is_file() and str(copy.relative_to(tree)) not in kept:
                copy.unlink()


def run(command, tree, **settings):
    """Git takes the copy for what it is, not for a part of the repository around it."""
    environment = dict(os.environ, GIT_CEILING_DIRECTORIES=str(tree.parent))
    return subprocess.run(command, cwd=tree, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, errors="replace", **settings)


def build(tree, program, jobs):
    if not (tree / "build/build.ninja").exists():
        configured = run(["cmake", "--preset", "release", "-DESPALIER_BENCHMARKS=OFF"], tree)
        if configured.returncode != 0:
            sys.exit(configured.stdout)
    return run(["ninja", "-C", "build", "-j", str(jobs), program], tree)


def first_failure(tree, program):
    """The name of the first test that fails, or how else the program ended; None where all pass."""
    try:
        result = run([f"build/tests/{program}", "--gtest_fail_fast", "--gtest_brief=1"], tree,
                     timeout=LONGEST_RUN_S)
    except subprocess.TimeoutExpired:
        return f"hangs: not done after {LONGEST_RUN_S} s"
    if result.returncode == 0:
        return None
    failed = re.search(r"^\[  FAILED  \] ([\w/.]+)", result.stdout, re.MULTILINE)
    return failed[1] if failed else f"ends with code {result.returncode}"


def check(fault, tree, jobs):
    """(what noticed it, what went wrong), one of them or none."""
    mirror(tree)
    applied = run(["git", "apply", str(fault.path)], tree)
    if applied.returncode != 0:
        return None, "does not apply: " + applied.stdout.strip()
    built = build(tree, fault.program, jobs)
    if built.returncode != 0:
        return None, "does not build: " + built.stdout.strip()[-600:]
    return first_failure(tree, fault.program), None


def check_unbroken(program, tree, jobs):
    """Without a fault all tests pass, or the table says nothing."""
    mirror(tree)
    built = build(tree, program, jobs)
    if built.returncode != 0:
        sys.exit(f"{program} does not build:\n{built.stdout[-3000:]}")
    failed = first_failure(tree, program)
    if failed:
        sys.exit(f"{program} fails without a fault: {failed}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("words", nargs="*", help="only faults whose name holds one of them")
    parser.add_argument("--tree", type=pathlib.Path, default=ROOT / "build/faults", help="the scratch copy")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="compilers at a time")
    options = parser.parse_args()
    tree = options.tree.resolve()
    faults = [Fault(path) for path in sorted(HERE.glob("*.patch"))]
    faults = [f for f in faults if not options.words or any(word in f.name for word in options.words)]
    if not faults:
        sys.exit(f"got no fault named like {options.words}, expected one of {HERE}/*.patch")
    unnoticed, broken, program = 0, 0, None
    for fault in sorted(faults, key=lambda f: (f.program, f.name)):
        if fault.program != program:
            program = fault.program
            check_unbroken(program, tree, options.jobs)
            print(f"\n{program} (passes without a fault)", flush=True)
        started = time.monotonic()
        noticed, problem = check(fault, tree, options.jobs)
        verdict = problem or (f"noticed by {noticed}" if noticed else "NOT NOTICED")
        print(f"  {fault.name:28} {time.monotonic() - started:5.0f} s  {verdict}", flush=True)
        broken += problem is not None
        unnoticed += problem is None and noticed is None
    mirror(tree)
    print(f"\n{len(faults)} faults: {len(faults) - unnoticed - broken} noticed, {unnoticed} not noticed, "
          f"{broken} that do not apply or build")
    return 2 if broken else 1 if unnoticed else 0


if __name__ == "__main__":
    sys.exit(main())
