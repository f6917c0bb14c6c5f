#!/usr/bin/env python3
"""What the Weber-Penn model calls its parameters and presets is its own affair: fits ask tables for roles.

Reads the names of parameters from docs/parameters.md (which a test keeps fresh) and those of presets from
src/weber_penn/species, and fails where one of them stands as a string literal of C++ outside src/weber_penn.
A literal names a parameter where one of its parts between commas is the name, with a level or without; a name
of several words also where it stands in a sentence. Comments may name what they like.

    model_names_test.py [SOURCE_FOLDER]
"""
import pathlib
import re
import sys

ROOMS = ("src", "fitting", "experiments")
OWN_ROOM = "src/weber_penn"

# Words that mean something else too: a kind of tree, a stage of a fit, a setting or a quantity, a role. With a
# level, as in branches[1], they name the parameter all the same.
COMMON = {"palm", "branches", "length", "levels"}

# Names that stand for something else in one file.
ALLOWED = {
    "src/overrides/overrides.cpp": {"down_angle"},                         # a quantity of a branch
    "src/lsystem/notation/settings.cpp": {"leaf_shape", "blossom_shape"},  # settings of an L-system
    "src/plant/leaf_outlines.cpp": {"leaf_shape", "blossom_shape"},        # of any plant
    "src/core/parameter_role.cpp": {"relaxed_counts"},                     # a role
    "src/environment/crown_arguments.cpp": {"shape"},                      # of an envelope
    "src/overrides/branch_crown.cpp": {"shape"},                           # of an envelope
    "src/app/bench/bench_cases.cpp": {"quaking_aspen", "lombardy_poplar", "small_pine",
                                      "weeping_willow"},                   # what is measured
    "src/app/main/examples.cpp": {"quaking_aspen", "small_pine"},          # what examples grow
    "src/app/bench/bench_scaling.cpp": {"quaking_aspen"},                  # what is measured
}

TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"\((?P<raw>.*?)\)"|"(?P<text>(?:[^"\\\n]|\\.)*)"|\'(?:[^\'\\\n]|\\.)+\'', re.DOTALL)


def parameter_names(root):
    text = (root / "docs/parameters.md").read_text()
    return set(re.findall(r"^\| `(\w+)(?:\[[\d.]+\])?`", text, re.MULTILINE))


def preset_names(root):
    return {path.stem for path in (root / OWN_ROOM / "species").glob("*.toml")}


def literals(text):
    """Each string literal of C++ with its line."""
    for match in TOKEN.finditer(text):
        literal = match["raw"] if match["raw"] is not None else match["text"]
        if literal is not None:
            yield text.count("\n", 0, match.start()) + 1, literal


def names_in(literal, names):
    parts = {part.strip() for part in literal.split(",")}
    of_levels = {part[:-3] for part in parts if re.search(r"\[\d\]$", part)}
    words = {word for word in re.findall(r"\w+", literal) if "_" in word}
    return (of_levels & names) | ((parts | words) & (names - COMMON))


def sources(root):
    for room in ROOMS:
        for path in sorted((root / room).rglob("*")):
            relative = path.relative_to(root).as_posix()
            if path.suffix in (".h", ".cpp") and not relative.startswith(OWN_ROOM + "/"):
                yield relative, path


def find_faults(root):
    names = parameter_names(root) | preset_names(root)
    if not {"g_scale", "curve_v", "palm"} <= names:
        return [f"docs/parameters.md: got the names {sorted(names)[:5]}…, expected those of the parameters"]
    faults, used = [], set()
    for relative, path in sources(root):
        for line, literal in literals(path.read_text()):
            for name in sorted(names_in(literal, names)):
                used.add((relative, name))
                if name not in ALLOWED.get(relative, ()):
                    faults.append(f'{relative}:{line}: got the name "{name}" of weber_penn, expected a role')
    for relative, allowed in ALLOWED.items():
        faults += [f'{relative}: got no "{name}", expected it: take it from ALLOWED'
                   for name in sorted(allowed) if (relative, name) not in used]
    return faults


def check_the_check():
    """Names are found in code, with levels and in lists, and not in comments or longer words."""
    names = {"curve_v", "curve", "length", "palm", "fan_palm"}
    code = 'f("curve_v[1]"); // "curve_v"\n/* "curve" */ g("palm,fan_palm", \'"\'); h("taller than a curve");'
    found = [(line, name) for line, text in literals(code) for name in sorted(names_in(text, names))]
    expected = [(1, "curve_v"), (2, "fan_palm")]
    assert found == expected, f"got {found}, expected {expected}"


def main():
    check_the_check()
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]
    faults = find_faults(root)
    print("\n".join(faults) or "no names of weber_penn outside of its room")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
