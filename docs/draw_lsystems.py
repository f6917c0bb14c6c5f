#!/usr/bin/python3
"""Draws the pictures of the bundled L-systems for lsystem.md anew: lsystem/NAME.png, with the options that the page
names beside them.

    docs/draw_lsystems.py [--check] [PROGRAM] [NAME…]

PROGRAM: build/bin/espalier unless told otherwise; names: all of them unless some are given. --check changes nothing
and exits 1 where a picture is not the one that the program draws, 77 where Debian's python3-numpy or python3-pil is
missing (they come with python3-matplotlib). A few pixels may differ by rounding, because what
Embree computes depends on the vectors that it chooses."""

import pathlib
import shlex
import subprocess
import sys
import tempfile

try:
    import numpy
    from PIL import Image
except ImportError as error:
    print(f"pictures are not compared: {error}; install Debian's python3-matplotlib", file=sys.stderr)
    sys.exit(77)

DOCS = pathlib.Path(__file__).resolve().parent
MODELS = DOCS.parent / "src/lsystem/models"
VIEWS = {"knot_garden": "--elevation 50 --azimuth 20 --ground", "knot_plant": "--elevation 30",
         "flower_field": "--view 20,25 --ground", "random_tree": "--seed 2", "topiary_6": "--seed 3"}
SIDE_PX = 150
MOST_DIFFERENCE = 0.2  # of 255, in the mean: rounding is below 0.01, another angle of one branch above


def draw(program, name, path):
    subprocess.run([program, "lsystem", name, "--size", str(SIDE_PX), *shlex.split(VIEWS.get(name, "")), "-o", path],
                   check=True, stdout=subprocess.DEVNULL)


def difference(path, other):
    """Of two pictures in the mean, 255 where one is missing or of another size."""
    if not (path.exists() and other.exists()):
        return 255
    a, b = (numpy.asarray(Image.open(file).convert("RGB"), dtype=float) for file in (path, other))
    return abs(a - b).mean() if a.shape == b.shape else 255


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "--check"]
    program = arguments.pop(0) if arguments else str(DOCS.parent / "build/bin/espalier")
    known = sorted(path.stem for path in MODELS.glob("*.lsys"))
    check, stale = "--check" in sys.argv, 0
    for name in arguments or known:
        if name not in known:
            sys.exit(f"got '{name}', expected names of bundled L-systems")
        kept = DOCS / f"lsystem/{name}.png"
        with tempfile.TemporaryDirectory() as folder:
            fresh = pathlib.Path(folder) / "fresh.png"
            draw(program, name, fresh)
            apart = difference(kept, fresh)
            if check and apart > MOST_DIFFERENCE:
                stale += 1
                print(f"{kept}: differs by {apart:.2f} in the mean from what the program draws, "
                      "make it anew by docs/draw_lsystems.py")
            elif not check and apart > 0.01:
                kept.write_bytes(fresh.read_bytes())
                print(f"{kept}: made anew")
    sys.exit(1 if stale else 0)


if __name__ == "__main__":
    main()
