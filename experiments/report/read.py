"""Reads the files of a report directory: meta.json, and tables whose columns are known.

A broken file is a ReportError of one line: where, what was got, what was expected."""

import csv
import json
import math

KINDS = ["fits", "pictures", "growth"]


class ReportError(Exception):
    """Bad input; the program prints its one line and exits 2."""


def read_meta(directory):
    """What the page says about the experiment; keys that are not there have empty values."""
    path = directory / "meta.json"
    try:
        meta = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ReportError(f"{path}: got no file ({error.strerror}), expected one that "
                          "`espalier experiment report` has written") from None
    except (UnicodeDecodeError, json.JSONDecodeError) as error:
        raise ReportError(f"{path}: got no JSON ({error}), expected an object") from None
    if not isinstance(meta, dict) or not isinstance(meta.get("name"), str):
        raise ReportError(f"{path}: got no \"name\", expected an object with the experiment's name")
    if meta.get("kind") not in KINDS:
        raise ReportError(f"{path}: kind: got {meta.get('kind')!r}, expected one of {', '.join(KINDS)}")
    for key in ["tables", "thumbnails", "ranked_by"]:
        if not isinstance(meta.setdefault(key, []), list):
            raise ReportError(f"{path}: {key}: got {type(meta[key]).__name__}, expected a list")
    return meta


def number(text):
    """A finite number; None where the cell is empty or says that there is no number."""
    if text in ("", "nan", "-nan", "inf", "-inf"):
        return None
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(text)
    return value


def read_rows(path):
    """All rows of a CSV file as lists of text, the header first; every row has the header's length."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = [row for row in csv.reader(file, strict=True)]
    except OSError as error:
        raise ReportError(f"{path}: {error.strerror}") from None
    except (csv.Error, UnicodeDecodeError) as error:
        raise ReportError(f"{path}: got no CSV ({error})") from None
    if not rows:
        raise ReportError(f"{path}: got an empty file, expected a header")
    for line, row in enumerate(rows, 1):
        if len(row) != len(rows[0]):
            raise ReportError(f"{path}:{line}: got {len(row)} cells, expected {len(rows[0])} as in the header")
    return rows


def read_table(path, columns, younger=()):
    """The rows of a CSV file as dictionaries. columns: the function that reads each column (str or number);
    further columns are left out. younger: those that tables of earlier versions lack, whose cells are then None.
    None where there is no such file."""
    if not path.exists():
        return None
    header, *rows = read_rows(path)
    missing = [name for name in columns if name not in header and name not in younger]
    if missing:
        raise ReportError(f"{path}:1: got no column {missing[0]}, expected {','.join(columns)}")
    there = {name: convert for name, convert in columns.items() if name in header}
    lacking = dict.fromkeys(name for name in columns if name not in header)
    return [{**read_row(path, line, dict(zip(header, row)), there), **lacking} for line, row in enumerate(rows, 2)]


def read_row(path, line, row, columns):
    result = {}
    for name, convert in columns.items():
        try:
            result[name] = convert(row[name])
        except ValueError:
            raise ReportError(f"{path}:{line}: {name}: got \"{row[name]}\", expected a number") from None
    return result


def grouped(rows, *keys):
    """The rows by the value (or the tuple of values) of these columns, in the order in which they appear."""
    groups = {}
    for row in rows:
        key = row[keys[0]] if len(keys) == 1 else tuple(row[k] for k in keys)
        groups.setdefault(key, []).append(row)
    return groups


def column(rows, name):
    """The numbers of a column; cells without one are NaN, which Matplotlib leaves out."""
    return [math.nan if row[name] is None else row[name] for row in rows]
