#!/usr/bin/python3
"""Draws the plots of a report directory and writes its page; `espalier experiment report` calls it.

    experiments/report/report.py runs/NAME/report

Reads what that command has left there (meta.json and CSV files), nothing else but the pictures they name. Every CSV
file that has a plot gets it as SVG, PNG and PDF; index.html holds all. The same files give the same bytes.
Without Matplotlib the page has no plots, and one line on stderr says what to install.
Exit codes: 0; 2 for bad input, with one line on stderr that says where."""

import argparse
import pathlib
import sys

sys.dont_write_bytecode = True  # leaves nothing in the source tree

from page import write_page  # noqa: E402
from read import ReportError, read_meta  # noqa: E402


def has_matplotlib():
    try:
        import matplotlib.pyplot  # noqa: F401
    except ImportError as error:
        print(f"report: no plots: Matplotlib cannot be imported ({error}); install Debian's python3-matplotlib "
              "and run the report again", file=sys.stderr)
        return False
    return True


def draw_plots(directory, meta):
    """The stems of what was drawn, in the order of the page."""
    import plots
    import style
    style.use_style()
    stems = []
    for module in plots.ALL:
        for stem, figure in module.draw(directory, meta).items():
            style.save(figure, directory, stem)
            stems.append(stem)
    return stems


def report(directory):
    meta = read_meta(directory)
    stems = draw_plots(directory, meta) if has_matplotlib() else None
    write_page(directory, meta, stems)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path)
    try:
        report(parser.parse_args().directory)
    except ReportError as error:
        print(f"report: {error}", file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main()
