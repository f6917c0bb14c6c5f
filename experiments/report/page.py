"""index.html: one page with everything in it, so that it can be sent, archived and opened anywhere.

No scripts and nothing from the network; pictures are data: URIs, each SVG in its own, because ids repeat between
Matplotlib's SVGs."""

import base64
import html
import re

from read import read_rows

LARGEST_SVG = 400_000  # bytes; a larger one is shown as its PNG
OPEN_ROWS = 12  # a longer table is folded
SHOWN_ROWS = 200  # of a table; the file beside the page has them all

CAPTIONS = {
    "sheet": "The pictures, by row and column.",
    "generations": "Fitness by evaluations. Thick: the best so far; thin: the best of each generation. Grey band, where "
                   "there is one: what the source reports.",
    "convergence": "Best fitness so far over true evaluations (plants grown and compared): median of all runs; bands "
                   "between the quartiles (where there are many methods, of the best three). "
                   "The methods with the best mean ranks are in colour.",
    "convergence_targets": "The same for each target. Grey band, where there is one: what was published.",
    "data_profile": "Share of all (target, seed, level) that a method has reached within so many evaluations. Levels "
                    "lie between the median fitness of the first evaluations and the best that any run reached.",
    "ranks": "Mean ranks over the targets, by {measure}. Methods that a vertical bar joins do not differ significantly "
             "(Nemenyi's test at the level in the table).",
    "growth_times": "Time to grow one tree, by species and phase: a mark a tree.",
    "growth_size": "Time to grow against size, all trees of species, with the fitted power law; its error is that of as "
                   "many independent species, not trees.",
    "growth_lsystems": "Time to interpret the string of an L-system against the size of the plant, with the exponent "
                       "within its trees.",
    "growth_complexity": "Knots of the stems by species; those of L-systems are purple.",
}

STYLE = """
:root { color-scheme: light dark; --text: #1c1c1c; --page: #ffffff; --soft: #5c5c5c; --line: #d8d8d8; --card: #f5f5f3; }
@media (prefers-color-scheme: dark) {
  :root { --text: #e8e8e8; --page: #17191c; --soft: #a8a8a8; --line: #3a3d42; --card: #22252a; } }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1.5rem 1rem 4rem; max-width: 76rem; color: var(--text); background: var(--page);
  font: 16px/1.5 system-ui, sans-serif; overflow-wrap: break-word; }
h1 { line-height: 1.2; margin: 0 0 .3rem; } h2 { margin: 2.5rem 0 .6rem; }
.soft, figcaption { color: var(--soft); } figcaption { font-size: .9rem; max-width: 60rem; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 20rem), 1fr)); gap: 1rem; }
.card { background: var(--card); border: 1px solid var(--line); border-radius: .4rem; padding: .8rem 1rem; }
.card h2 { margin: 0 0 .3rem; font-size: 1rem; } .card p { margin: 0; white-space: pre-line; }
figure { margin: 1rem 0 2rem; }
.plot { display: block; max-width: 100%; height: auto; background: #fff; border-radius: .4rem; padding: .4rem; }
.scroll { overflow-x: auto; } table { border-collapse: collapse; font-size: .85rem; }
th, td { padding: .2rem .6rem; border-bottom: 1px solid var(--line); text-align: left; white-space: nowrap; }
.number { text-align: right; font-variant-numeric: tabular-nums; }
details { margin: 1rem 0; } summary { cursor: pointer; font-weight: 600; }
.runs { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 21rem), 1fr)); gap: 1rem; }
.runs figure { margin: 0; } .row { display: grid; grid-auto-columns: 1fr; grid-auto-flow: column; gap: .3rem; }
.row img, .row span { width: 100%; background: #fff; display: block; }
.row span { color: #555; font-size: .8rem; padding: .5rem; }
.score { margin: 1rem 0; } .score figure { margin: 0; }
pre { background: var(--card); border: 1px solid var(--line); border-radius: .4rem; padding: .8rem 1rem;
  overflow-x: auto; font-size: .85rem; }
"""


def write_page(directory, meta, stems):
    """stems: of the plots, in the order of the page; None where Matplotlib is missing."""
    parts = [head(meta), source_beside_ours(meta), score_sheet(directory, meta), plots(directory, stems),
             tables(directory, meta), thumbnails(directory, meta), repeat(meta), "</body>\n</html>\n"]
    (directory / "index.html").write_text("\n".join(part for part in parts if part), encoding="utf-8")


def text(value):
    """A value of meta.json as HTML; lists are lines, objects are lines of key and value."""
    if isinstance(value, dict):
        value = [f"{key}: {item}" for key, item in value.items()]
    if isinstance(value, list):
        value = "\n".join(str(item) for item in value)
    return html.escape("" if value is None else str(value))


def head(meta):
    title = text(meta.get("title") or meta["name"])
    return (f"<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
            f"<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
            f"<title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n"
            f"<p class=\"soft\">Experiment <code>{text(meta['name'])}</code></p>")


def card(title, value):
    return f"<section class=\"card\"><h2>{title}</h2><p>{text(value)}</p></section>" if value else ""


def source_beside_ours(meta):
    figure = meta.get("figure")
    published = card("Published" + (f": {text(figure)}" if figure else ""), meta.get("published") or
                     ("See the source." if figure else ""))
    ours = card("Found here", meta.get("found"))
    note = f"<p>{text(meta['note'])}</p>" if meta.get("note") else ""
    return note + (f"<div class=\"pair\">{published}{ours}</div>" if published or ours else "")


def plots(directory, stems):
    if stems is None:
        return "<h2>Plots</h2>\n<p>There are none: Matplotlib (Debian's python3-matplotlib) was missing.</p>"
    return "<h2>Plots</h2>\n" + "\n".join(plot(directory, stem) for stem in stems) if stems else ""


def plot(directory, stem):
    path = directory / f"{stem}.svg"
    if path.stat().st_size > LARGEST_SVG:
        path = path.with_suffix(".png")
    caption = caption_of(stem)
    return (f"<figure><img class=\"plot\" src=\"{data_uri(path)}\" alt=\"{text(caption)}\">\n"
            f"<figcaption>{text(caption)} Files: {stem}.svg, .png, .pdf.</figcaption></figure>")


def caption_of(stem):
    """Of a plot, or of one of several that a measure has each: ranks_fitness."""
    first, _, measure = stem.partition("_")
    return CAPTIONS.get(stem) or CAPTIONS.get(first, stem).format(measure=measure)


def data_uri(path):
    kind = {".svg": "image/svg+xml", ".png": "image/png"}[path.suffix]
    return f"data:{kind};base64,{base64.b64encode(path.read_bytes()).decode('ascii')}"


def tables(directory, meta):
    found = [item for item in meta["tables"] if (directory / item["file"]).exists()]
    return "<h2>Tables</h2>\n" + "\n".join(table(directory / item["file"], item.get("title") or item["file"])
                                           for item in found) if found else ""


def table(path, title, opened=False):
    header, *rows = read_rows(path)
    shown, left_out = rows[:SHOWN_ROWS], len(rows) - SHOWN_ROWS
    right = [any(row[i] for row in rows) and all(is_number(row[i]) for row in rows) for i in range(len(header))]
    lines = [table_row("th", [name.replace("_", " ") for name in header], right)]
    body = "\n".join(lines + [table_row("td", [short(value) for value in row], right) for row in shown])
    more = f"<p class=\"soft\">The other {left_out} rows are in {text(path.name)}.</p>" if left_out > 0 else ""
    inner = f"<div class=\"scroll\"><table>\n{body}\n</table></div>{more}"
    summary = f"{text(title)} <span class=\"soft\">({text(path.name)}, {len(rows)} rows)</span>"
    opened = " open" if opened or len(rows) <= OPEN_ROWS else ""
    return f"<details{opened}><summary>{summary}</summary>\n{inner}</details>"


def table_row(tag, cells, right):
    opening = [f"<{tag} class=\"number\">" if number else f"<{tag}>" for number in right]
    return "<tr>" + "".join(f"{start}{text(cell)}</{tag}>" for start, cell in zip(opening, cells)) + "</tr>"


def is_number(value):
    try:
        return value == "" or float(value) is not None
    except ValueError:
        return False


def short(value):
    """Long decimals with four digits; whole numbers and words as they are."""
    if len(value) <= 6 or not is_number(value) or re.fullmatch(r"-?\d+", value):
        return value
    return f"{float(value):.0f}" if 1e4 <= abs(float(value)) < 1e9 else f"{float(value):.4g}"


def score_sheet(directory, meta):
    """The table by groups, and each target with its fits: silhouette, overlay, the tree from another side."""
    sheet = meta.get("score_sheet")
    if not sheet:
        return ""
    groups = table(directory / "score_groups.csv", "By groups", opened=True)
    if (directory / "plants.csv").exists():
        groups += table(directory / "plants.csv", "The plants: wood that shows, depth, leaves, numbers of branches",
                        opened=True)
    cards = "\n".join(score_card(directory, sheet["columns"], target) for target in sheet["targets"])
    return (f"<h2>Score sheet</h2>\n<p class=\"soft\">Fits beside the picture's outline filled with no tree at all, which "
            f"they must beat on IoU and on gaps. Pictures show the run of median fitness: target; then fit and overlay "
            f"(agreement white, missed blue, surplus orange), below them the plant from the front, from the side and "
            f"from in between.</p>\n{groups}\n{cards}")


def score_card(directory, columns, target):
    shown, labels = [picture(directory, target.get("picture"), "target")], ["target"]
    for fit in target["fits"]:
        shown += [picture(directory, fit.get(kind), kind) for kind in ["fit", "overlay"]]
        labels += [fit["label"], ""]
    trees = "".join(f"<figure>{picture(directory, fit.get('tree'), 'tree')}<figcaption>{text(fit['label'])}</figcaption>"
                    f"</figure>" for fit in target["fits"])
    cells = "".join(f"<figure>{image}<figcaption>{text(label)}</figcaption></figure>"
                    for image, label in zip(shown, labels))
    kept = [i for i, name in enumerate(columns) if name not in ("target", "group")]
    right = [columns[i] not in ("method", "stage") for i in kept]
    rows = [table_row("th", [columns[i].replace("_", " ") for i in kept], right)]
    rows += [table_row("td", [row[i] for i in kept], right) for row in target["rows"]]
    body = "\n".join(rows)
    return (f"<section class=\"card score\"><h2>{text(target['target'])} <span class=\"soft\">{text(target['group'])}"
            f"</span></h2>\n<div class=\"row\">{cells}</div>\n<div class=\"row\">{trees}</div>\n<div class=\"scroll\"><table>\n{body}\n</table></div></section>")


def thumbnails(directory, meta):
    runs = "\n".join(thumbnail(directory, run) for run in meta["thumbnails"])
    return (f"<h2>Runs</h2>\n<p class=\"soft\">Each: the start where there is one, the target, the result, and the two "
            f"laid over each other.</p>\n"
            f"<div class=\"runs\">{runs}</div>") if runs else ""


def thumbnail(directory, run):
    kinds = ["start"] * ("start" in run) + ["target", "result", "overlay"]
    pictures = "".join(picture(directory, run.get(kind), kind) for kind in kinds)
    fitness = run.get("fitness")
    caption = text(run.get("label") or run.get("run")) + (f", fitness {fitness:.3f}" if fitness is not None else "")
    return f"<figure><div class=\"row\">{pictures}</div><figcaption>{caption}</figcaption></figure>"


def picture(directory, path, kind):
    if not path or not (directory / path).exists():
        return f"<span>no {kind}</span>"
    return f"<img src=\"{data_uri(directory / path)}\" alt=\"{kind}\" loading=\"lazy\">"


def repeat(meta):
    parts = ["<h2>To repeat it</h2>"]
    if meta.get("command"):
        parts.append(f"<pre>{text(meta['command'])}</pre>")
    if meta.get("declaration"):
        declaration = f"<pre>{text(meta['declaration'])}</pre>"
        parts.append(f"<details open><summary>The declaration</summary>{declaration}</details>")
    if meta.get("versions"):
        parts.append(f"<details><summary>Versions</summary><pre>{text(meta['versions'])}</pre></details>")
    return "\n".join(parts) if len(parts) > 1 else ""
