"""A sheet of pictures: rows × columns with their labels, as the dissertation's plates of effects (Fig. 3.2 to 3.9). A
single row of many pictures goes on in further lines, as its plates of trees (appendix A)."""

import textwrap

import matplotlib.pyplot as plt

from read import ReportError

MOST_ACROSS = 8  # pictures beside each other, of a single row
SMALLEST, LARGEST = 1.9, 3.4  # inches of a picture's side
LABEL_WIDTH = 21  # letters above a picture


def draw(directory, meta):
    sheet = meta.get("sheet")
    if not sheet or not sheet.get("cells"):
        return {}
    check(directory, sheet)
    if len(sheet["rows"]) == 1 and len(sheet["columns"]) > MOST_ACROSS:
        return {"sheet": draw_lines(directory, sheet["columns"], sheet["cells"][0])}
    return {"sheet": draw_grid(directory, sheet)}


def draw_grid(directory, sheet):
    rows, columns = len(sheet["rows"]), len(sheet["columns"])
    side = max(SMALLEST, min(LARGEST, 10.2 / columns))
    figure, axes = plt.subplots(rows, columns, figsize=(side * columns, side * rows), squeeze=False,
                                gridspec_kw={"wspace": 0.04, "hspace": 0.04})
    for i, label in enumerate(sheet["rows"]):
        axes[i][0].set_ylabel(label, fontsize=9)
        for j in range(columns):
            draw_cell(axes[i][j], directory, sheet["cells"][i][j])
    for j, label in enumerate(sheet["columns"]):
        label_above(axes[0][j], label)
    return figure


def draw_lines(directory, labels, cells):
    """Lines of the same length, but for the last one, each picture below its label."""
    lines = -(-len(cells) // MOST_ACROSS)
    across = -(-len(cells) // lines)
    figure, axes = plt.subplots(lines, across, figsize=(SMALLEST * across, 1.18 * SMALLEST * lines), squeeze=False,
                                gridspec_kw={"wspace": 0.04, "hspace": 0.22})
    for i, place in enumerate(axes.flat):
        draw_cell(place, directory, cells[i] if i < len(cells) else "")
        label_above(place, labels[i] if i < len(cells) else "")
    return figure


def label_above(axes, label):
    axes.set_title(textwrap.fill(label, LABEL_WIDTH), fontsize=9)


def check(directory, sheet):
    """As many rows and columns of cells as there are labels."""
    shape = [len(row) for row in sheet["cells"]]
    expected = [len(sheet["columns"])] * len(sheet["rows"])
    if shape != expected:
        raise ReportError(f"{directory / 'meta.json'}: sheet: got rows of {shape} cells, expected {expected}")


def draw_cell(axes, directory, path):
    axes.set(xticks=[], yticks=[])
    axes.grid(False)
    for spine in axes.spines.values():
        spine.set(visible=bool(path), color="#D0D0D0")
    if not path:
        return
    if not (directory / path).exists():
        axes.text(0.5, 0.5, "no picture", ha="center", va="center", fontsize=8, transform=axes.transAxes)
        return
    try:
        pixels = plt.imread(directory / path)
    except (OSError, SyntaxError, ValueError) as error:  # what Pillow raises for a broken PNG
        raise ReportError(f"{directory / path}: got no picture ({error}), expected a PNG file") from None
    axes.imshow(pixels, cmap="gray", interpolation="none", vmin=0)
