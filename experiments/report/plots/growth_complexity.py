"""How complex the trees of each species are, as the dissertation's Fig. 4.7: knots of the stems, box by box."""

import matplotlib.pyplot as plt

import style
from plots.growth_times import is_lsystem, tree_name
from read import grouped, number, read_table

COLUMNS = {"species": str, "model": str, "min": number, "q25": number, "median": number, "q75": number, "max": number}
NUMBERS = ["min", "q25", "median", "q75", "max"]


def draw(directory, meta):
    rows = read_table(directory / "growth_complexity.csv", COLUMNS, ["model"])
    rows = [row for row in rows or [] if all(row[name] is not None for name in NUMBERS)]
    if not rows:
        return {}
    largest = {species: max(row["median"] for row in of) for species, of in grouped(rows, "species").items()}
    rows.sort(key=lambda row: (largest[row["species"]], row["species"], is_lsystem(row["model"])))
    figure, axes = plt.subplots(figsize=(7, 0.3 * len(rows) + 1.2))
    boxes = axes.bxp([box(row) for row in rows], vert=False, showfliers=False, widths=0.6, patch_artist=True,
                     boxprops={"facecolor": style.SKY, "linewidth": 0.8}, medianprops={"color": style.BLACK},
                     whiskerprops={"linewidth": 0.8}, capprops={"linewidth": 0.8})
    for patch, row in zip(boxes["boxes"], rows):
        patch.set_facecolor(style.PURPLE if is_lsystem(row["model"]) else style.SKY)
    axes.invert_yaxis()
    style.log_axis(axes.xaxis)
    axes.set_xlabel("knots of the stems")
    axes.set_title("Smallest, quartiles, median and largest of each species", loc="left")
    return {"growth_complexity": figure}


def box(row):
    return {"label": tree_name(row["species"], row["model"]), "whislo": row["min"], "q1": row["q25"],
            "med": row["median"], "q3": row["q75"], "whishi": row["max"]}
