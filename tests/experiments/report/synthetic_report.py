#!/usr/bin/env python3
"""Writes report directories as `espalier experiment report` leaves them, filled with made-up numbers.

    tests/experiments/synthetic_report.py DIRECTORY     DIRECTORY/{fits,pictures,growth}/report, to look at

Small ones serve the tests; the default sizes are those of the optimiser study: 36 methods, 12 targets, 5 seeds."""

import csv
import json
import math
import pathlib
import random
import struct
import sys
import zlib

METHODS = ["random_search", "hewitt_ga", "ga", "cma_es", "GN_DIRECT", "GN_DIRECT_L", "GN_DIRECT_L_RAND",
           "GN_DIRECT_NOSCAL", "GN_DIRECT_L_NOSCAL", "GN_DIRECT_L_RAND_NOSCAL", "GN_ORIG_DIRECT", "GN_ORIG_DIRECT_L",
           "GN_CRS2_LM", "GN_ISRES", "GN_ESCH", "GN_AGS", "GN_MLSL", "GN_MLSL:LN_COBYLA", "GN_MLSL:LN_BOBYQA",
           "GN_MLSL:LN_NEWUOA_BOUND", "GN_MLSL:LN_PRAXIS", "GN_MLSL:LN_NELDERMEAD", "GN_MLSL:LN_SBPLX", "GN_MLSL_LDS",
           "GN_MLSL_LDS:LN_COBYLA", "GN_MLSL_LDS:LN_BOBYQA", "GN_MLSL_LDS:LN_NEWUOA_BOUND", "GN_MLSL_LDS:LN_PRAXIS",
           "GN_MLSL_LDS:LN_NELDERMEAD", "GN_MLSL_LDS:LN_SBPLX", "LN_COBYLA", "LN_BOBYQA", "LN_NEWUOA_BOUND",
           "LN_PRAXIS", "LN_NELDERMEAD", "LN_SBPLX"]
TARGETS = ["quaking_aspen", "lombardy_poplar", "weeping_willow", "black_oak", "palm", "fir", "acer", "apple", "bamboo",
           "silver_birch", "small_pine", "black_tupelo"]
SPECIES = TARGETS + ["balsam_fir", "cambridge_oak", "douglas_fir", "european_larch", "fan_palm", "hill_cherry",
                     "sassafras", "sphere_tree"]
GRID = sorted({round(10 ** (k / 24 * 3.7)) for k in range(25)} | {5000})


def write_csv(path, header, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header.split(","))
        writer.writerows(rows)


def write_png(path, size, seed):
    """A grey tree-like blob."""
    rng = random.Random(seed)
    width = rng.uniform(0.15, 0.4)
    rows = b""
    for y in range(size):
        reach = size * (width * math.sin(math.pi * min(1, y / size / 0.8)) if y < 0.8 * size else 0.03)
        rows += b"\0" + bytes(255 if abs(x - size / 2) < reach * rng.uniform(0.7, 1.1) else 0 for x in range(size))
    header = struct.pack(">IIBBBBB", size, size, 8, 0, 0, 0, 0)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + png_chunk(b"IHDR", header) + png_chunk(b"IDAT", zlib.compress(rows))
                     + png_chunk(b"IEND", b""))


def png_chunk(name, body):
    return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))


def meta(kind, title, **more):
    return {"name": f"made_up_{kind}", "kind": kind, "title": title, "figure": "Fig. 4.9 of Hewitt 2017",
            "published": "95-97 % pixel accuracy after a few hours <of runtime> & more",
            "note": "Numbers of a test: nothing was fitted.", "command": f"espalier experiment run {kind}.toml",
            "declaration": "[experiment]\nkind = \"fits\"\nseeds = [1, 2]\n",
            "versions": {"espalier": "0.1.0", "nlopt": "2.7.1"}, "tables": [], "thumbnails": [],
            "ranked_by": ["unseen_fitness", "fitness"], **more}


def curve(rng, strength, ceiling):
    """Fitness at each point of the grid: rises with the logarithm of evaluations, in steps."""
    value, values = 0.25 * ceiling, []
    for evaluations in GRID:
        share = math.log(evaluations + 1) / math.log(5001)
        value = max(value, ceiling * (0.25 + 0.75 * strength * share ** 1.3 + rng.gauss(0, 0.02)))
        values.append(value)
    return values


def write_fits(report, methods, targets, seeds, runs=6):
    rng = random.Random(1)
    strength = {m: 0.55 + 0.45 * rng.random() for m in methods}
    ceiling = {t: 0.55 + 0.35 * rng.random() for t in targets}
    curves = {(t, m): [curve(rng, strength[m], ceiling[t]) for _ in range(seeds)] for t in targets for m in methods}
    write_convergence(report, curves, methods, targets)
    write_profile(report, strength)
    write_ranks(report, strength, len(targets), rng)
    write_generations(report, targets[:2], rng)
    rows = [[f"{t}-{m}-{s}".replace(":", "-"), t, m, s, "done", values[s][-1], 5000]
            for (t, m), values in curves.items() for s in range(seeds)]
    write_csv(report / "results.csv", "run,target,optimizer,seed,status,fitness,evaluations", rows)
    thumbnails = [write_run(report, row) for row in rows[:runs]]
    files = ["ranks_fitness", "friedman_fitness", "results"]
    write_meta(report, meta("fits", "Which optimiser fits trees best?", thumbnails=thumbnails,
                            tables=[{"file": f"{name}.csv", "title": name.capitalize()} for name in files]))


def write_meta(report, content):
    (report / "meta.json").write_text(json.dumps(content, indent=1), encoding="utf-8")


def write_run(report, row):
    run = report.parent / "runs" / row[0]
    for i, name in enumerate(["target", "best", "overlay"]):
        write_png(run / f"{name}.png", 96, f"{row[0]}{i}")
    return {"run": row[0], "target": f"../runs/{row[0]}/target.png", "result": f"../runs/{row[0]}/best.png",
            "overlay": f"../runs/{row[0]}/overlay.png", "fitness": row[5],
            "label": f"{row[1]}, {row[2]}, seed {row[3]}"}


def quartiles(values):
    values = sorted(values)
    return [values[round(p * (len(values) - 1))] for p in (0.25, 0.5, 0.75)]


def write_convergence(report, curves, methods, targets):
    rows = []
    for target in targets + ["all"]:
        for method in methods:
            runs = [run for t in (targets if target == "all" else [target]) for run in curves[t, method]]
            rows += [[target, method, evaluations, *quartiles([run[i] for run in runs]), len(runs), 20]
                     for i, evaluations in enumerate(GRID)]
    write_csv(report / "convergence.csv", "target,optimizer,evaluations,q25,median,q75,runs,starts", rows)


def write_profile(report, strength):
    rows = [[m, n, min(1, max(0, (math.log(n) / math.log(5000)) ** 2 * (s - 0.4) * 1.7))]
            for m, s in strength.items() for n in GRID]
    write_csv(report / "data_profile.csv", "optimizer,evaluations,share", rows)


def write_ranks(report, strength, blocks, rng):
    order = sorted(strength, key=lambda m: -strength[m])
    k = len(order)
    ranks = [(i + 1) * 0.8 + 0.1 * k + rng.gauss(0, 0.3) for i in range(k)]
    ranks.sort()
    difference = 3.8 * math.sqrt(k * (k + 1) / 6 / blocks)
    rows = [[m, rank, letters, 0.5 + strength[m] / 3, rng.uniform(3, 60), blocks]
            for m, rank, letters in zip(order, ranks, group_letters(ranks, difference))]
    write_csv(report / "ranks_fitness.csv", "optimizer,mean_rank,group,median,median_seconds,runs", rows)
    write_csv(report / "friedman_fitness.csv", "statistic,value",
              [["blocks", blocks], ["treatments", k], ["chi_squared", 1234.5678], ["degrees_of_freedom", k - 1],
               ["p_value", 1.2e-40], ["iman_davenport_f", 51.2], ["iman_davenport_p", 0],
               ["critical_difference", difference], ["alpha", 0.05]])


def group_letters(ranks, difference):
    letters, last_end = [""] * len(ranks), -1
    group = 0
    for first, rank in enumerate(ranks):
        end = max(j for j, other in enumerate(ranks) if other - rank <= difference)
        if end > last_end:
            for j in range(first, end + 1):
                letters[j] += chr(97 + group % 26) + (str(group // 26 + 1) if group >= 26 else "")
            group, last_end = group + 1, end
    return letters


def write_generations(report, targets, rng):
    rows = []
    for target in targets:
        for method, gain in [("hewitt_ga", 0.9), ("cma_es", 1.0)]:
            for seed in (1, 2):
                best = 0
                for generation in range(1, 101):
                    batch = gain * (0.8 + 0.185 * (1 - math.exp(-generation / 25))) + rng.gauss(0, 0.006)
                    best = max(best, min(batch, 0.99))
                    stage = "starts" if generation <= 2 else "search"
                    rows.append([target, method, seed, generation * 30, generation, batch, best, stage])
    write_csv(report / "generations.csv", "target,optimizer,seed,evaluations,generation,batch_best,best,stage", rows)


def write_growth(report, species, seeds, lsystems=()):
    rng, rows, boxes = random.Random(2), [], []
    for i, name in enumerate(species):
        middle = 10 ** (2.3 + 2.7 * i / len(species))
        sizes = sorted(middle * math.exp(rng.gauss(0, 0.05 + 0.3 * rng.random())) for _ in range(seeds))
        leaves = 0 if i == 2 else middle * 3
        for seed, knots in enumerate(sizes):
            of_tree = round(leaves * knots / middle)
            rows.append([name, "weber_penn", seed + 1, round(knots), of_tree, 1e-7 * knots * rng.uniform(0.8, 1.5),
                         3e-8 * of_tree * rng.uniform(0.8, 1.5), "", ""])
        boxes.append([name, "weber_penn", sizes[0], *quartiles(sizes), sizes[-1]])
    for name in lsystems:
        sizes = sorted(1000 * math.exp(rng.gauss(0, 0.3)) for _ in range(seeds))
        rows += [[name, f"{name}.lsys", seed + 1, round(knots), 100, "", "", 2e-7 * knots, 1e-7 * knots]
                 for seed, knots in enumerate(sizes)]
        boxes.append([name, f"{name}.lsys", sizes[0], *quartiles(sizes), sizes[-1]])
    write_csv(report / "growth_times.csv", "species,model,seed,knots,leaves,stem_seconds,leaf_seconds,"
              "derivation_seconds,interpretation_seconds", rows)
    write_csv(report / "growth_complexity.csv", "species,model,min,q25,median,q75,max", boxes)
    if lsystems:
        write_csv(report / "growth_lsystems.csv", "species,model,exponent,standard_error,points",
                  [[name, f"{name}.lsys", 1.3, 0.02, seeds] for name in lsystems])
    write_csv(report / "growth_fit.csv", "what,exponent,standard_error,factor,points",
              [["stems", 1.01, 0.004, 1.05e-7, len(rows)], ["leaves", 0.99, 0.005, 3.3e-8, len(rows)]])
    write_meta(report, meta("growth", "How long does a tree take?",
                            tables=[{"file": "growth_fit.csv", "title": "Fits"}]))


def write_pictures(report, rows, columns):
    cells = []
    for i, row in enumerate(rows):
        cells.append([f"../runs/{i}-{j}/picture.png" for j in range(len(columns))])
        for j in range(len(columns)):
            write_png(report / cells[i][j], 96, f"{i}-{j}")
    cells[-1][-1] = ""
    sheet = {"rows": rows, "columns": columns, "cells": cells}
    write_meta(report, meta("pictures", "What radius_mod does", sheet=sheet))


def fresh(directory, kind):
    report = pathlib.Path(directory) / kind / "report"
    report.mkdir(parents=True, exist_ok=True)
    return report


def main():
    write_fits(fresh(sys.argv[1], "fits"), METHODS, TARGETS, 5, runs=12)
    write_growth(fresh(sys.argv[1], "growth"), SPECIES, 100)
    write_pictures(fresh(sys.argv[1], "pictures"), ["quaking_aspen", "lombardy_poplar"],
                   ["radius_mod 0.5", "radius_mod 1", "radius_mod 1.5", "radius_mod 2"])


if __name__ == "__main__":
    main()
