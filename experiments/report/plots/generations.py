"""The progress of fits to goals, as the dissertation's Fig. 4.9: fitness by evaluations, a panel a target.

Rings: where starts and search end. Thick: the best so far; thin: the best of each generation, which may fall where nothing is kept of the last one."""

from matplotlib.lines import Line2D

import style
from read import column, grouped, number, read_table

COLUMNS = {"target": str, "optimizer": str, "seed": str, "evaluations": number, "generation": number,
           "batch_best": number, "best": number, "stage": str}
YOUNGER = ["stage"]
BELOW_BEST = 0.4  # of the range of the best so far: how far below it generations are shown


def draw(directory, meta):
    rows = read_table(directory / "generations.csv", COLUMNS, YOUNGER)
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
        panel.set_ylabel("pixel accuracy (%)" if meta.get("objective") == "pixel_accuracy"
                         else style.fitness_label(meta) + " (%)")
    axes[0].set_ylim(*limits(rows))
    add_legend(figure, style.draw_published(axes, meta, scale=100), names, styles)
    return {"generations": figure}


def limits(rows):
    """All of the best so far; single generations may be far worse."""
    best = percent(rows, "best")
    span = max(max(best) - min(best), 1)
    return min(best) - BELOW_BEST * span, max(best) + 0.05 * span


def draw_target(axes, rows, styles):
    for (name, _), run in grouped(rows, "optimizer", "seed").items():
        evaluations = column(run, "evaluations")
        axes.plot(evaluations, percent(run, "batch_best"), **{**styles[name], "linewidth": 0.6, "linestyle": "-"},
                  alpha=0.6)
        axes.plot(evaluations, percent(run, "best"), drawstyle="steps-post", **styles[name])
        for row in ends_of_stages(run):
            style.mark_end(axes, row["evaluations"], 100 * row["best"], styles[name])
    axes.set_xlabel("evaluations")
    add_generations(axes, rows)


def ends_of_stages(run):
    """The last row of the starts, and of all: where starts and search end."""
    starts = [row for row in run if row["stage"] == "starts" and row["best"] is not None]
    return starts[-1:] + [row for row in run[-1:] if starts and row["best"] is not None]


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


def add_legend(figure, published, names, styles):
    handles = [Line2D([], [], **styles[name]) for name in names]
    handles.append(Line2D([], [], color="#606060", linewidth=0.6))
    labels = names + ["best of a generation"]
    if published:
        handles.append(published[0])
        labels.append(published[1])
    figure.legend(handles, labels, loc="upper center", bbox_to_anchor=(0.5, 0), ncols=4, handlelength=3)
