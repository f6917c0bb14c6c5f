"""How long trees take to grow: by species (the dissertation's Fig. 4.4), and against their size (Fig. 4.5)."""

import math

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D

import style
from read import column, grouped, number, read_table

COLUMNS = {"species": str, "seed": str, "knots": number, "leaves": number, "stem_seconds": number,
           "leaf_seconds": number}
FIT_COLUMNS = {"what": str, "exponent": number, "standard_error": number, "factor": number}
PUBLISHED_EXPONENT = 2.7  # the dashed line of Fig. 4.5A


def draw(directory, meta):
    rows = read_table(directory / "growth_times.csv", COLUMNS)
    if not rows:
        return {}
    fits = read_table(directory / "growth_fit.csv", FIT_COLUMNS) or []
    return {"growth_times": draw_species(rows), "growth_size": draw_sizes(rows, fits)}


def median(values):
    values = sorted(value for value in values if not math.isnan(value))
    return values[len(values) // 2] if values else 0


def draw_species(rows):
    """A strip a species: a mark a tree, stems above leaves, the slowest species below."""
    species = sorted(grouped(rows, "species").items(), key=lambda item: median(column(item[1], "stem_seconds")))
    figure, axes = plt.subplots(figsize=(7, 0.34 * len(species) + 1.2))
    for place, (_, trees) in enumerate(species):
        draw_strip(axes, column(trees, "stem_seconds"), place - 0.17, style.BLUE)
        draw_strip(axes, column(trees, "leaf_seconds"), place + 0.17, style.ORANGE)
    style.log_axis(axes.xaxis)
    axes.set_xlabel("time of one tree (ms)")
    axes.set_yticks(range(len(species)), [name for name, _ in species])
    axes.set_ylim(len(species) - 0.5, -0.5)
    add_time_legend(axes)
    return figure


def draw_strip(axes, seconds, place, colour):
    """The marks lie on one line; a black stroke is their median. What took no time has no place on a log scale."""
    milliseconds = [1000 * value for value in seconds if value > 0]
    axes.plot(milliseconds, [place] * len(milliseconds), "o", color=colour, markersize=3.5, alpha=0.35,
              markeredgewidth=0, rasterized=True)
    if milliseconds:
        axes.plot([median(milliseconds)], [place], "|", color=style.BLACK, markersize=8)


def add_time_legend(axes):
    marks = [Line2D([], [], marker="o", linestyle="", color=colour, markersize=4) for colour in
             (style.BLUE, style.ORANGE)]
    marks.append(Line2D([], [], marker="|", linestyle="", color=style.BLACK, markersize=8))
    axes.legend(marks, ["stems", "leaves", "median"], loc="lower left", bbox_to_anchor=(0, 1), ncols=3)


def draw_sizes(rows, fits):
    figure, (stems, leaves) = plt.subplots(1, 2, figsize=(11, 4.2), layout="constrained")
    draw_cloud(stems, rows, "knots", "stem_seconds", fit_of(fits, False))
    draw_cloud(leaves, rows, "leaves", "leaf_seconds", fit_of(fits, True))
    stems.set(xlabel="knots of the stems", ylabel="time of the stems (ms)")
    leaves.set(xlabel="leaves", ylabel="time of the leaves (ms)")
    add_published_slope(stems, rows)
    for axes in (stems, leaves):
        if axes.get_legend_handles_labels()[0]:
            axes.legend(loc="upper left", fontsize=8)
    return figure


def fit_of(fits, of_leaves):
    """The fit whose name speaks of leaves, or of anything else."""
    return next((fit for fit in fits if ("lea" in fit["what"]) == of_leaves and fit["exponent"] is not None), None)


def points(rows, size, time):
    return [(row[size], 1000 * row[time]) for row in rows if row[size] and row[time] and row[time] > 0]


def draw_cloud(axes, rows, size, time, fit):
    """Trees of all species alike: the line through them is what is asked about."""
    pairs = points(rows, size, time)
    style.log_axis(axes.xaxis)
    style.log_axis(axes.yaxis)
    if not pairs:
        return
    axes.plot(*zip(*pairs), "o", color=style.BLUE, markersize=3.5, alpha=0.35, markeredgewidth=0, rasterized=True)
    if fit:
        ends = [min(x for x, _ in pairs), max(x for x, _ in pairs)]
        error = f" ± {fit['standard_error']:.1g}" if fit["standard_error"] is not None else ""
        axes.plot(ends, [1000 * fit["factor"] * x ** fit["exponent"] for x in ends], color=style.VERMILLION,
                  label=f"fitted exponent {fit['exponent']:.3f}{error}")


def add_published_slope(axes, rows):
    """The dissertation's slope through the middle of our points; its constant was that of another machine."""
    pairs = points(rows, "knots", "stem_seconds")
    if not pairs:
        return
    sizes = sorted(x for x, _ in pairs)
    x0, y0 = math.sqrt(sizes[0] * sizes[-1]), median([y for _, y in pairs])
    limits = axes.get_ylim()
    axes.plot([sizes[0], sizes[-1]], [y0 * (x / x0) ** PUBLISHED_EXPONENT for x in (sizes[0], sizes[-1])],
              color=style.BLACK, linestyle="--", linewidth=1, label=f"published exponent {PUBLISHED_EXPONENT}")
    axes.set_ylim(limits)
