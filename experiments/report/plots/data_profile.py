"""Data profiles: the share of (target, seed, level) that an optimizer has reached within so many evaluations.

Moré, Wild 2009; COCO's empirical runtime distributions (Hansen et al. 2021)."""

import matplotlib.pyplot as plt
from matplotlib.ticker import PercentFormatter

import style
from plots.order import best_first
from read import column, grouped, number, read_table

COLUMNS = {"optimizer": str, "evaluations": number, "share": number}


def draw(directory, meta):
    rows = read_table(directory / "data_profile.csv", COLUMNS)
    if not rows:
        return {}
    names = best_first(directory, meta, [row["optimizer"] for row in rows])
    styles = style.line_styles(names)
    figure, axes = plt.subplots(figsize=(7, 4.4))
    for name, curve in grouped(rows, "optimizer").items():
        axes.plot(column(curve, "evaluations"), column(curve, "share"), **styles[name])
    style.log_axis(axes.xaxis)
    axes.set_ylim(0, 1)
    axes.yaxis.set_major_formatter(PercentFormatter(1))
    axes.set_xlabel("evaluations")
    axes.set_ylabel("levels of fitness reached (%)")
    axes.set_title("Share of all (target, seed, level) reached so far", loc="left")
    style.add_legend(axes, names, styles, loc="upper left", bbox_to_anchor=(1.01, 1))
    return {"data_profile": figure}
