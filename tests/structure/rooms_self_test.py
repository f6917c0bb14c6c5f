#!/usr/bin/env python3
"""Tests of rooms_test.py: a small tree with two rooms has no faults; each fault put into it is named in one line.

    python3 -B tests/structure/rooms_self_test.py"""

import pathlib
import tempfile
import unittest

import rooms_test

FILES = {
    "CMakeLists.txt": "# espalier_room(src/comment)\nespalier_room(src/core LIBRARIES fmt::fmt)\n"
                      "espalier_room(src/image/masks USES core\n              LIBRARIES hwy::hwy)\n",
    "src/core/error.h": "#include <string>\n",
    "src/core/error.cpp": "#include <espalier/core/error.h>\n",
    "src/image/masks/mask.h": "#include <espalier/core/error.h>\n",
    "tests/CMakeLists.txt": "espalier_room_tests(core)\nespalier_room_tests(image/masks USES core)\n",
    "tests/core/error_test.cpp": "",
    "tests/image/masks/mask_test.cpp": "",
    "docs/architecture.md": "| folder | holds |\n|---|---|\n| `src/core` | errors |\n| `src/image/masks` | masks |\n",
    "src/espalier.h": "#include <espalier/core/error.h>\n",
    "fitting/.keep": "",
    "experiments/program.cpp": '#include "helper.h"\n#include <espalier/core/error.h>\n',
    "experiments/helper.h": "",
}


class Rooms(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for path, text in FILES.items():
            self.write(path, text)

    def write(self, path, text):
        (self.root / path).parent.mkdir(parents=True, exist_ok=True)
        (self.root / path).write_text(text)

    def replace(self, path, old, new):
        text = (self.root / path).read_text()
        self.assertIn(old, text)
        self.write(path, text.replace(old, new))

    def expect(self, *lines):
        self.assertEqual(rooms_test.faults_of(self.root), list(lines))

    def test_a_tree_in_order_has_no_faults(self):
        self.expect()

    def test_an_injected_include_is_named_with_its_line(self):
        self.write("src/core/error.cpp", "#include <espalier/core/error.h>\n\n  #include <espalier/image/masks/mask.h>\n")
        self.expect("src/core/error.cpp:3: includes <espalier/image/masks/mask.h>, but src/core does not use image/masks")

    def test_an_include_of_nothing(self):
        self.write("src/image/masks/mask.h", "#include <espalier/core/error.h>\n#include <espalier/core/gone.h>\n")
        self.expect("src/image/masks/mask.h:2: includes <espalier/core/gone.h>, which is not there")

    def test_an_entry_that_no_include_needs(self):
        self.write("src/image/masks/mask.h", "")
        self.expect("CMakeLists.txt: src/image/masks uses core, but includes nothing of it")

    def test_a_circle(self):
        self.replace("CMakeLists.txt", "src/core LIBRARIES", "src/core USES image/masks LIBRARIES")
        self.write("src/core/error.cpp", "#include <espalier/image/masks/mask.h>\n")
        self.expect("CMakeLists.txt: rooms in a circle: core → image/masks → core")

    def test_the_26th_file(self):
        for i in range(23):
            self.write(f"src/core/file_{i}.cpp", "")
        self.expect()
        self.write("src/core/file_23.cpp", "")
        self.expect("src/core: got 26 files, expected at most 25: split the room")

    def test_a_room_without_a_line_in_the_architecture(self):
        self.replace("docs/architecture.md", "| `src/core` | errors |\n", "")
        self.expect("docs/architecture.md: no line for the room src/core")

    def test_a_line_in_the_architecture_without_a_room(self):
        self.replace("docs/architecture.md", "| `src/core`", "| `src/old` | gone |\n| `src/core`")
        self.expect("docs/architecture.md: a line for src/old, which is not there")

    def test_a_room_without_a_test_program(self):
        self.replace("tests/CMakeLists.txt", "espalier_room_tests(core)\n", "")
        (self.root / "tests/core/error_test.cpp").unlink()
        self.expect("tests/CMakeLists.txt: no espalier_room_tests(core), so src/core has no test program")

    def test_a_folder_of_tests_that_never_runs(self):
        self.write("tests/old/old_test.cpp", "")
        self.expect("tests/old: never runs, since tests/CMakeLists.txt has no espalier_room_tests(old)")

    def test_quotes_around_a_header_of_ours(self):
        self.write("src/core/error.cpp", '#include "core/error.h"\n')
        self.expect('src/core/error.cpp:1: includes "core/error.h", expected <espalier/room/file.h>')

    def test_a_folder_of_sources_that_is_no_room(self):
        self.write("src/plant/plant.h", "")
        self.expect("src/plant: holds sources, but CMakeLists.txt has no espalier_room for it")

    def test_a_used_room_that_is_none(self):
        self.replace("CMakeLists.txt", "USES core", "USES cores")
        self.expect("CMakeLists.txt: src/image/masks uses cores, which is no room")


if __name__ == "__main__":
    unittest.main()
