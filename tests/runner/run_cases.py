#!/usr/bin/env python3
"""Runs the cases of a GoogleTest program in one process and goes on after a case that ends it.

    tests/runner/run_cases.py PROGRAM [--only PATTERN] [--shard 2/3] [--alone PATTERN]... [--seconds 300]
    tests/runner/run_cases.py --summary FOLDER        counts what runs have left in FOLDER

Prints what failing cases print, and for each the command that runs it again. Exits with 77 when every case was skipped.
"""

import argparse
import collections
import fnmatch
import os
import pathlib
import re
import selectors
import signal
import subprocess
import sys
import tempfile
import time

EVENT = re.compile(r"\[ +(RUN|OK|FAILED|SKIPPED) +\] ([\w/.]+\.[\w/]+)")
WENT_WELL = {"passed", "skipped"}
ALL_SKIPPED = 77

Result = collections.namedtuple("Result", "case outcome seconds output")


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path, nargs="?")
    parser.add_argument("--shard", default="1/1", help="runs the I-th of N equal parts of the cases: I/N")
    parser.add_argument("--only", default="*", metavar="PATTERN", help="leaves out cases that do not match")
    parser.add_argument("--alone", action="append", default=[], metavar="PATTERN",
                        help="gives each matching case a process of its own")
    parser.add_argument("--seconds", type=float, default=300.0, help="ends a case that takes longer")
    parser.add_argument("--results", type=pathlib.Path, help="file for a line per case: outcome, seconds, name, program")
    parser.add_argument("--summary", type=pathlib.Path, metavar="FOLDER", help="counts the results of a folder")
    return parser.parse_args()


def cases_of(program):
    """Names of the program's cases in the order in which it runs them, without the disabled ones."""
    listed = subprocess.run([program, "--gtest_list_tests"], capture_output=True, text=True, check=True).stdout
    cases, suite = [], ""
    for line in listed.splitlines():
        name = line.split("#")[0].strip()
        if line.startswith("  "):
            cases.append(suite + name)
        elif name.endswith("."):
            suite = name
    return [case for case in cases if "DISABLED_" not in case]


def part_of(cases, shard):
    """The shard's share: neighbours stay together, so that few suites are set up twice."""
    index, count = map(int, shard.split("/"))
    return cases[len(cases) * (index - 1) // count:len(cases) * index // count]


def ending(code):
    return f"ended by {signal.Signals(-code).name}" if code < 0 else f"ended with code {code}"


class Process:
    """The program while it runs some of its cases."""

    def __init__(self, program, cases, folder):
        flags = pathlib.Path(folder, "flags")
        flags.write_text("--gtest_filter=" + ":".join(cases) + "\n--gtest_color=no\n")
        # A group of its own, so that what a case has started ends with it.
        self.process = subprocess.Popen([program, f"--gtest_flagfile={flags}"], stdin=subprocess.DEVNULL,
                                        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
        self.selector = selectors.DefaultSelector()
        self.selector.register(self.process.stdout, selectors.EVENT_READ)
        self.unfinished = b""

    def lines_until(self, deadline):
        """The next lines that it prints; none at its end. Raises TimeoutError at the deadline."""
        while True:
            if not self.selector.select(max(0.0, deadline() - time.monotonic())):
                raise TimeoutError
            read = os.read(self.process.stdout.fileno(), 1 << 16)
            *lines, self.unfinished = (self.unfinished + read).split(b"\n")
            if not read and self.unfinished:
                lines, self.unfinished = [self.unfinished], b""
            if lines or not read:
                return [line.decode(errors="replace") for line in lines]

    def end(self):
        """Its exit code, negative for a signal. Nothing that it has started goes on."""
        try:
            self.process.wait(5.0)  # the end of what it prints comes just before its own
        except subprocess.TimeoutExpired:
            pass
        try:
            os.killpg(self.process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        self.selector.close()
        self.process.stdout.close()
        return self.process.wait()


class Run:
    """Results of a program's cases, and what it printed beside them."""

    def __init__(self, program, seconds):
        self.program, self.seconds = program, seconds
        self.results, self.beside, self.complaint = [], [], ""  # beside: lines that are of no case

    def run(self, cases):
        """Runs them in one process, those after a case that ended it in another."""
        left = list(cases)
        while left:
            left = self.run_until_end(left)

    def run_until_end(self, cases):
        """Runs cases in a process. Returns those that its end left out."""
        left, case, output, since = dict.fromkeys(cases), None, [], time.monotonic()
        between = []  # lines since the last case
        failed_before = sum(r.outcome == "failed" for r in self.results)

        def finish(outcome):
            left.pop(case, None)
            self.results.append(Result(case, outcome, time.monotonic() - since, output))

        with tempfile.TemporaryDirectory() as folder:
            process = Process(self.program, cases, folder)
            try:
                while lines := process.lines_until(lambda: since + self.seconds):
                    for line in lines:
                        event = EVENT.search(line)
                        what, name = event.groups() if event else ("", "")
                        if what == "RUN" and case is None:
                            case, output, since = name, [], time.monotonic()
                        elif what and name == case:
                            output.append(line)
                            finish({"OK": "passed", "FAILED": "failed", "SKIPPED": "skipped"}[what])
                            case, since = None, time.monotonic()
                            self.beside += between
                            between = []
                        elif not line.startswith("Note: Google Test filter"):
                            (between if case is None else output).append(line)
                end = ""
            except TimeoutError:
                end = f"took longer than {self.seconds:.0f} s"
                process.process.kill()
            finally:
                code = process.end()
        end = end or ending(code)
        self.beside += between
        if case is None and left:  # between cases, such as while a suite is set up
            case, output = next(iter(left)), between
        if case is not None:
            finish(end)
        elif code != 0 and sum(r.outcome == "failed" for r in self.results) == failed_before:
            self.complaint = f"{self.program.name} {end} although no case failed"
        return list(left)


def again(case, program):
    return f"{os.path.relpath(program, os.environ.get('PRELIGHT_ROOT', os.getcwd()))} --gtest_filter={case}"


def report(run):
    """Prints what went wrong. Returns the exit code."""
    wrong = [r for r in run.results if r.outcome not in WENT_WELL]
    for result in wrong:
        print(f"--- {result.case}", *result.output, sep="\n")
    if run.complaint:
        print("--- beside the cases", *run.beside, run.complaint, sep="\n")
    counts = collections.Counter(r.outcome for r in run.results)
    print(f"{len(run.results)} cases: " + ", ".join(f"{count} {outcome}" for outcome, count in counts.most_common()))
    for result in wrong:
        print(f"{result.outcome}: {again(result.case, run.program)}")
    if wrong or run.complaint:
        return 1
    return ALL_SKIPPED if set(counts) == {"skipped"} else 0


def write_results(run, file):
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text("".join(f"{r.outcome}\t{r.seconds:.3f}\t{r.case}\t{run.program}\n" for r in run.results))


def summarize(folder):
    """Prints how many cases went how, and names those that did not pass."""
    rows = [line.split("\t") for file in sorted(folder.glob("*.txt")) for line in file.read_text().splitlines()]
    counts = collections.Counter(outcome for outcome, *_ in rows)
    print(f"{len(rows)} cases in all: " + ", ".join(f"{count} {outcome}" for outcome, count in counts.most_common()))
    for outcome, _, case, program in rows:
        if outcome == "skipped":
            print(f"  skipped: {case}")
        elif outcome != "passed":
            print(f"  {outcome}: {again(case, program)}")


def main():
    options = parse()
    if options.summary:
        summarize(options.summary)
        return 0
    program = options.program.resolve()
    cases = part_of(fnmatch.filter(cases_of(program), options.only), options.shard)
    alone = [case for case in cases if any(fnmatch.fnmatchcase(case, pattern) for pattern in options.alone)]
    run = Run(program, options.seconds)
    run.run([case for case in cases if case not in alone])
    for case in alone:
        run.run([case])
    if options.results:
        write_results(run, options.results)
    return report(run)


if __name__ == "__main__":
    sys.exit(main())
