"""The progress of fits to goals, as the dissertation's Fig. 4.9: pixel accuracy by evaluations, a panel a target.

Thick: the best so far; thin: the best of each generation, which may fall where nothing is kept of the last one."""

from matplotlib.lines import Line2D
from matplotlib.patches import Patch

import style
from read import column, grouped, number, read_table

COLUMNS = {"target": str, "optimizer": str, "seed": str, "evaluations": number, "generation": number,
           "batch_best": number, "best": number}
PUBLISHED = (95, 97)  # %, "over the course of a few hours": the dissertation, chapter 4
BAND = {"color": style.GREY, "alpha": 0.35, "linewidth": 0}


def draw(directory, meta):
    rows = read_table(directory / "generations.csv", COLUMNS)
    if not rows:
        return {}
    names = list(dict.fromkeys(row["optimizer"] for row in rows))
    styles = style.line_styles(names)
    targets = grouped(rows, "target")
    figure, axes = style.panels(len(targets), width=5, height=3.6, columns=2, sharey=True, layout="constrained")
    for panel, (target, of_target) in zip(axes, targets.items()):
        draw_target(panel, of_target, styles)
        panel.set_title(target, loc="left")
    for panel in axes[::2]:
        panel.set_ylabel("pixel accuracy (%)")
    add_legend(figure, names, styles)
    return {"generations": figure}


def draw_target(axes, rows, styles):
    for (name, _), run in grouped(rows, "optimizer", "seed").items():
        evaluations = column(run, "evaluations")
        axes.plot(evaluations, percent(run, "batch_best"), **{**styles[name], "linewidth": 0.6, "linestyle": "-"},
                  alpha=0.6)
        axes.plot(evaluations, percent(run, "best"), drawstyle="steps-post", **styles[name])
    axes.set_xlabel("evaluations")
    axes.axhspan(*PUBLISHED, zorder=0, **BAND)
    add_generations(axes, rows)


def percent(rows, name):
    return [100 * value for value in column(rows, name)]


def add_generations(axes, rows):
    """A second scale above the panel, where all methods have generations of one size."""
    sizes = {row["evaluations"] / row["generation"] for row in rows if row["generation"] and row["evaluations"]}
    if len(sizes) != 1:
        return
    size = sizes.pop()
    above = axes.secondary_xaxis("top", functions=(lambda x: x / size, lambda x: x * size))
    above.set_xlabel("generation")


def add_legend(figure, names, styles):
    band = Patch(**BAND)
    lines = [Line2D([], [], **styles[name]) for name in names]
    lines.append(Line2D([], [], color="#606060", linewidth=0.6))
    figure.legend(lines + [band], names + ["best of a generation", "published: 95–97 % after hours"],
                  loc="upper center", bbox_to_anchor=(0.5, 0), ncols=4, handlelength=3)
