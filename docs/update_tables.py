#!/usr/bin/env python3
"""Makes the tables of these pages anew from the program: what stands between the marks
<!-- espalier ARGUMENTS --> and <!-- end --> becomes what the program prints with these arguments.

    docs/update_tables.py [--check] [PROGRAM]

PROGRAM: build/bin/espalier unless told otherwise. --check changes nothing and exits 1 where a page is not fresh."""

import pathlib
import re
import shlex
import subprocess
import sys

DOCS = pathlib.Path(__file__).resolve().parent
BLOCK = re.compile(r"(<!-- espalier ([^\n]*?) -->\n).*?(<!-- end -->)", re.DOTALL)


def with_fresh_tables(text, program):
    def fresh(block):
        printed = subprocess.run([program] + shlex.split(block[2]), check=True, capture_output=True, text=True)
        return block[1] + printed.stdout + block[3]

    return BLOCK.sub(fresh, text)


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "--check"]
    program = arguments[0] if arguments else DOCS.parent / "build/bin/espalier"
    stale = 0
    for page in sorted(DOCS.glob("*.md")):
        text = page.read_text()
        fresh = with_fresh_tables(text, program)
        if fresh == text:
            continue
        stale += 1
        print(f"{page}: {'is not fresh, make it anew by docs/update_tables.py' if '--check' in sys.argv else 'made anew'}")
        if "--check" not in sys.argv:
            page.write_text(fresh)
    sys.exit(1 if stale and "--check" in sys.argv else 0)


if __name__ == "__main__":
    main()
