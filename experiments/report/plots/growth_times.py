"""How long trees take to grow: by species (the dissertation's Fig. 4.4), and against their size (Fig. 4.5, 4.6)."""

import math

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D

import style
from read import column, grouped, number, read_table

COLUMNS = {"species": str, "model": str, "seed": str, "knots": number, "leaves": number, "stem_seconds": number,
           "leaf_seconds": number, "derivation_seconds": number, "interpretation_seconds": number}
YOUNGER = ["model", "derivation_seconds", "interpretation_seconds"]
FIT_COLUMNS = {"what": str, "exponent": number, "standard_error": number, "factor": number}
LSYSTEM_COLUMNS = {"species": str, "exponent": number, "standard_error": number}
PUBLISHED_EXPONENT = 2.7  # the dashed line of Fig. 4.5A
PHASES = {"stem_seconds": ("stems", style.BLUE), "leaf_seconds": ("leaves", style.ORANGE),
          "derivation_seconds": ("L-system: derivation", style.GREEN),
          "interpretation_seconds": ("L-system: interpretation", style.PURPLE)}


def draw(directory, meta):
    rows = read_table(directory / "growth_times.csv", COLUMNS, YOUNGER)
    if not rows:
        return {}
    fits = read_table(directory / "growth_fit.csv", FIT_COLUMNS) or []
    figures = {"growth_times": draw_species(rows)}
    if phases_of(rows)[:1] == ["stem_seconds"]:
        figures["growth_size"] = draw_sizes(rows, fits)
    if "interpretation_seconds" in phases_of(rows):
        laws = read_table(directory / "growth_lsystems.csv", LSYSTEM_COLUMNS) or []
        figures["growth_lsystems"] = draw_lsystems(rows, laws)
    return figures


def median(values):
    values = sorted(value for value in values if not math.isnan(value))
    return values[len(values) // 2] if values else 0


def phases_of(rows):
    """The phases that these trees have."""
    return [phase for phase in PHASES if any(row[phase] is not None for row in rows)]


def is_lsystem(model):
    return bool(model) and model.endswith(".lsys")


def tree_name(species, model):
    return f"{species}, L-system" if is_lsystem(model) else species


def tree_order(rows):
    """Species by the time that they take, the L-system of a species below it."""
    def seconds(trees):
        return sum(median(column(trees, phase)) for phase in phases_of(trees))
    slowest = {species: max(seconds(trees) for trees in grouped(of, "model").values())
               for species, of in grouped(rows, "species").items()}
    trees = grouped(rows, "species", "model").items()
    return sorted(trees, key=lambda item: (slowest[item[0][0]], item[0][0], is_lsystem(item[0][1])))


def draw_species(rows):
    """Two strips a tree, a mark a seed: stems above leaves, derivation above interpretation; the slowest species
    below."""
    trees = tree_order(rows)
    figure, axes = plt.subplots(figsize=(7, 0.34 * len(trees) + 1.2))
    for place, (_, of) in enumerate(trees):
        for phase, offset in zip(phases_of(of), (-0.17, 0.17)):
            draw_strip(axes, column(of, phase), place + offset, PHASES[phase][1])
    style.log_axis(axes.xaxis)
    axes.set_xlabel("time of one tree (ms)")
    axes.set_yticks(range(len(trees)), [tree_name(*names) for names, _ in trees])
    axes.set_ylim(len(trees) - 0.5, -0.5)
    add_time_legend(axes, phases_of(rows))
    return figure


def draw_strip(axes, seconds, place, colour):
    """The marks lie on one line; a black stroke is their median. What took no time has no place on a log scale."""
    milliseconds = [1000 * value for value in seconds if value > 0]
    axes.plot(milliseconds, [place] * len(milliseconds), "o", color=colour, markersize=3.5, alpha=0.35,
              markeredgewidth=0, rasterized=True)
    if milliseconds:
        axes.plot([median(milliseconds)], [place], "|", color=style.BLACK, markersize=8)


def add_time_legend(axes, phases):
    marks = [Line2D([], [], marker="o", linestyle="", color=PHASES[phase][1], markersize=4) for phase in phases]
    marks.append(Line2D([], [], marker="|", linestyle="", color=style.BLACK, markersize=8))
    axes.legend(marks, [PHASES[phase][0] for phase in phases] + ["median"], loc="lower left", bbox_to_anchor=(0, 1),
                ncols=3)


def draw_sizes(rows, fits):
    figure, (stems, leaves) = plt.subplots(1, 2, figsize=(11, 4.2), layout="constrained")
    draw_cloud(stems, rows, "knots", "stem_seconds", fit_of(fits, "stem"))
    draw_cloud(leaves, rows, "leaves", "leaf_seconds", fit_of(fits, "lea"))
    stems.set(xlabel="knots of the stems", ylabel="time of the stems (ms)")
    leaves.set(xlabel="leaves", ylabel="time of the leaves (ms)")
    add_published_slope(stems, rows)
    for axes in (stems, leaves):
        if axes.get_legend_handles_labels()[0]:
            axes.legend(loc="upper left", fontsize=8)
    return figure


def draw_lsystems(rows, laws):
    """A cloud an L-system: how long the interpretation of its strings takes, against the size that comes of it."""
    figure, axes = plt.subplots(figsize=(7, 4.2))
    style.log_axis(axes.xaxis)
    style.log_axis(axes.yaxis)
    clouds = {species: points(of, "knots", "interpretation_seconds") for species, of in grouped(rows, "species").items()}
    clouds = {species: pairs for species, pairs in clouds.items() if pairs}
    for species, colour in zip(clouds, style.COLOURS * len(clouds)):
        law = next((law for law in laws if law["species"] == species and law["exponent"] is not None), None)
        words = f": exponent {law['exponent']:.2f}{error_of(law)}" if law else ""
        axes.plot(*zip(*clouds[species]), "o", color=colour, markersize=3.5, alpha=0.5, markeredgewidth=0,
                  rasterized=True, label=species + words)
    axes.set(xlabel="knots of the stems", ylabel="time of the interpretation (ms)")
    axes.legend(loc="upper left", fontsize=8)
    return figure


def error_of(law):
    return f" ± {law['standard_error']:.1g}" if law["standard_error"] is not None else ""


def fit_of(fits, start):
    """The fit whose name begins so."""
    return next((fit for fit in fits if fit["what"].startswith(start) and fit["exponent"] is not None), None)


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
        axes.plot(ends, [1000 * fit["factor"] * x ** fit["exponent"] for x in ends], color=style.VERMILLION,
                  label=f"fitted exponent {fit['exponent']:.2f}{error_of(fit)}")


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
