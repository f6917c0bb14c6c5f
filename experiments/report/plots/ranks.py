"""Critical difference diagram (Demšar 2006, Fig. 1), turned so that dozens of methods can be read: a row a method,
the best on top, a dot at its mean rank. Vertical bars on the right join those that do not differ significantly."""

import re

import matplotlib.pyplot as plt

import style
from read import number, read_table

COLUMNS = {"optimizer": str, "mean_rank": number, "group": str}
LETTER = re.compile(r"[a-z]\d*")


def draw(directory, meta):
    figures = {}
    for measure in meta["ranked_by"]:
        rows = read_table(directory / f"ranks_{measure}.csv", COLUMNS)
        rows = sorted((row for row in rows or [] if row["mean_rank"] is not None), key=lambda row: row["mean_rank"])
        if not rows:
            continue
        friedman = read_table(directory / f"friedman_{measure}.csv", {"statistic": str, "value": number}) or []
        figures[f"ranks_{measure}"] = draw_rows(rows, {row["statistic"]: row["value"] for row in friedman})
    return figures


def draw_rows(rows, friedman):
    lanes = group_spans(rows)
    height, width = 0.215 * len(rows), 0.14 * len(lanes)
    figure, (axes, groups) = plt.subplots(
        1, 2, sharey=True, figsize=(5.2 + width, height + 0.9), width_ratios=[5, max(width, 0.4)],
        gridspec_kw={"wspace": 0})
    for place in range(0, len(rows), 2):  # lead the eye from a name to its bars
        axes.axhspan(place - 0.5, place + 0.5, color="#F3F3F3", linewidth=0, zorder=0)
        groups.axhspan(place - 0.5, place + 0.5, color="#F3F3F3", linewidth=0, zorder=0)
    draw_dots(axes, rows)
    draw_groups(groups, lanes)
    draw_critical_difference(axes, rows, friedman.get("critical_difference"))
    axes.set_title(test_line(friedman), loc="left", fontsize=9, pad=26)
    return figure


def draw_dots(axes, rows):
    ranks = [row["mean_rank"] for row in rows]
    places = range(len(rows))
    axes.scatter(ranks, places, s=22, color=style.BLUE, zorder=3)
    for place, rank in enumerate(ranks):
        axes.annotate(f"{rank:.1f}", (rank, place), xytext=(6, 0), textcoords="offset points", va="center", fontsize=7)
    axes.set_yticks(places, [row["optimizer"] for row in rows], fontsize=8)
    axes.set_ylim(len(rows) - 0.5, -0.5)
    axes.margins(x=0.08)
    axes.grid(False)
    axes.tick_params(axis="y", length=0)
    axes.set_xlabel("mean rank (1 is the best)")


def draw_critical_difference(axes, rows, difference):
    """A ruler of that length above the rows, from the best rank on."""
    if difference is None:
        return
    best = rows[0]["mean_rank"]
    above = axes.get_xaxis_transform()
    axes.plot([best, best + difference], [1, 1], transform=above, clip_on=False, color=style.BLACK, marker="|",
              linewidth=1.2)
    axes.annotate(f"critical difference {difference:.2f}", (best, 1), xycoords=above, xytext=(0, 5),
                  textcoords="offset points", fontsize=8)


def draw_groups(axes, lanes):
    for lane, (letter, first, last) in enumerate(lanes):
        axes.plot([lane, lane], [first - 0.3, last + 0.3], color=style.BLACK, linewidth=2.2, solid_capstyle="butt")
        axes.annotate(letter, (lane, first - 0.35), ha="center", va="bottom", fontsize=6)
    axes.set_xlim(-0.8, max(len(lanes), 3) - 0.2)
    axes.axis("off")


def group_spans(rows):
    """(letter, first row, last row) of each group; rows are sorted by rank, so a group has no gaps."""
    spans = {}
    for place, row in enumerate(rows):
        for letter in LETTER.findall(row["group"]):
            spans[letter] = (spans.get(letter, (place,))[0], place)
    return [(letter, *span) for letter, span in spans.items()]


def test_line(friedman):
    if friedman.get("p_value") is None:
        return "Mean ranks"
    return (f"Friedman: χ² = {friedman['chi_squared']:.1f}, {friedman['degrees_of_freedom']:.0f} degrees of freedom, "
            f"p = {friedman['p_value']:.2g}, {friedman['blocks']:.0f} blocks")
