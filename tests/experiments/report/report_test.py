#!/usr/bin/env python3
"""Tests of experiments/report/report.py: plots of every CSV, one self-contained page, the same bytes, bad input.

    python3 -B tests/experiments/report_test.py

Tests that draw are skipped, and say so, where Matplotlib is missing."""

import csv
import html.parser
import importlib.util
import json
import os
import pathlib
import re
import runpy
import shutil
import struct
import subprocess
import sys
import tempfile
import traceback
import unittest
import xml.etree.ElementTree

import synthetic_report as synthetic

REPORT = pathlib.Path(__file__).resolve().parents[3] / "experiments/report/report.py"
needs_matplotlib = unittest.skipUnless(importlib.util.find_spec("matplotlib"), "nothing is drawn without Matplotlib")
EMPTY_ELEMENTS = {"meta", "img", "link", "br", "hr", "input"}


class Page(html.parser.HTMLParser):
    """Elements of a page: whether they close in order, what they refer to, which ids they have."""

    def __init__(self, text):
        super().__init__()
        self.open, self.faults, self.references, self.ids, self.text = [], [], [], [], ""
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        if tag not in EMPTY_ELEMENTS:
            self.open.append(tag)
        names = [name for name, _ in attributes]
        if len(names) != len(set(names)):
            self.faults.append(f"<{tag}> repeats an attribute")
        self.references += [value for name, value in attributes if name in ("src", "href", "srcset", "data", "poster")]
        self.ids += [value for name, value in attributes if name == "id"]

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"</{tag}> closes something else, line {self.getpos()[0]}")

    def handle_data(self, data):
        self.text += data


def start_report(directory, **environment):
    """As a user starts it."""
    return subprocess.run([sys.executable, REPORT, directory], capture_output=True, text=True,
                          env={**os.environ, **environment})


def report_here(directory, out, err):
    """The script, in a fork that ends with it: the exit code is its own."""
    code = 1
    try:
        for stream, file in [(1, out), (2, err)]:
            os.dup2(file.fileno(), stream)
        sys.argv = [str(REPORT), str(directory)]
        sys.path.insert(0, str(REPORT.parent))
        runpy.run_path(str(REPORT), run_name="__main__")
        code = 0
    except SystemExit as end:
        code = end.code or 0
    except BaseException:
        traceback.print_exc()
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)


def run_report(directory):
    """As start_report, in a fork of this process, which has imported Matplotlib: that takes longer than most of what
    is drawn here."""
    if importlib.util.find_spec("matplotlib"):
        import matplotlib.pyplot  # noqa: F401
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as err:
        sys.stdout.flush()
        sys.stderr.flush()
        child = os.fork()
        if child == 0:
            report_here(directory, out, err)
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        said = []
        for file in [out, err]:
            file.seek(0)
            said.append(file.read())
    return subprocess.CompletedProcess([REPORT, directory], code, *said)


class ReportTest(unittest.TestCase):
    """Each test has a folder of its own; drawing takes seconds, so what is only looked at is drawn once for all."""

    shared = tempfile.TemporaryDirectory(prefix="espalier_report_")

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="espalier_report_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def once_drawn(self, kind):
        directory = pathlib.Path(self.shared.name) / kind / "report"
        if not directory.exists():
            folder, self.folder = self.folder, pathlib.Path(self.shared.name)
            self.drawn(getattr(self, kind)())
            self.folder = folder
        return directory

    def fits(self, left_out=()):
        directory = synthetic.fresh(self.folder, "fits")
        synthetic.write_fits(directory, synthetic.METHODS[:8], synthetic.TARGETS[:2], 2, runs=2)
        for name in left_out:
            (directory / f"{name}.csv").unlink()
        return directory

    def growth(self):
        directory = synthetic.fresh(self.folder, "growth")
        synthetic.write_growth(directory, synthetic.SPECIES[:4], 5)
        return directory

    def pictures(self):
        directory = synthetic.fresh(self.folder, "pictures")
        synthetic.write_pictures(directory, ["aspen", "palm"], ["0.5", "1"])
        return directory

    def drawn(self, directory, run_report=run_report):
        run = run_report(directory)
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))
        return self.page(directory)

    def page(self, directory):
        return Page((directory / "index.html").read_text(encoding="utf-8"))

    def without_matplotlib(self, directory):
        """A module of that name that cannot be imported comes first on the path."""
        stub = self.folder / "stub"
        stub.mkdir(exist_ok=True)
        (stub / "matplotlib.py").write_text("raise ImportError('not installed')\n")
        return start_report(directory, PYTHONPATH=str(stub))

    def expect_refused(self, directory, *words):
        run = run_report(directory)
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        for word in words:
            self.assertIn(word, run.stderr)


@needs_matplotlib
class Plots(ReportTest):
    def expect_plots(self, directory, stems):
        for extension, start in [("svg", b"<?xml"), ("png", b"\x89PNG"), ("pdf", b"%PDF")]:
            found = {path.stem for path in directory.glob(f"*.{extension}")}
            self.assertEqual(found, stems, extension)
            for stem in stems:
                self.assertTrue((directory / f"{stem}.{extension}").read_bytes().startswith(start))

    def test_every_table_of_fits_is_drawn_in_three_formats(self):
        self.expect_plots(self.once_drawn("fits"), {"convergence", "convergence_targets", "data_profile",
                                                     "ranks_fitness", "generations"})

    def test_tables_of_earlier_versions_are_drawn_too(self):
        directory = self.fits(left_out=["data_profile", "ranks_fitness"])
        for name, younger in [("convergence.csv", "starts"), ("generations.csv", "stage")]:
            self.leave_out(directory / name, [younger])
        self.drawn(directory)
        self.assertTrue((directory / "convergence.svg").exists())
        self.assertTrue((directory / "generations.svg").exists())

    def leave_out(self, table, columns):
        with table.open(newline="") as file:
            rows = list(csv.DictReader(file))
        with table.open("w", newline="") as file:
            writer = csv.DictWriter(file, [key for key in rows[0] if key not in columns], extrasaction="ignore")
            writer.writeheader()
            writer.writerows(rows)

    def test_growth_of_earlier_versions_is_drawn_too(self):
        directory = self.growth()
        self.leave_out(directory / "growth_times.csv", ["model", "derivation_seconds", "interpretation_seconds"])
        self.leave_out(directory / "growth_complexity.csv", ["model"])
        self.drawn(directory)
        self.expect_plots(directory, {"growth_times", "growth_size", "growth_complexity"})

    def test_axes_name_the_measures_of_the_objective_and_panels_have_a_band_of_what_was_published(self):
        words = {"truncated_distance": ["convergence", "generations"],
                 "published: 50–75 %": ["convergence_targets", "generations"]}
        directory = self.fits(left_out=["data_profile", "ranks_fitness"])
        meta = json.loads((directory / "meta.json").read_text())
        meta.update({"objective": "0.5*truncated_distance+0.5*iou", "published_fitness": [0.5, 0.75]})
        (directory / "meta.json").write_text(json.dumps(meta))
        self.drawn(directory)
        for drawn, shown in [(directory, True), (self.once_drawn("fits"), False)]:
            for word, stems in words.items():
                for stem in stems:
                    self.assertEqual(word in (drawn / f"{stem}.svg").read_text(), shown, (word, stem))

    def test_every_table_of_growth_is_drawn_in_three_formats(self):
        self.expect_plots(self.once_drawn("growth"), {"growth_times", "growth_size", "growth_complexity"})

    def test_growth_of_lsystems_is_drawn_beside_that_of_species(self):
        directory = synthetic.fresh(self.folder, "growth")
        synthetic.write_growth(directory, synthetic.SPECIES[:3], 5, lsystems=synthetic.SPECIES[:2])
        self.drawn(directory)
        self.expect_plots(directory, {"growth_times", "growth_size", "growth_lsystems", "growth_complexity"})
        for stem in ["growth_times", "growth_complexity"]:
            self.assertIn(synthetic.SPECIES[0] + ", L-system", (directory / f"{stem}.svg").read_text(), stem)
        self.assertIn("exponent 1.30 ± 0.02", (directory / "growth_lsystems.svg").read_text())

    def test_growth_of_lsystems_alone_has_no_sizes_of_species(self):
        directory = synthetic.fresh(self.folder, "growth")
        synthetic.write_growth(directory, [], 5, lsystems=synthetic.SPECIES[:2])
        self.drawn(directory)
        self.expect_plots(directory, {"growth_times", "growth_lsystems", "growth_complexity"})

    def test_a_long_row_of_pictures_goes_on_in_further_lines(self):
        directory = synthetic.fresh(self.folder, "pictures")
        labels = [f"tree {i}" for i in range(21)]
        synthetic.write_pictures(directory, [""], labels)
        self.drawn(directory)
        width, height = struct.unpack(">II", (directory / "sheet.png").read_bytes()[16:24])
        self.assertLess(width, 3 * height)
        for label in labels:
            self.assertIn(f"<!-- {label} -->", (directory / "sheet.svg").read_text())

    def test_a_sheet_of_pictures_is_drawn_in_three_formats(self):
        self.expect_plots(self.once_drawn("pictures"), {"sheet"})

    def test_what_has_no_table_has_no_plot(self):
        directory = self.fits(left_out=["convergence", "generations", "data_profile"])
        self.drawn(directory)
        self.expect_plots(directory, {"ranks_fitness"})

    def test_cells_without_a_number_are_left_out(self):
        directory = self.growth()
        fit = directory / "growth_fit.csv"
        fit.write_text("what,exponent,standard_error,factor,points\nstems,nan,nan,nan,0\nleaves,1,,1e-6,2\n")
        self.drawn(directory)
        self.expect_plots(directory, {"growth_times", "growth_size", "growth_complexity"})

    def test_the_same_files_give_the_same_bytes(self):
        for kind in ["fits", "growth", "pictures"]:
            first, second = self.once_drawn(kind), getattr(self, kind)()
            self.drawn(second, start_report)  # another process, whose hashes have another seed
            names = {path.name for path in first.iterdir()}
            self.assertEqual(names, {path.name for path in second.iterdir()})
            for name in names:
                self.assertEqual((first / name).read_bytes(), (second / name).read_bytes(), name)

    def test_svgs_ask_for_nothing_from_elsewhere(self):
        for path in self.once_drawn("fits").glob("*.svg"):
            for element in xml.etree.ElementTree.parse(path).iter():
                for name, value in element.attrib.items():
                    elsewhere = name.endswith("href") and not value.startswith(("#", "data:"))
                    self.assertFalse(elsewhere, (path.name, value))


@needs_matplotlib
class WholePage(ReportTest):
    def test_pages_are_well_formed_and_self_contained(self):
        for kind in ["fits", "growth", "pictures"]:
            directory = self.once_drawn(kind)
            page = self.page(directory)
            source = (directory / "index.html").read_text(encoding="utf-8")
            self.assertTrue(source.startswith("<!DOCTYPE html>"))
            self.assertEqual((page.faults, page.open), ([], []))
            self.assertEqual(len(page.ids), len(set(page.ids)))
            self.assertTrue(page.references)
            self.assertEqual([r[:40] for r in page.references if not r.startswith("data:image/")], [])
            self.assertIsNone(re.search(r"url\(|@import|<script", source))
            self.assertNotIn(self.shared.name, source)

    def test_a_page_shows_plots_tables_runs_and_how_to_repeat_it(self):
        page = self.page(self.once_drawn("fits"))
        self.assertEqual(len(page.references), 5 + 2 * 3)
        for words in ["Which optimiser fits trees best?", "after a few hours <of runtime> & more", "nothing was fitted",
                      "critical_difference", "quaking_aspen, random_search, seed 0",
                      "espalier experiment run fits.toml",
                      "seeds = [1, 2]", "nlopt: 2.7.1"]:
            self.assertIn(words, page.text)

    def test_a_picture_that_is_not_there_is_named(self):
        directory = self.fits(left_out=["convergence", "generations", "data_profile"])
        shutil.rmtree(directory.parent / "runs")
        page = self.drawn(directory)
        self.assertEqual(len(page.references), 1)
        self.assertIn("no overlay", page.text)


class WithoutMatplotlib(ReportTest):
    def test_the_page_is_written_and_one_line_says_what_to_install(self):
        directory = self.fits()
        run = self.without_matplotlib(directory)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(run.stderr.count("\n"), 1)
        self.assertIn("python3-matplotlib", run.stderr)
        page = Page((directory / "index.html").read_text(encoding="utf-8"))
        self.assertEqual((page.faults, page.open), ([], []))
        self.assertIn("python3-matplotlib", page.text)
        self.assertIn("critical_difference", page.text)
        self.assertEqual(list(directory.glob("*.svg")), [])


class BadInput(ReportTest):
    def test_a_directory_without_meta_json(self):
        self.expect_refused(self.folder, "meta.json", "no file")

    def test_meta_json_that_is_no_json(self):
        (self.folder / "meta.json").write_text("{")
        self.expect_refused(self.folder, "meta.json", "no JSON")

    def test_an_unknown_kind(self):
        (self.folder / "meta.json").write_text('{"name": "a", "kind": "fit"}')
        self.expect_refused(self.folder, "meta.json", "'fit'", "fits, pictures, growth")

    def test_a_table_on_the_page_with_a_short_row(self):
        directory = self.fits(left_out=["convergence", "generations"])
        with open(directory / "friedman_fitness.csv", "a") as file:
            file.write("blocks\n")
        self.expect_refused(directory, "friedman_fitness.csv:11", "got 1 cells, expected 2")

    @needs_matplotlib
    def test_a_word_where_a_number_belongs(self):
        directory = self.fits(left_out=["convergence", "generations"])
        (directory / "data_profile.csv").write_text("optimizer,evaluations,share\nga,10,much\n")
        self.expect_refused(directory, "data_profile.csv:2", "share", "much", "expected a number")

    @needs_matplotlib
    def test_a_missing_column(self):
        directory = self.fits(left_out=["convergence", "generations"])
        (directory / "data_profile.csv").write_text("optimizer,evaluations\nga,10\n")
        self.expect_refused(directory, "data_profile.csv:1", "no column share")

    @needs_matplotlib
    def test_an_empty_table(self):
        directory = self.fits(left_out=["convergence", "generations"])
        (directory / "ranks_fitness.csv").write_text("")
        self.expect_refused(directory, "ranks_fitness.csv", "empty")

    @needs_matplotlib
    def test_a_sheet_with_fewer_cells_than_labels(self):
        directory = self.pictures()
        synthetic.write_meta(directory, synthetic.meta("pictures", "", sheet={"rows": ["a"], "columns": ["b", "c"],
                                                                              "cells": [[""]]}))
        self.expect_refused(directory, "meta.json", "sheet", "[1]", "[2]")

    @needs_matplotlib
    def test_a_picture_that_is_no_png(self):
        directory = self.pictures()
        (directory.parent / "runs/0-0/picture.png").write_bytes(b"no picture")
        self.expect_refused(directory, "0-0/picture.png", "expected a PNG")


if __name__ == "__main__":
    unittest.main()
