"""A sheet of pictures: rows × columns with their labels, as the dissertation's plates of effects (Fig. 3.2 to 3.9)."""

import matplotlib.pyplot as plt

from read import ReportError


def draw(directory, meta):
    sheet = meta.get("sheet")
    if not sheet or not sheet.get("cells"):
        return {}
    check(directory, sheet)
    rows, columns = len(sheet["rows"]), len(sheet["columns"])
    figure, axes = plt.subplots(rows, columns, figsize=(1.9 * columns, 1.9 * rows), squeeze=False,
                                gridspec_kw={"wspace": 0.04, "hspace": 0.04})
    for i, label in enumerate(sheet["rows"]):
        axes[i][0].set_ylabel(label, fontsize=9)
        for j in range(columns):
            draw_cell(axes[i][j], directory, sheet["cells"][i][j])
    for j, label in enumerate(sheet["columns"]):
        axes[0][j].set_title(label, fontsize=9)
    return {"sheet": figure}


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
