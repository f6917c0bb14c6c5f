#!/usr/bin/env python3
"""Fits every picture in targets/ for the same time and writes the table of what came out.

    experiments/fit_bundled_targets.py [--seconds 60] [--seed 1] [--out runs/bundled] [--pictures fir,oc_palm]
                                       [options of espalier fit]

Runs that are already in the directory are kept, so that a stopped experiment goes on where it was.
Writes OUT/README.md; the committed page is a copy, experiments/bundled_targets.md."""

import argparse
import json
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
COLUMNS = ["iou", "tolerant_iou", "outline_iou", "fitness", "evaluations", "evaluations_per_second"]


def fit(picture, directory, seconds, seed, options):
    """The summary of the picture's run, made now unless it is there."""
    if not (directory / "summary.json").exists():
        subprocess.run(
            [ROOT / "espalier", "fit", picture, "--seconds", str(seconds), "--seed", str(seed), "--out", directory]
            + ["--quiet"] + options, check=True)
    return json.loads((directory / "summary.json").read_text())


def cell(summary, column):
    value = summary[column]
    return f"{value:.3f}" if abs(value) <= 1 else f"{value:,.0f}"


def table(summaries):
    lines = ["| picture | " + " | ".join(name.replace("_", " ") for name in COLUMNS) + " |",
             "|---|" + "--:|" * len(COLUMNS)]
    for name, summary in summaries.items():
        lines.append(f"| {name} | " + " | ".join(cell(summary, column) for column in COLUMNS) + " |")
    mean = {column: sum(s[column] for s in summaries.values()) / len(summaries) for column in COLUMNS}
    lines.append("| **mean** | " + " | ".join(f"**{cell(mean, column)}**" for column in COLUMNS) + " |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("runs/bundled"))
    parser.add_argument("--pictures", help="some of them, with commas between")
    arguments, options = parser.parse_known_args()
    pictures = sorted((ROOT / "targets").glob("*.png"))
    if arguments.pictures:
        pictures = [ROOT / "targets" / f"{name}.png" for name in arguments.pictures.split(",")]
    arguments.out.mkdir(parents=True, exist_ok=True)
    summaries = {}
    for picture in pictures:
        directory = arguments.out / picture.stem
        summaries[picture.stem] = fit(picture, directory, arguments.seconds, arguments.seed, options)
        print(picture.stem, " ".join(f"{c} {cell(summaries[picture.stem], c)}" for c in COLUMNS), flush=True)
        (arguments.out / "README.md").write_text(table(summaries) + "\n")
    print(table(summaries))


if __name__ == "__main__":
    main()
