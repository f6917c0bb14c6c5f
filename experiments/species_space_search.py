#!/usr/bin/env python3
"""Does a fit that searches the species space first reach a given fitness in fewer evaluations than a cold start?

    experiments/species_space_search.py [--evaluations 1500] [--seeds 3] [--out runs/space] [--pictures fir,oc_palm]
                                        [--program build/bin/espalier]

Each picture of targets/ is fitted with each start and seed. A given fitness is a share of the best that any run of the
picture reached. Runs that are already in the directory are kept. Prints the tables of docs/species_space.md."""

import argparse
import concurrent.futures
import csv
import pathlib
import statistics
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
STARTS = {"defaults": ["--start", "defaults"],
          "defaults, then species:2": ["--start", "defaults", "--space", "species:2"],
          "all presets": [],
          "all presets, then species:2": ["--space", "species:2"],
          "all presets, then species:5": ["--space", "species:5"]}
SHARES = [0.8, 0.9, 0.95]


def best_so_far(directory):
    """(evaluations, best fitness), a row a batch."""
    with open(directory / "trace.csv", newline="") as file:
        return [(int(row["evaluations"]), float(row["best"])) for row in csv.DictReader(file)]


def fit(program, picture, start, seed, evaluations, out):
    name = start.replace(", then ", "+").replace(" ", "_").replace(":", "")
    directory = out / f"{picture.stem}-{name}-{seed}"
    if not (directory / "summary.json").exists():
        subprocess.run([program, "fit", picture, "--evaluations", str(evaluations), "--seed", str(seed), "--threads",
                        "1", "--quiet", "--out", directory] + STARTS[start], check=True)
    return best_so_far(directory)


def evaluations_to(trace, fitness, most):
    return next((evaluations for evaluations, best in trace if best >= fitness), most + 1)


def count_text(value, most):
    return f"> {most}" if value > most else f"{value:.0f}"


def print_reached(traces, pictures, seeds, most):
    """Median evaluations to each share of the picture's best, and how many runs got there."""
    print("| start | " + " | ".join(f"to {share:.0%}" for share in SHARES) + " | fitness at the end | spread of seeds |")
    print("|---|" + "--:|" * (len(SHARES) + 2))
    best = {p: max(traces[p, start, seed][-1][1] for start in STARTS for seed in seeds) for p in pictures}
    for start in STARTS:
        cells = []
        for share in SHARES:
            counts = [evaluations_to(traces[p, start, s], share * best[p], most) for p in pictures for s in seeds]
            reached = sum(count <= most for count in counts)
            cells.append(f"{count_text(statistics.median(counts), most)} ({reached} of {len(counts)})")
        ends = {p: [traces[p, start, s][-1][1] for s in seeds] for p in pictures}
        mean = statistics.mean(statistics.mean(values) for values in ends.values())
        spread = statistics.mean(statistics.stdev(values) if len(values) > 1 else 0 for values in ends.values())
        print(f"| {start} | " + " | ".join(cells) + f" | {mean:.4f} | {spread:.4f} |")


def print_wins(traces, pictures, seeds, most):
    """In how many runs a start reaches 90 % of the picture's best before another does, of the same seed."""
    best = {p: max(traces[p, start, seed][-1][1] for start in STARTS for seed in seeds) for p in pictures}
    for first, second in [("defaults, then species:2", "defaults"), ("all presets, then species:2", "defaults"),
                          ("all presets, then species:2", "all presets"),
                          ("all presets, then species:5", "all presets")]:
        pairs = [(evaluations_to(traces[p, first, s], 0.9 * best[p], most),
                  evaluations_to(traces[p, second, s], 0.9 * best[p], most)) for p in pictures for s in seeds]
        print(f"- to 90 %: {first} before {second} in {sum(a < b for a, b in pairs)} of {len(pairs)} runs, "
              f"after it in {sum(a > b for a, b in pairs)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--evaluations", type=int, default=1500)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("runs/space"))
    parser.add_argument("--pictures", help="some of them, with commas between")
    parser.add_argument("--program", default=ROOT / "build/bin/espalier")
    arguments = parser.parse_args()
    pictures = sorted((ROOT / "targets").glob("*.png"))
    if arguments.pictures:
        pictures = [ROOT / "targets" / f"{name}.png" for name in arguments.pictures.split(",")]
    arguments.out.mkdir(parents=True, exist_ok=True)
    seeds = range(1, arguments.seeds + 1)
    tasks = [(picture, start, seed) for picture in pictures for start in STARTS for seed in seeds]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        results = pool.map(lambda task: fit(arguments.program, *task, arguments.evaluations, arguments.out), tasks)
        traces = dict(zip(tasks, results))
    print_reached(traces, pictures, seeds, arguments.evaluations)
    print()
    print_wins(traces, pictures, seeds, arguments.evaluations)


if __name__ == "__main__":
    main()
