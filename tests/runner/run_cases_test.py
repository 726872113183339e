#!/usr/bin/env python3
"""Tests of run_cases.py: run_cases_test.py PROGRAM, which is that of ending_cases.cpp."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

RUNNER = pathlib.Path(__file__).parent / "run_cases.py"
PROGRAM = pathlib.Path(sys.argv.pop())

OUTCOMES = {
    "Ending.Passes": "passed", "Ending.Fails": "failed", "Ending.Crashes": "ended by SIGSEGV", "Ending.Skips": "skipped",
    "Ending.Exits": "ended with code 0", "Ending.SleepsForGood": "took longer than 3 s",
    "Ending.PassesWithoutANewline": "passed", "CrashingSuite.First": "ended by SIGSEGV",
    "CrashingSuite.Second": "ended by SIGSEGV", "FailingSuite.Only": "passed", "Process.First": "passed",
    "Process.Second": "passed", "Some/Numbered.IsOdd/0": "passed", "Some/Numbered.IsOdd/1": "failed",
    "Some/Numbered.IsOdd/2": "passed"}


class RunCases(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_cases(self, *options, name="all"):
        results = self.folder / f"{name}.txt"
        os.environ.pop("PRELIGHT_ROOT", None)
        done = subprocess.run([RUNNER, PROGRAM, "--seconds", "3", "--results", results, *options], capture_output=True,
                              text=True)
        rows = [line.split("\t") for line in results.read_text().splitlines()]
        return done, {case: outcome for outcome, _, case, _ in rows}

    def test_every_case_has_its_outcome_whatever_others_do(self):
        done, outcomes = self.run_cases()
        self.assertEqual(outcomes, OUTCOMES)
        self.assertEqual(done.returncode, 1)
        self.assertIn("15 cases: 7 passed, 3 ended by SIGSEGV, 2 failed", done.stdout)

    def test_what_failed_is_told_with_its_words_and_the_command_that_runs_it_again(self):
        text = self.run_cases()[0].stdout
        again = os.path.relpath(PROGRAM)
        for case, outcome in OUTCOMES.items():
            told = f"{outcome}: {again} --gtest_filter={case}\n" in text
            self.assertEqual(told, outcome not in ("passed", "skipped"), case)
        self.assertIn("said before it fails", text)
        self.assertIn("said before it crashes", text)
        self.assertNotIn("said without a newline", text)

    def test_suite_that_fails_beside_its_cases_is_a_failure(self):
        done, _ = self.run_cases("--only", "FailingSuite.*")
        self.assertEqual(done.returncode, 1)
        self.assertIn("said while the suite ends", done.stdout)

    def test_shards_have_every_case_once(self):
        parts = [self.run_cases("--shard", f"{i}/4", name=str(i))[1] for i in range(1, 5)]
        self.assertEqual([case for part in parts for case in part], list(OUTCOMES))
        summary = subprocess.run([RUNNER, "--summary", self.folder], capture_output=True, text=True).stdout
        self.assertIn("15 cases in all: ", summary)
        self.assertIn("skipped: Ending.Skips", summary)

    def test_cases_share_a_process_unless_they_are_to_be_alone(self):
        self.assertEqual(self.run_cases("--only", "Process.*")[0].returncode, 0)
        outcomes = self.run_cases("--only", "Process.*", "--alone", "Process.*")[1]
        self.assertEqual(outcomes, {"Process.First": "passed", "Process.Second": "failed"})

    def test_program_all_of_whose_cases_are_skipped_is_skipped(self):
        self.assertEqual(self.run_cases("--only", "Ending.Skips")[0].returncode, 77)


if __name__ == "__main__":
    unittest.main()
