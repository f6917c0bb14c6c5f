#!/usr/bin/env python3
"""Shows that what Espalier can be extended by touches few files and appears everywhere by itself.

    tests/extension/check.py [--dry-run] [--scratch DIR] [NAME…]

Each NAME.toml here (all, unless some are named) goes with NAME.patch, which adds a measure, an option or the like:

    most_files = 2                          # that the patch may touch
    [[expect]]                              # in this order, in a scratch copy with all patches
    run = "compare --json a.png b.png"      # arguments of the program; {out} is an empty folder
    exit_code = 0                           # 0 where it is not said
    prints = ["recall"]                     # on standard output or standard error
    [[expect]]
    script = "docs/update_tables.py"        # of the copy, with the program as its argument
    [[expect]]
    file = "docs/measures.md"               # of the copy, or below {out}
    holds = ["`recall`"]

The tree as it is now is copied to the scratch folder (build/extension), the patches are applied, the program is
built and asked. The folder is kept: the next time only what changed is built. --dry-run only applies the patches and
counts their files."""

import argparse
import pathlib
import shlex
import shutil
import subprocess
import sys
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent


class Failure(Exception):
    pass


def run(command, **options):
    return subprocess.run(command, capture_output=True, text=True, **options)


def must(command, what, **options):
    done = run(command, **options)
    if done.returncode != 0:
        raise Failure(f"{what}:\n{(done.stdout + done.stderr)[-3000:]}")
    return done.stdout


def touched_files(patch):
    lines = patch.read_text().splitlines()
    return sorted({line.split(" b/")[-1] for line in lines if line.startswith("diff --git ")})


def tracked_files():
    listed = must(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], "git ls-files", cwd=ROOT)
    return [name for name in listed.split("\0") if name and (ROOT / name).is_file()]


def patched_copy(names, copy):
    """The tree with all patches, made in a folder of its own."""
    shutil.rmtree(copy, ignore_errors=True)
    for name in tracked_files():
        (copy / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, copy / name)
    must(["git", "init", "--quiet", "."], "git init", cwd=copy)  # else git apply looks at the repository around it
    for name in names:
        must(["git", "apply", HERE / f"{name}.patch"], f"{name}.patch does not apply", cwd=copy)
    shutil.rmtree(copy / ".git")


def copy_what_changed(fresh, copy):
    """Times of files that stay as they are stay too, so that a second build is short."""
    wanted = {path.relative_to(fresh) for path in fresh.rglob("*") if path.is_file()}
    for path in copy.rglob("*"):
        if path.is_file() and path.relative_to(copy) not in wanted:
            path.unlink()
    for name in sorted(wanted):
        if not (copy / name).exists() or (copy / name).read_bytes() != (fresh / name).read_bytes():
            (copy / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(fresh / name, copy / name)
            shutil.copymode(fresh / name, copy / name)


def build(copy, folder):
    must(["cmake", "-S", copy, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DESPALIER_WERROR=ON"],
         "cmake")
    must(["cmake", "--build", folder, "--target", "espalier_program"], "the build")
    return folder / "bin/espalier"


def check(expectation, program, copy, out):
    texts = {"out": out}
    if "run" in expectation:
        command = shlex.split(expectation["run"].format(**texts))
        done = run([program] + command, cwd=copy)
        if done.returncode != expectation.get("exit_code", 0):
            raise Failure(f"espalier {shlex.join(command)}: got exit code {done.returncode}, expected "
                          f"{expectation.get('exit_code', 0)}\n{done.stderr}")
        missing = [text for text in expectation.get("prints", []) if text not in done.stdout + done.stderr]
        what = f"what espalier {shlex.join(command)} prints"
    elif "script" in expectation:
        missing = []
        must([copy / expectation["script"], program], expectation["script"], cwd=copy)
        what = expectation["script"]
    else:
        path = copy / expectation["file"].format(**texts)
        text = path.read_text() if path.exists() else ""
        missing = [text_ for text_ in expectation["holds"] if text_ not in text]
        what = str(path)
    if missing:
        raise Failure(f"{what}: got no {missing[0]!r}, expected it there")
    print(f"  {what}")


def check_count(name, declaration):
    files = touched_files(HERE / f"{name}.patch")
    if len(files) > declaration["most_files"]:
        raise Failure(f"{name}.patch: got {len(files)} files, expected at most {declaration['most_files']}")
    print(f"{name}: {len(files)} files ({', '.join(files)})")


def check_all(names, scratch, dry_run):
    declarations = {name: tomllib.loads((HERE / f"{name}.toml").read_text()) for name in names}
    for name in names:
        check_count(name, declarations[name])
    patched_copy(names, scratch / "fresh")
    if dry_run:
        return
    copy = scratch / "copy"
    copy.mkdir(exist_ok=True)
    copy_what_changed(scratch / "fresh", copy)
    program = build(copy, scratch / "build")
    for name in names:
        out = scratch / "out" / name
        shutil.rmtree(out, ignore_errors=True)
        out.mkdir(parents=True)
        print(f"{name}:")
        for expectation in declarations[name]["expect"]:
            check(expectation, program, copy, out)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--scratch", type=pathlib.Path, default=ROOT / "build/extension")
    parser.add_argument("--dry-run", action="store_true")
    arguments = parser.parse_args()
    names = arguments.names or sorted(path.stem for path in HERE.glob("*.toml"))
    scratch = arguments.scratch.resolve()
    scratch.mkdir(parents=True, exist_ok=True)
    try:
        check_all(names, scratch, arguments.dry_run)
    except Failure as failure:
        sys.exit(str(failure))


if __name__ == "__main__":
    main()
