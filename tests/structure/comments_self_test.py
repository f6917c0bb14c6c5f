#!/usr/bin/env python3
"""Tests of comments_test.py: names that exist are no faults; each name of nothing is told in one line.

    python3 -B tests/structure/comments_self_test.py"""

import pathlib
import tempfile
import unittest

import comments_test

CODE = '''// A mask. It is compared in measures/compare.h; see `mean_overlap`, read_mask() and docs/masks.md.
/// `count`: at most kMost; a MaskReader reads it, with --size or --seed.
struct MaskReader {};
int read_mask(int count);  ///< as in src/image/*.h
inline const char* text = "no comment: // gone_name() in gone/file.h with --gone";
float mean_overlap; int kMost;
const char* flags[] = {"--size", "seed"};
'''
FILES = {
    "src/image/mask.h": CODE,
    "src/image/measures/compare.h": "",
    "docs/masks.md": "# Masks of trees\n\nSee [above](#masks-of-trees), [it](../README.md), `read_mask()`, JavaScript.\n"
                     "```sh\nespalier mask my_tree.cpp --size 3\n```\n",
    "README.md": "See [masks](docs/masks.md#masks-of-trees).\n",
    "build/generated.h": "// gone_name()\n",
}


class Comments(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for path, text in FILES.items():
            self.write(path, text)

    def write(self, path, text):
        (self.root / path).parent.mkdir(parents=True, exist_ok=True)
        (self.root / path).write_text(text)

    def expect(self, *lines):
        self.assertEqual(comments_test.faults_of(self.root), list(lines))

    def expect_of_comment(self, comment, *faults):
        self.write("src/image/other.cpp", f"int a;\n/// {comment}\n")
        self.expect(*(f"src/image/other.cpp:2: names {fault}" for fault in faults))

    def test_names_that_exist_are_no_faults(self):
        self.expect()

    def test_a_file_that_is_gone(self):
        self.expect_of_comment("see image/frame.h", "the file image/frame.h, which is not there")

    def test_a_file_whose_folder_moved(self):
        self.expect_of_comment("see image/compare.h", "the file image/compare.h, which is not there")

    def test_a_folder_that_is_gone(self):
        self.expect_of_comment("see src/stages/", "src/stages/, which is not there")

    def test_a_flag_that_is_gone(self):
        self.expect_of_comment("told by --sized", "the flag --sized, which no command has")

    def test_identifiers_that_are_gone(self):
        self.expect_of_comment("`reed_mask`, write_mask() and MaskWriter",
                               "MaskWriter, which is nowhere in the code", "reed_mask, which is nowhere in the code",
                               "write_mask, which is nowhere in the code")

    def test_a_name_that_only_comments_use_is_not_there(self):
        self.write("src/image/third.cpp", "// lonely_name\n")
        self.expect("src/image/third.cpp:1: names lonely_name, which is nowhere in the code")

    def test_links_to_what_is_gone(self):
        self.write("README.md", "[a](docs/gone.md)\n[b](docs/masks.md#gone)\n")
        self.expect("README.md:1: names the file docs/gone.md, which is not there",
                    "README.md:1: links to docs/gone.md, which is not there",
                    "README.md:2: links to docs/masks.md#gone, which has no such heading")


if __name__ == "__main__":
    unittest.main()
