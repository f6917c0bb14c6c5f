"""The order of optimizers, best first, which gives every plot of a report the same colours."""

from read import number, read_table


def best_first(directory, names):
    """The names by mean rank where ranks.csv has them; the others follow in their own order."""
    ranks = read_table(directory / "ranks.csv", {"optimizer": str, "mean_rank": number}) or []
    known = {row["optimizer"]: row["mean_rank"] for row in ranks if row["mean_rank"] is not None}
    return sorted(dict.fromkeys(names), key=lambda name: known.get(name, float("inf")))
