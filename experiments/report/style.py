"""How every plot looks, and how it is saved: the same data give the same bytes.

Colours: Okabe, Ito, "Color Universal Design" (2008), told apart by colour-blind readers. Lines also differ in
their dashes, so that a print in grey can be read."""

import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

BLUE, VERMILLION, GREEN, ORANGE = "#0072B2", "#D55E00", "#009E73", "#E69F00"
PURPLE, SKY, BLACK, GREY = "#CC79A7", "#56B4E9", "#000000", "#B8B8B8"
COLOURS = [BLUE, VERMILLION, GREEN, ORANGE, PURPLE, SKY, BLACK]  # the yellow is too pale for lines on white
DASHES = ["-", "--", "-.", (0, (5, 1, 1, 1, 1, 1)), "-", "--", ":"]
FORMATS = {"svg": {"Date": None}, "png": {"Software": None}, "pdf": {"CreationDate": None, "Producer": None,
                                                                    "Creator": None}}

SETTINGS = {
    "svg.hashsalt": "espalier",  # else the ids in an SVG are random
    "figure.dpi": 100,
    "savefig.dpi": 150,
    "font.family": "DejaVu Sans",
    "font.size": 10,
    "axes.titlesize": 10,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#E4E4E4",
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
    "legend.frameon": False,
    "lines.linewidth": 1.6,
}


def use_style():
    """Matplotlib's defaults and ours, whatever the user's own matplotlibrc says."""
    matplotlib.rcdefaults()
    matplotlib.use("Agg")
    matplotlib.rcParams.update(SETTINGS)


def save(figure, directory, stem):
    """Writes stem.svg, stem.png and stem.pdf; the margins fit what is drawn. They are found once for all three,
    which takes as long as drawing one."""
    figure.draw_without_rendering()
    figure.set_layout_engine("none")  # its places stay as they are
    drawn = figure.get_tightbbox().padded(0.1)
    for extension, metadata in FORMATS.items():
        figure.savefig(directory / f"{stem}.{extension}", metadata=metadata, bbox_inches=drawn)
    plt.close(figure)


def line_styles(names):
    """Colour and dashes of each optimizer, best first: the first few stand out, the others are thin and grey."""
    styles = {}
    for i, name in enumerate(names):
        if i < len(COLOURS):
            styles[name] = {"color": COLOURS[i], "linestyle": DASHES[i], "zorder": 3 + 1 / (i + 1)}
        else:
            styles[name] = {"color": GREY, "linewidth": 0.7, "zorder": 2}
    return styles


def fitness_label(meta):
    """What fitness is, by the measures of the objective; in lines, for an axis."""
    objective = meta.get("objective")
    if not objective:
        return "fitness (1 - dissimilarity)"
    terms = [term.replace("*", "\N{NO-BREAK SPACE}") for term in objective.split("+")]
    return "\n".join(textwrap.wrap("fitness by " + " +\N{NO-BREAK SPACE}".join(terms), 46, break_long_words=False))


def mark_end(axes, x, y, style):
    """A ring on a line: where the starts end, or a run."""
    axes.plot([x], [y], marker="o", markersize=6, markerfacecolor="none", markeredgecolor=style["color"],
              linestyle="none", zorder=style.get("zorder", 3))


def stands_out(style):
    return style["color"] != GREY


def add_legend(target, names, styles, published=None, **place):
    """The lines that stand out by name, in order, one entry for the grey ones, and what draw_published() drew."""
    from matplotlib.lines import Line2D
    shown = [name for name in names if stands_out(styles[name])]
    lines = [Line2D([], [], **{k: v for k, v in styles[name].items() if k != "zorder"}) for name in shown]
    others = len(names) - len(shown)
    if others:
        lines.append(Line2D([], [], color=GREY, linewidth=0.7))
        shown.append(f"{others} others")
    if published:
        lines.append(published[0])
        shown.append(published[1])
    return target.legend(lines, shown, handlelength=3, **place)


def log_axis(axis):
    """A logarithmic axis with plain numbers: 0.1, 10, 1000, not powers of ten."""
    from matplotlib.ticker import FuncFormatter
    getattr(axis.axes, f"set_{axis.axis_name}scale")("log")
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.0f}" if value >= 1 else f"{value:g}"))


def panels(count, width=3.2, height=2.3, columns=4, **options):
    """A grid of `count` axes and its figure; the places left over stay empty."""
    columns = min(count, columns)
    rows = -(-count // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(width * columns, height * rows), squeeze=False, **options)
    flat = list(axes.flat)
    for axis in flat[count:]:
        axis.remove()
    return figure, flat[:count]


def draw_published(panels, meta, scale=1):
    """The range of fitness that the source found, as grey bands; (patch, label), or nothing where none is known."""
    published = meta.get("published_fitness")
    if not published:
        return None
    low, high = published
    bands = [panel.axhspan(scale * low, scale * high, color=GREY, alpha=0.35, linewidth=0, zorder=0) for panel in panels]
    return bands[0], f"published: {100 * low:g}–{100 * high:g} %"
