#!/usr/bin/env python3
"""The rooms are what CMakeLists.txt and docs/architecture.md say, and what their includes need.

    python3 -B tests/structure/rooms_test.py [ROOT]

A room is a folder that CMakeLists.txt declares: espalier_room(FOLDER [USES rooms…] …). It includes headers of
the rooms that it uses, and of no other; it holds few files; it has a line in the table of docs/architecture.md
and a test program. One line for each fault; the exit code is 1 where there is one."""

import pathlib
import re
import sys
from dataclasses import dataclass, field

MOST_FILES = 25
MOST_FILES_OF_LARGE_ROOMS = 40
LARGE_ROOMS = ("app", "render")
SOURCE_FOLDERS = ("src", "fitting", "experiments")
HEADER_OF_ALL_ROOMS = "src/espalier.h"  # includes what users of the library need


@dataclass
class Room:
    folder: str  # src/image/masks
    uses: list = field(default_factory=list)  # names, as image/masks

    @property
    def name(self):
        return self.folder.removeprefix("src/")


@dataclass
class Include:
    file: str  # the one that includes, from the root
    line: int
    header: str  # espalier/image/masks/mask.h

    @property
    def place(self):
        return f"{self.file}:{self.line}"

    @property
    def room(self):
        return self.header.removeprefix("espalier/").rpartition("/")[0]


def cmake_calls(text, function):
    """The words of each call of a CMake function, in order."""
    text = re.sub(r"#.*", "", text)
    return [call.split() for call in re.findall(rf"^\s*{function}\s*\(([^)]*)\)", text, re.MULTILINE)]


def declared_rooms(root):
    rooms = []
    for folder, *words in cmake_calls((root / "CMakeLists.txt").read_text(), "espalier_room"):
        section, uses = "", []
        for word in words:
            if re.fullmatch(r"[A-Z_]+", word):
                section = word
            elif section == "USES":
                uses.append(word)
        rooms.append(Room(folder, uses))
    return rooms


def sources_in(folder):
    return sorted(path for path in folder.iterdir() if path.suffix in (".h", ".cpp"))


def all_sources(root):
    folders = (root / folder for folder in SOURCE_FOLDERS)
    return sorted(path for folder in folders for path in folder.rglob("*") if path.suffix in (".h", ".cpp"))


def includes_of(root, path):
    """Includes of our own headers, <espalier/…>."""
    lines = path.read_text().splitlines()
    matches = ((number, re.match(r"\s*#\s*include\s*<(espalier/[^>]*)>", line)) for number, line in enumerate(lines, 1))
    return [Include(str(path.relative_to(root)), number, match[1]) for number, match in matches if match]


def wrong_declarations(root, rooms):
    faults = []
    names = [room.name for room in rooms]
    for room in rooms:
        if names.count(room.name) > 1:
            faults.append(f"CMakeLists.txt: {room.folder} is declared twice")
        if not (root / room.folder).is_dir():
            faults.append(f"CMakeLists.txt: {room.folder} is a room, but there is no such folder")
        for used in room.uses:
            if used not in names:
                faults.append(f"CMakeLists.txt: {room.folder} uses {used}, which is no room")
    return faults


def folders_that_are_no_rooms(root, rooms):
    """Programs of their own stand in experiments itself; below it, and everywhere else, sources are in rooms."""
    in_rooms = (path for path in all_sources(root) if path.relative_to(root).as_posix() != HEADER_OF_ALL_ROOMS)
    folders = {path.parent.relative_to(root).as_posix() for path in in_rooms}
    homeless = folders - {room.folder for room in rooms} - {"experiments"}
    return [f"{folder}: holds sources, but CMakeLists.txt has no espalier_room for it" for folder in sorted(homeless)]


def has_header(root, header):
    name = header.removeprefix("espalier/")
    return (root / "src" / name).exists() or (root / name).exists()


def wrong_includes(root, rooms):
    """Includes beyond USES, and entries of USES that no include needs."""
    faults = []
    for room in rooms:
        needed = set()
        for path in sources_in(root / room.folder):
            for include in includes_of(root, path):
                needed.add(include.room)
                if not has_header(root, include.header):
                    faults.append(f"{include.place}: includes <{include.header}>, which is not there")
                if include.room not in (room.name, *room.uses):
                    faults.append(f"{include.place}: includes <{include.header}>, but {room.folder} does not use {include.room}")
        for used in room.uses:
            if used not in needed:
                faults.append(f"CMakeLists.txt: {room.folder} uses {used}, but includes nothing of it")
    return faults


def headers_with_quotes(root):
    """Quotes are for headers that no room has, as those of programs in experiments."""
    faults = []
    rooms_headers = {path.name for path in all_sources(root) if path.suffix == ".h" and path.parent != root / "experiments"}
    for path in all_sources(root):
        for number, line in enumerate(path.read_text().splitlines(), 1):
            match = re.match(r'\s*#\s*include\s*"([^"]*)"', line)
            if match and pathlib.PurePosixPath(match[1]).name in rooms_headers:
                faults.append(f'{path.relative_to(root)}:{number}: includes "{match[1]}", expected <espalier/room/file.h>')
    return faults


def circles(rooms):
    """Each circle of USES once, from the room of it that is declared first."""
    uses = {room.name: room.uses for room in rooms}
    faults, done = [], set()

    def follow(name, path):
        if name in path:
            circle = path[path.index(name):] + [name]
            faults.append(f"CMakeLists.txt: rooms in a circle: {' → '.join(circle)}")
        elif name not in done:
            for used in uses.get(name, []):
                follow(used, path + [name])
            done.add(name)

    for room in rooms:
        follow(room.name, [])
    return faults


def crowded_rooms(root, rooms):
    faults = []
    for room in rooms:
        count = len(sources_in(root / room.folder))
        most = MOST_FILES_OF_LARGE_ROOMS if room.name in LARGE_ROOMS else MOST_FILES
        if count > most:
            faults.append(f"{room.folder}: got {count} files, expected at most {most}: split the room")
    return faults


def rows_of_architecture(root):
    """What stands in backticks in the first cell of the table's rows."""
    text = (root / "docs/architecture.md").read_text()
    return [name for cell in re.findall(r"^\|([^|]*)\|", text, re.MULTILINE) for name in re.findall(r"`([^`]+)`", cell)]


def wrong_architecture(root, rooms):
    rows = rows_of_architecture(root)
    faults = [f"docs/architecture.md: no line for the room {room.folder}" for room in rooms if room.folder not in rows]
    gone = [row for row in rows if row.startswith(tuple(f"{f}/" for f in SOURCE_FOLDERS)) and not (root / row).exists()]
    return faults + [f"docs/architecture.md: a line for {row}, which is not there" for row in gone]


def wrong_test_programs(root, rooms):
    """A test program for each room, and a program for each folder of tests."""
    programs = [words[0] for words in cmake_calls((root / "tests/CMakeLists.txt").read_text(), "espalier_room_tests")]
    faults = [f"tests/CMakeLists.txt: no espalier_room_tests({room.name}), so {room.folder} has no test program"
              for room in rooms if room.name not in programs]
    folders = {path.parent.relative_to(root / "tests").as_posix() for path in (root / "tests").rglob("*_test.cpp")}
    return faults + [f"tests/{folder}: never runs, since tests/CMakeLists.txt has no espalier_room_tests({folder})"
                     for folder in sorted(folders - set(programs))]


def faults_of(root):
    rooms = declared_rooms(root)
    wrong = wrong_declarations(root, rooms)
    if wrong or not rooms:
        return wrong or ["CMakeLists.txt: got no espalier_room, expected the rooms"]
    return [*folders_that_are_no_rooms(root, rooms), *wrong_includes(root, rooms), *headers_with_quotes(root),
            *circles(rooms), *crowded_rooms(root, rooms), *wrong_architecture(root, rooms),
            *wrong_test_programs(root, rooms)]


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2]).resolve()
    faults = faults_of(root)
    print("\n".join(faults) if faults else f"{len(declared_rooms(root))} rooms are as they should be")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
