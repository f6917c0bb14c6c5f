#!/usr/bin/env python3
"""Comments and documents name only what is there: files, command-line flags, identifiers.

    python3 -B tests/structure/comments_test.py [ROOT]

Read are the comments of *.h, *.cpp, *.cmake and CMakeLists.txt, docs/*.md and the Markdown at the top. Checked are
  files        x/y.h, y.cpp, z.md, …: some file of the repository ends in that path; src/… is there as it stands
  links        [text](file.md#heading) of Markdown
  flags        --word: a string of the program has it, or a tool in FOREIGN_FLAGS
  identifiers  `name`, `name()`, name(), a_name, kName, TwoWords: a word of the code, of its strings or of data files
One line for each fault; the exit code is 1 where there is one."""

import fnmatch
import pathlib
import re
import sys

SKIPPED_FOLDERS = ("build", ".git", "runs", "__pycache__")
CODE = (".h", ".cpp", ".cmake", ".py")
DATA = (".toml", ".lsys", ".json", ".csv", ".cff", ".txt", ".yml", "")
TOP_FOLDERS = "src|fitting|experiments|targets|tests|docs|cmake|examples|.ci"

# Flags of other tools, by tool: what our comments and documents tell a reader to type.
FOREIGN_FLAGS = {
    "cmake": ("--preset", "--build", "--target", "--install", "--prefix"),
    "ctest": ("--test-dir",),
    "Google Benchmark": ("--benchmark_filter", "--benchmark_repetitions", "--benchmark_counters_tabular"),
    "valgrind": ("--tool", "--inclusive"),
}
# Words that look like identifiers of ours: other tools' and papers' names, examples, symbols of equations.
FOREIGN_WORDS = {"Compress", "ConditionCov", "EqualFunValues", "McPheeters", "NumPy", "SplitMix64", "TolFun",
                 "callgrind_annotate", "bark_a0522d", "bark_c8342b", "level_i", "r_ij"}

FILE = re.compile(r"(?<![\w./*<-])((?:[\w.*-]+/)*[\w.*-]+\.(?:h|cpp|cmake|md|py))(?![\w/])")
PLACE = re.compile(rf"(?<![\w./-])((?:{TOP_FOLDERS})/[\w./*-]*[\w*/])")
FLAG = re.compile(r"(?<![\w-])(--[a-z][\w-]*\w)")
LINK = re.compile(r"\]\(([^)\s]+)\)")
TICKED = re.compile(r"`([^`]+)`")
CALL = re.compile(r"(?<![\w.])([A-Za-z_]\w*(?:::\w+)*)\(\)")
SNAKE_CASE = re.compile(r"(?<![\w./\\<-])([a-z][a-z0-9]*(?:_[a-z0-9]+)+|k[A-Z][A-Za-z0-9]+)(?![\w/-]|\.\w)")
CAMEL_CASE = re.compile(r"(?<![\w./\\<-])((?:[A-Z][a-z0-9]+){2,})(?![\w/-]|\.\w)")


def files_of(root):
    return [path for path in sorted(root.rglob("*"))
            if path.is_file() and not path.relative_to(root).parts[0].startswith(SKIPPED_FOLDERS)]


def split_comments(text, suffix):
    """The text twice, line by line: its comments alone, and its code alone."""
    if suffix in (".h", ".cpp"):
        pattern = r'R"(\w*)\((?:.|\n)*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|(//[^\n]*|/\*(?:.|\n)*?\*/)'
    else:
        pattern = r'()"(?:\\.|[^"\\])*"|(#[^\n]*)'
    blank = lambda part: re.sub(r"[^\n]", " ", part)
    comments, code, at = [], [], 0
    for match in re.finditer(pattern, text):
        before = text[at:match.start()]
        is_comment = match[2] is not None
        comments += [blank(before), match[0] if is_comment else blank(match[0])]
        code += [before, blank(match[0]) if is_comment else match[0]]
        at = match.end()
    comments.append(blank(text[at:]))
    code.append(text[at:])
    return "".join(comments), "".join(code)


class Repository:
    """What there is: paths, words of code and data, strings of the program."""

    def __init__(self, root):
        self.root = root
        self.paths, self.words, self.flags = [], set(FOREIGN_WORDS), {f for flags in FOREIGN_FLAGS.values() for f in flags}
        self.read = []  # (path, lines of comments or text)
        for path in files_of(root):
            name = path.relative_to(root).as_posix()
            self.paths.append(name)
            self.words.update(re.findall(r"\w+", name))
            self.words.add(str(pathlib.PurePosixPath(name).parent).removeprefix("src/").replace("/", "_"))  # a target
            self.add(name, path)

    def add(self, name, path):
        if path.suffix not in CODE + DATA + (".md",):
            return
        text = path.read_text(errors="replace")
        if path.suffix == ".md":
            if re.fullmatch(r"(docs/)?[^/]+\.md", name):
                self.read.append((name, text.split("\n")))
            return
        code = text
        if path.suffix in (".h", ".cpp", ".cmake") or path.name == "CMakeLists.txt":
            comments, code = split_comments(text, path.suffix)
            self.read.append((name, comments.split("\n")))
        self.words.update(re.findall(r"\w+", code))
        self.flags.update(re.findall(r"--[a-z][\w-]*\w", code))
        self.flags.update("--" + word for word in re.findall(r'"([a-z][a-z0-9-]*)"', code))

    def has_file(self, name, beside):
        """`name` ends the path of a file or folder; with stars, matches one."""
        name = name.removeprefix("./").rstrip("/")
        folder = pathlib.PurePosixPath(beside).parent
        fits = lambda path: path == name or path.endswith("/" + name) or fnmatch.fnmatch(path, "*" + name)
        return any(fits(path) for path in self.paths) or (self.root / folder / name).exists()

    def has_place(self, place):
        """NAME and FILE stand for any name."""
        place = re.sub(r"\b(NAME|FILE)\b", "*", place)
        return bool(list(self.root.glob(place.rstrip("/")))) if "*" in place else (self.root / place).exists()

    def headings(self, path):
        lines = re.findall(r"^#+ (.*)", (self.root / path).read_text(), re.MULTILINE)
        return {re.sub(r"[^\w -]", "", line.lower()).replace(" ", "-") for line in lines}

    def knows(self, name):
        return all(word in self.words for word in name.split("::"))


def wrong_links(repository, name, line):
    for target in LINK.findall(line):
        if re.match(r"\w+:", target):
            continue
        file, _, heading = target.partition("#")
        path = (pathlib.PurePosixPath(name).parent / file).as_posix() if file else name
        if not (repository.root / path).exists():
            yield f"links to {target}, which is not there"
        elif heading and heading not in repository.headings(path):
            yield f"links to {target}, which has no such heading"


def wrong_files(repository, name, line):
    for file in FILE.findall(line):
        if not repository.has_file(file, name):
            yield f"names the file {file}, which is not there"
    for place in PLACE.findall(line):
        if not FILE.fullmatch(place) and not repository.has_place(place):
            yield f"names {place}, which is not there"


def wrong_flags(repository, line):
    for flag in FLAG.findall(line):
        if flag not in repository.flags:
            yield f"names the flag {flag}, which no command has"


def wrong_names(repository, line, is_comment):
    """In Markdown, words such as JavaScript are no names of ours unless they stand in backticks."""
    named = set(CALL.findall(line)) | set(SNAKE_CASE.findall(line)) | set(CAMEL_CASE.findall(line) if is_comment else ())
    for ticked in TICKED.findall(line):
        named |= set(re.findall(r"^([A-Za-z]\w*(?:::\w+)*(?<!_))(?:\(\))?$", ticked))
    for identifier in sorted(named):
        if not repository.knows(identifier):
            yield f"names {identifier}, which is nowhere in the code"


def faults_of_comments(repository, name, line):
    return [*wrong_files(repository, name, line), *wrong_flags(repository, line),
            *wrong_names(repository, line, is_comment=True)]


def faults_of_markdown(repository, name, line, in_block):
    """What a reader types into a block may name files of his own; flags are the program's."""
    if in_block:
        return list(wrong_flags(repository, line))
    return [*wrong_files(repository, name, line), *wrong_flags(repository, line),
            *wrong_names(repository, line, is_comment=False), *wrong_links(repository, name, line)]


def faults_of(root):
    repository = Repository(root)
    faults = []
    for name, lines in repository.read:
        in_block = False
        for number, line in enumerate(lines, 1):
            if name.endswith(".md"):
                in_block ^= line.startswith("```")
                found = faults_of_markdown(repository, name, line, in_block)
            else:
                found = faults_of_comments(repository, name, line)
            faults += [f"{name}:{number}: {fault}" for fault in found]
    return faults


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2]).resolve()
    faults = faults_of(root)
    print("\n".join(faults) if faults else "comments and documents name what is there")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
