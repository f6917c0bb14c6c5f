#!/usr/bin/env python3
"""Makes the tables of these pages anew from the program: what stands between the marks
<!-- espalier ARGUMENTS --> and <!-- end --> becomes what the program prints with these arguments; parameters.md is
printed as a whole.

    docs/update_tables.py [--check] [PROGRAM]

PROGRAM: build/bin/espalier unless told otherwise. --check changes nothing and exits 1 where a page is not fresh."""

import pathlib
import re
import shlex
import subprocess
import sys

DOCS = pathlib.Path(__file__).resolve().parent
WHOLE_PAGES = {"parameters.md": "params --format markdown"}
BLOCK = re.compile(r"(<!-- espalier ([^\n]*?) -->\n).*?(<!-- end -->)", re.DOTALL)


def printed(program, arguments):
    return subprocess.run([program] + shlex.split(arguments), check=True, capture_output=True, text=True).stdout


def fresh_page(page, program):
    if page.name in WHOLE_PAGES:
        return printed(program, WHOLE_PAGES[page.name])
    return BLOCK.sub(lambda block: block[1] + printed(program, block[2]) + block[3], page.read_text())


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "--check"]
    program = arguments[0] if arguments else DOCS.parent / "build/bin/espalier"
    check, stale = "--check" in sys.argv, 0
    for page in sorted(DOCS.glob("*.md")):
        fresh = fresh_page(page, program)
        if fresh == page.read_text():
            continue
        if check:
            stale += 1
            print(f"{page}: got tables that are not what the program prints, make them anew by docs/update_tables.py")
        else:
            page.write_text(fresh)
            print(f"{page}: made anew")
    sys.exit(1 if stale else 0)


if __name__ == "__main__":
    main()
