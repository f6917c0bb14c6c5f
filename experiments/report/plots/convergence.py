"""Convergence: the best fitness so far over true evaluations, the median of all runs and the band of the quartiles.

Rings mark where starts end. The lines join the points of the table, which are close. One figure for all targets together,
one with a panel a target."""

import matplotlib.pyplot as plt

import style
from plots.order import best_first
from read import column, grouped, number, read_table

COLUMNS = {"target": str, "optimizer": str, "evaluations": number, "q25": number, "median": number, "q75": number,
           "starts": number}
YOUNGER = ["starts"]


BANDS = 3  # more than these hide each other: where there are more methods, only the best have bands


def draw(directory, meta):
    rows = read_table(directory / "convergence.csv", COLUMNS, YOUNGER)
    if not rows:
        return {}
    targets = grouped(rows, "target")
    names = best_first(directory, meta, [row["optimizer"] for row in rows])
    figures = {}
    if "all" in targets:
        figures["convergence"] = draw_one(targets.pop("all"), names, meta)
    if targets:
        figures["convergence_targets"] = draw_targets(targets, names, meta)
    return figures


def draw_one(rows, names, meta):
    figure, axes = plt.subplots(figsize=(7, 4.4))
    styles = style.line_styles(names)
    draw_curves(axes, rows, styles)
    label(axes, meta)
    axes.set_title("All targets: median of all runs, " + band_words(names), loc="left")
    style.add_legend(axes, names, styles, loc="upper left", bbox_to_anchor=(1.01, 1))
    return figure


def draw_targets(targets, names, meta):
    """Small panels, which share the evaluations but not the fitness: targets differ in what can be reached."""
    figure, axes = style.panels(len(targets), sharex=True, layout="constrained")
    styles = style.line_styles(names)
    for panel, (target, rows) in zip(axes, targets.items()):
        draw_curves(panel, rows, styles, linewidth=1.1)
        style.log_axis(panel.xaxis)
        panel.set_title(target, loc="left")
        panel.tick_params(labelsize=8)
    published = style.draw_published(axes, meta)
    figure.supxlabel("evaluations", fontsize=10)
    figure.supylabel(style.fitness_label(meta), fontsize=10)
    style.add_legend(figure, names, styles, published, loc="upper center", bbox_to_anchor=(0.5, 0), ncols=4)
    return figure


def draw_curves(axes, rows, styles, **options):
    curves = grouped(rows, "optimizer")
    banded = with_bands(list(styles))
    for name, how in styles.items():
        curve = curves.get(name, [])
        evaluations = column(curve, "evaluations")
        axes.plot(evaluations, column(curve, "median"), **{**options, **how})
        mark_starts(axes, curve, how)
        if name in banded:
            axes.fill_between(evaluations, column(curve, "q25"), column(curve, "q75"), color=how["color"],
                              alpha=0.15, linewidth=0, zorder=1)


def mark_starts(axes, curve, how):
    """A ring on the median where the starts end and the search begins."""
    after = [row for row in curve if row["starts"] is not None and row["evaluations"] >= row["starts"]]
    if after and style.stands_out(how):
        style.mark_end(axes, after[0]["evaluations"], after[0]["median"], how)


def with_bands(names):
    return names if len(names) <= BANDS + 1 else names[:BANDS]


def band_words(names):
    few = len(with_bands(names)) < len(names)
    return "bands between the quartiles" + (f" ({BANDS} best methods)" if few else "")


def label(axes, meta):
    style.log_axis(axes.xaxis)
    axes.set_xlabel("evaluations (ring: the starts end)")
    axes.set_ylabel(style.fitness_label(meta))
