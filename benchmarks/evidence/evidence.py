#!/usr/bin/env python3
"""Takes the numbers of docs/notes/sources.md from runs of the page's own commands.

    evidence.py run [ID...]      runs the commands of these rows (all that are not slow) and rewrites their cells
    evidence.py run --slow       also runs the benchmarks, whose times need an idle machine
    evidence.py run --missing    runs only the rows that have no number yet
    evidence.py check [ID...]    runs them and lists the cells that differ by more than their tolerance
    evidence.py write            rewrites the cells from results.json without a run; changes nothing the second time
    evidence.py verify           says whether the page is what write would make of it
    evidence.py list             lists the rows that have numbers, and those that were not measured

A row whose cell *here* begins with `<!--ID-->` has an entry in numbers.py: a text with a place for each number, and
where the output of the row's commands has it. Nothing else may write numbers into such a cell. results.json keeps
values, date and commit; both files stand beside this one.

Options: --program FILE (default build/bin/prelight), --work FOLDER (default build/evidence; pictures that exist there
are used again). Needs Python 3.9 and nothing else.
"""

import argparse
import datetime
import json
import pathlib
import re
import shlex
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PAGE = ROOT / "docs/notes/sources.md"
RESULTS = HERE / "results.json"
MARKER = re.compile(r"<!--([a-z0-9.-]+)-->")
NOT_MEASURED = "not measured"
SEEN_BY = 4  # column of the commands
RUNS_BEGIN, RUNS_END = "<!-- runs -->", "<!-- end of runs -->"

sys.path.insert(0, str(HERE))
import numbers_of_the_page  # noqa: E402  (beside this script)

NUMBERS = numbers_of_the_page.NUMBERS


def commands_in(text):
    return re.findall(r"`prelight ([^`]+)`", text)


def rows_with_numbers(page):
    """Returns the commands of each ID, in their order, without `prelight`."""
    rows = {}
    for line in page.splitlines():
        found = MARKER.search(line)
        if line.startswith("|") and found:
            rows[found.group(1)] = commands_in(line.split(" | ")[SEEN_BY])
    return rows


def made_beforehand(page):
    """Returns the command that makes each file of the page's table of truths."""
    table = {}
    for line in page.splitlines():
        if re.match(r"\| `[^`]+\.(exr|glb)` \|", line):
            name = re.match(r"\| `([^`]+)`", line).group(1)
            table[name] = commands_in(line)[0]
    return table


class Runner:
    """Runs commands in a folder, each once, and makes the files that they read."""

    def __init__(self, program, folder, page):
        self.program, self.folder = program, folder
        self.truths = made_beforehand(page)
        self.reports = {}
        folder.mkdir(parents=True, exist_ok=True)

    def report(self, command):
        """Returns what a command prints with --json."""
        if command not in self.reports:
            self.reports[command] = self.start(command)
        return self.reports[command]

    def start(self, command):
        words = shlex.split(command)
        output = words[words.index("-o") + 1] if "-o" in words else None
        for word in words:
            if word != output:
                self.make(word.split(":")[0])
        bench = words[0] == "bench"
        report = "bench.json"
        arguments = words + (["--json", report] if bench else ["--json", "--quiet"])
        print("  prelight", command, flush=True)
        done = subprocess.run([self.program, *arguments], cwd=self.folder, capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"prelight {command}: exit code {done.returncode}: {done.stderr.strip()}")
        return json.loads((self.folder / report).read_text() if bench else done.stdout)

    def make(self, name):
        if (self.folder / name).exists():
            return
        if name in self.truths:
            self.start(self.truths[name])
        elif re.fullmatch(r"[a-z-]+\.glb", name):
            self.start(f"scene {name[:-4]} -o {name}")


def at(report, path):
    """Returns the number at a path such as `picture.rmse`; a list gives its length, `NAME[]` the last element's."""
    value = report
    for name in path.split("."):
        last = name.endswith("[]")
        value = value[name[: -2 if last else None]]
        if last:
            value = value[-1]
    return len(value) if isinstance(value, list) else value


def bench_value(report, text):
    """Returns the value of `CASE|METRIC`, both parts of names."""
    case, metric = text.split("|")
    found = [r["value"] for r in report["results"] if case in r["case"] and metric == r["metric"]]
    if len(found) != 1:
        raise RuntimeError(f"{text}: {len(found)} results of the benchmark have this name")
    return found[0]


def value_of(source, commands, runner):
    """Returns the number of `VERB[N]:PATH[/PATH]`: of the Nth command of that name in the row (default 1)."""
    verb, paths = source.split(":", 1)
    name, number = re.fullmatch(r"([a-z]+)(\d*)", verb).groups()
    named = [command for command in commands if command.split()[0] == name]
    report = runner.report(named[int(number or 1) - 1])
    if name == "bench":
        return bench_value(report, paths)
    first, *second = paths.split("/")
    return at(report, first) / (at(report, second[0]) if second else 1)


def measure(row, commands, runner):
    for command in commands:  # in the order of the row: later ones read what earlier ones write
        runner.report(command)
    return [value_of(source, commands, runner) for source in NUMBERS[row]["values"]]


def shown(value):
    """Returns a number with two digits."""
    if float(value).is_integer() and abs(value) < 1e9:
        return f"{int(value):,}"
    if abs(value) >= 100:
        return f"{value:,.0f}"
    text = f"{value:.2g}"
    if "e" in text:
        mantissa, exponent = text.split("e")
        return f"{mantissa}e{int(exponent)}"
    return text


def scaled(row, values):
    scale = NUMBERS[row].get("scale", 1)
    return [value * scale for value in values]


def letters(results):
    """Returns a letter for each run, which is a date and a commit."""
    runs = sorted({(result["date"], result["commit"]) for result in results.values()})
    return {run: chr(ord("A") + index) if index < 26 else f"A{index}" for index, run in enumerate(runs)}


def cell_of(row, results):
    if row not in results:
        return f"<!--{row}--> {NOT_MEASURED}"
    result = results[row]
    text = NUMBERS[row]["text"].format(*map(shown, scaled(row, result["values"])))
    return f"<!--{row}--> {text} [{letters(results)[(result['date'], result['commit'])]}]"


def table_of_runs(results):
    lines = ["| run | date | commit | cells |", "|---|---|---|---|"]
    for run, letter in letters(results).items():
        count = sum((result["date"], result["commit"]) == run for result in results.values())
        lines.append(f"| [{letter}] | {run[0]} | {run[1]} | {count} |")
    return "\n".join(lines)


def written(page, results):
    """Returns the page with the cells that the results say."""
    lines = []
    for line in page.splitlines():
        found = MARKER.search(line)
        if line.startswith("|") and found:
            line = re.sub(r"<!--[a-z0-9.-]+-->[^|]*(?= \|)", lambda _: cell_of(found.group(1), results), line)
        lines.append(line)
    text = "\n".join(lines) + "\n"
    begin, end = text.index(RUNS_BEGIN) + len(RUNS_BEGIN), text.index(RUNS_END)
    return text[:begin] + "\n" + table_of_runs(results) + "\n" + text[end:]


def commit_of(program):
    text = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
    return re.search(r"\(([0-9a-f]{7,})", text).group(1)[:10]


def differences(old, new, tolerance):
    return [abs(a - b) > tolerance * max(abs(a), abs(b), 1e-12) for a, b in zip(old, new)]


def chosen(arguments, rows, results):
    if arguments.ids:
        unknown = [row for row in arguments.ids if row not in rows]
        if unknown:
            sys.exit(f"evidence.py: no row has the number {', '.join(unknown)}; evidence.py list shows them")
        return arguments.ids
    return [row for row in rows if (arguments.slow or not NUMBERS[row].get("slow"))
            and not (arguments.missing and row in results)]


def run(arguments, page, rows, results):
    """Measures, keeps each result as soon as it is there, and rewrites the page. Returns whether all rows ran."""
    runner = Runner(arguments.program, arguments.work, page)
    today, commit = datetime.date.today().isoformat(), commit_of(arguments.program)
    failed = 0
    for row in chosen(arguments, rows, results):
        print(row, flush=True)
        try:
            values = measure(row, rows[row], runner)
        except (RuntimeError, KeyError, IndexError, TypeError, ValueError) as error:
            print(f"  failed: {error!r}", file=sys.stderr)
            failed += 1
            continue
        results[row] = {"values": values, "date": today, "commit": commit}
        RESULTS.write_text(json.dumps(results, indent=1, sort_keys=True) + "\n")
        PAGE.write_text(written(PAGE.read_text(), results))
    return failed == 0


def check(arguments, page, rows, results):
    """Measures and compares. Returns whether all cells are up to date."""
    runner = Runner(arguments.program, arguments.work, page)
    fine = written(page, results) == page
    if not fine:
        print("the page is not what `evidence.py write` makes of results.json")
    for row in chosen(arguments, rows, results):
        if row not in results:
            print(f"{row}: {NOT_MEASURED}")
            continue
        values = measure(row, rows[row], runner)
        if any(differences(results[row]["values"], values, NUMBERS[row].get("tolerance", 0.1))):
            print(f"{row}: the page has {results[row]['values']}, a run has {values}")
            fine = False
    return fine


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("action", choices=["run", "check", "write", "verify", "list"])
    parser.add_argument("ids", nargs="*", metavar="ID")
    parser.add_argument("--slow", action="store_true", help="also rows that need benchmarks")
    parser.add_argument("--missing", action="store_true", help="only rows without a result")
    parser.add_argument("--program", default=str(ROOT / "build/bin/prelight"))
    parser.add_argument("--work", type=pathlib.Path, default=ROOT / "build/evidence")
    arguments = parser.parse_args()
    page = PAGE.read_text()
    rows = rows_with_numbers(page)
    results = json.loads(RESULTS.read_text()) if RESULTS.exists() else {}
    if set(rows) != set(NUMBERS):
        sys.exit(f"evidence.py: rows and numbers differ: {sorted(set(rows) ^ set(NUMBERS))}")
    if arguments.action == "list":
        for row in rows:
            print(row, results.get(row, NOT_MEASURED))
    elif arguments.action == "write":
        PAGE.write_text(written(page, results))
    elif arguments.action == "verify":
        if written(page, results) != page:
            sys.exit("evidence.py: the page is not what `evidence.py write` makes of results.json")
    elif not (run if arguments.action == "run" else check)(arguments, page, rows, results):
        sys.exit(1)


if __name__ == "__main__":
    main()
