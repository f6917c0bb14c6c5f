#!/usr/bin/env python3
"""How close fits come to every bundled picture, stage by stage, with and without growing into the outline.

    experiments/closeness.py [--seconds 60] [--seed 1] [--out runs/closeness] [--pictures fir,oc_palm]

Runs that are there are kept, so that a stopped experiment goes on. Writes OUT/README.md and, where ImageMagick is
installed, OUT/overlays.png; the committed page is experiments/closeness.md."""

import argparse
import csv
import json
import pathlib
import shutil
import subprocess

from fit_bundled_targets import ROOT, fit

METRICS = ["iou", "tolerant_iou", "outline_iou", "gap_iou"]
GROUPS = {
    "solid crowns": ["oc_cypress", "oc_evergreen", "oc_orange", "oc_roundcrown", "oc_rpg01"],
    "porous crowns": ["tr_birch", "tr_fir", "tr_horsechestnuttree", "tr_peartree", "reference_apple",
                      "reference_lombardy_poplar", "reference_palm", "reference_quaking_aspen", "reference_small_pine",
                      "reference_weeping_willow"],
    "leafless": ["oc_rpg11", "tr_blandbirch", "tr_crookedtree4", "tr_snowytree"],
    "palms": ["oc_palm", "tr_palmtree2"],
}


def outline_alone(directory):
    """What the filled outline scores with no tree at all."""
    text = subprocess.run([ROOT / "espalier", "compare", "--json", directory / "outline.png", directory / "target.png"],
                          check=True, capture_output=True, text=True).stdout
    return json.loads(text)


def after_search(directory):
    """The metrics of the last row of the trace before branches were refined."""
    rows = [row for row in csv.DictReader((directory / "trace.csv").open()) if row["stage"] != "branches"]
    return {metric: float(rows[-1][metric]) for metric in METRICS}


def row(name, metrics):
    return f"| {name} | " + " | ".join(f"{metrics[metric]:.3f}" for metric in METRICS) + " |"


def mean(all_metrics):
    return {metric: sum(m[metric] for m in all_metrics) / len(all_metrics) for metric in METRICS}


def table(title, by_picture):
    lines = [f"| {title} | IoU | tolerant IoU | outline IoU | gap IoU |", "|---|--:|--:|--:|--:|"]
    for group, members in GROUPS.items():
        found = [by_picture[name] for name in members if name in by_picture]
        if found:
            lines.append(row(f"{group} ({len(found)})", mean(found)))
    lines.append(row(f"**all ({len(by_picture)})**", mean(list(by_picture.values()))))
    return "\n".join(lines)


def sheet(out, directories):
    if shutil.which("montage"):
        files = [directory / "overlay.png" for directory in directories]
        subprocess.run(["montage", *files, "-resize", "200x200", "-tile", "8x", "-geometry", "+2+2", out], check=True)


def write_page(out, results):
    tables = [table(title, by_picture) for title, by_picture in results.items() if by_picture]
    pictures = ["| picture | " + " | ".join(f"{title}: IoU, gap IoU" for title in results) + " |",
                "|---|" + "--:|" * len(results)]
    for name in results["outline, no tree"]:
        pictures.append(f"| {name} | " + " | ".join(
            f"{by[name]['iou']:.3f}, {by[name]['gap_iou']:.3f}" for by in results.values()) + " |")
    (out / "README.md").write_text("\n\n".join(tables) + "\n\n" + "\n".join(pictures) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("runs/closeness"))
    parser.add_argument("--pictures", help="some of them, with commas between")
    arguments, options = parser.parse_known_args()
    names = arguments.pictures.split(",") if arguments.pictures else [n for group in GROUPS.values() for n in group]
    results = {title: {} for title in ["outline, no tree", "search", "search and branches", "trained: search",
                                       "trained: search and branches"]}
    trained_runs = []
    for name in names:
        picture = ROOT / "targets" / f"{name}.png"
        for mode, flags in {"free": [], "trained": ["--train-to-target"]}.items():
            directory = arguments.out / mode / name
            directory.parent.mkdir(parents=True, exist_ok=True)
            summary = fit(picture, directory, arguments.seconds, arguments.seed, flags + options)
            prefix = "trained: " if mode == "trained" else ""
            results[f"{prefix}search"][name] = after_search(directory)
            results[f"{prefix}search and branches"][name] = summary
            print(f"{mode:8} {name:28}", " ".join(f"{m} {summary[m]:.3f}" for m in METRICS), flush=True)
        results["outline, no tree"][name] = outline_alone(arguments.out / "trained" / name)
        trained_runs.append(arguments.out / "trained" / name)
        write_page(arguments.out, results)
    sheet(arguments.out / "overlays.png", trained_runs)
    print((arguments.out / "README.md").read_text())


if __name__ == "__main__":
    main()
