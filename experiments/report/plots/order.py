"""The order of optimizers, best first, which gives every plot of a report the same colours."""

from read import number, read_table


def best_first(directory, meta, names):
    """The names by mean rank in the first measure that has a table; the others follow in their own order."""
    tables = [read_table(directory / f"ranks_{measure}.csv", {"optimizer": str, "mean_rank": number})
              for measure in meta["ranked_by"]]
    ranks = next((table for table in tables if table), [])
    known = {row["optimizer"]: row["mean_rank"] for row in ranks if row["mean_rank"] is not None}
    return sorted(dict.fromkeys(names), key=lambda name: known.get(name, float("inf")))
