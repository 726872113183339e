#!/usr/bin/env python3
"""Tests benchmarks/evidence/evidence.py with a program that stands in for prelight."""

import argparse
import json
import pathlib
import stat
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "benchmarks/evidence"))
import evidence  # noqa: E402

PROGRAM = """#!/usr/bin/env python3
import json, pathlib, sys
words = sys.argv[1:]
if words == ["--version"]:
    print("prelight 1.0 (0123456789abcdef)")
    sys.exit()
with open("commands.txt", "a") as log: log.write(" ".join(words) + "\\n")
if words[0] == "fail": sys.exit(3)
else:
    if "-o" in words: pathlib.Path(words[words.index("-o") + 1]).write_text("made")
    print(json.dumps({"picture": {"rmse": 0.0125, "meanB": 0.5}, "list": [1, 2, 3], "curve": [{"n": 4}, {"n": 9}]}))
"""

PAGE = """<!-- runs -->
old
<!-- end of runs -->
| picture | command |
| `truth.exr` | `prelight reference shapes.glb -o truth.exr` |
| source | what | is | file | see it by | theirs | here | different and why |
| 1 | a | yes | `f` | `prelight render shapes.glb -o a.exr`; `prelight compare a.exr truth.exr` | 7 | <!--one--> not measured | see `prelight bench all` |
| 2 | b | yes | `f` | `prelight fail` | - | <!--two--> not measured | |
"""

NUMBERS = {"one": {"text": "{} % off", "values": ["compare:picture.rmse/picture.meanB"], "scale": 100},
           "two": {"text": "{}", "values": ["fail:list"]}}


class Evidence(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        program = self.folder / "prelight"
        program.write_text(PROGRAM)
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        evidence.PAGE, evidence.RESULTS, evidence.NUMBERS = self.folder / "page.md", self.folder / "results.json", NUMBERS
        evidence.PAGE.write_text(PAGE)
        self.arguments = argparse.Namespace(program=str(program), work=self.folder / "work", ids=[], slow=False, missing=False)

    def run_all(self, results):
        page = evidence.PAGE.read_text()
        return evidence.run(self.arguments, page, evidence.rows_with_numbers(page), results)

    def test_a_run_writes_cells_and_makes_what_they_read(self):
        results = {}
        self.assertFalse(self.run_all(results))  # the second row's command fails
        page = evidence.PAGE.read_text()
        self.assertIn("| 7 | <!--one--> 2.5 % off [A] | see `prelight bench all` |", page)
        self.assertIn("<!--two--> not measured |", page)
        self.assertRegex(page, r"\| \[A\] \| \d{4}-\d\d-\d\d \| 0123456789 \| 1 \|")
        commands = (self.folder / "work/commands.txt").read_text()
        self.assertLess(commands.index("scene shapes -o shapes.glb"), commands.index("render shapes.glb"))
        self.assertLess(commands.index("reference shapes.glb"), commands.index("compare a.exr"))
        self.assertNotIn("bench", commands)

    def test_writing_twice_changes_nothing(self):
        results = {}
        self.run_all(results)
        page = evidence.PAGE.read_text()
        self.assertEqual(evidence.written(page, results), page)
        self.assertEqual(json.loads(evidence.RESULTS.read_text()), results)

    def test_a_check_finds_what_has_changed(self):
        results = {}
        self.run_all(results)
        self.arguments.ids = ["one"]
        page = evidence.PAGE.read_text()
        rows = evidence.rows_with_numbers(page)
        self.assertTrue(evidence.check(self.arguments, page, rows, results))
        results["one"]["values"] = [0.03]
        self.assertFalse(evidence.check(self.arguments, page, rows, results))

    def test_paths_reach_lists_and_last_elements(self):
        report = {"list": [1, 2, 3], "curve": [{"n": 4}, {"n": 9}]}
        self.assertEqual(evidence.at(report, "list"), 3)
        self.assertEqual(evidence.at(report, "curve[].n"), 9)

    def test_numbers_have_two_digits(self):
        shown = [evidence.shown(value) for value in (9800, 0.0412, 3.14159, 0.0, 0.0000123, 153.7, 12.0)]
        self.assertEqual(shown, ["9,800", "0.041", "3.1", "0", "1.2e-5", "154", "12"])

    def test_the_page_is_what_the_results_say(self):
        page = (ROOT / "docs/notes/sources.md").read_text()
        results = json.loads((ROOT / "benchmarks/evidence/results.json").read_text())
        evidence.NUMBERS = evidence.numbers_of_the_page.NUMBERS
        self.assertEqual(set(evidence.rows_with_numbers(page)), set(evidence.NUMBERS))
        self.assertEqual(evidence.written(page, results), page)


if __name__ == "__main__":
    unittest.main()
