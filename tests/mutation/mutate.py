#!/usr/bin/env python3
"""Changes one token of kernels/ or host/ at a time and counts how often the tests notice. docs/notes/testing.md says how.

The changes are made in a copy of the sources below the work folder, never in the tree itself. Results are written after
every change, so that a run that was stopped goes on where it was.
"""

import argparse
import contextlib
import dataclasses
import json
import pathlib
import shutil
import subprocess
import sys
import time

import mutations
import suite

# Folders of tests that know a file's code best, besides the changed file's own folder.
NEAR = {"host/gpu": ["gpu", "integrators", "photon"], "host/plan": ["plan", "bake"],
        "host/receivers": ["receivers", "fit", "charts"], "host/cast": ["cast", "techniques", "bake"],
        "host/fit": ["fit", "techniques"], "host/techniques": ["techniques", "bake", "charts", "io"],
        "host/integrators": ["integrators"], "host/oracle": ["gpu", "relight"], "kernels/core": ["device", "receivers", "bvh"],
        "kernels/bvh": ["bvh", "gpu"], "kernels/cast": ["cast", "bake"], "kernels/project": ["cast", "techniques"],
        "kernels/transport": ["transport", "integrators", "photon"], "kernels/gather": ["gi", "charts"],
        "kernels/integrate": ["integrators"], "kernels/shared": ["device"]}


def parse():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[2],
                        help="the sources")
    parser.add_argument("--work", type=pathlib.Path, required=True,
                        help="folder for a copy of the sources, its build, caches and results")
    parser.add_argument("--count", type=int, default=100, help="changes that compile")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--map", type=pathlib.Path, help="what tests/coverage/coverage.py has written with --map: only "
                        "programs that execute the changed line are run")
    parser.add_argument("--seconds", type=float, default=1e9, help="stop asking about a change once the programs that "
                        "were run for it take this many seconds; --finish asks the others later")
    parser.add_argument("--near", action="store_true", help="run only the programs of the changed code's own room; "
                        "--finish asks the others later")
    parser.add_argument("--finish", action="store_true", help="go on with the survivors of earlier runs")
    parser.add_argument("--only", help="numbers of the changes to make, such as 3,17")
    parser.add_argument("--again", type=pathlib.Path, help="results of an earlier run whose survivors (or --only) are made "
                        "again, in the sources as they are now")
    parser.add_argument("--list", action="store_true", help="print the changes instead of making them")
    parser.add_argument("--jobs", type=int, default=2)
    return parser.parse_args()


class Workplace:
    """A copy of the sources with a build of its own."""

    def __init__(self, root, work, jobs):
        self.source, self.caches, self.jobs = work / "source", work / "caches", jobs
        self.build = self.source / "build"
        self.caches.mkdir(parents=True, exist_ok=True)
        for folder in ("kernels", "host", "viewer", "tests", "benchmarks"):
            self.mirror(root / folder, self.source / folder)
        for file in ("CMakeLists.txt", "CMakePresets.json"):
            self.mirror(root / file, self.source / file)
        if not (self.build / "build.ninja").exists():
            subprocess.run(["cmake", "-S", self.source, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                            f"-DCMAKE_CXX_COMPILER_LAUNCHER={self.launcher(work)}"], check=True)

    @staticmethod
    def launcher(work):
        """A script that compiles with the usual options, so that ccache has the objects, and otherwise lets warnings pass."""
        script, cache = work / "compile", shutil.which("ccache") or ""
        script.write_text(f'#!/bin/sh\n{cache} "$@" 2>/dev/null || exec {cache} "$@" -Wno-error\n')
        script.chmod(0o755)
        return script

    def mirror(self, origin, copy):
        """Copies only files that differ, so that nothing is built again without need."""
        if origin.is_file():
            if not copy.exists() or copy.read_bytes() != origin.read_bytes():
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(origin, copy)
            return
        for child in origin.iterdir():
            if child.name != "__pycache__":
                self.mirror(child, copy / child.name)

    def make(self, *targets):
        return subprocess.run(["ninja", "-C", self.build, "-j", str(self.jobs), *targets], capture_output=True, text=True)


def rooms_near(mutation):
    """Rooms of tests that are about the changed code, the nearest first."""
    parts = mutation.file.split("/")
    own = ["/".join(parts[1:end]) for end in range(len(parts) - 1, 1, -1)]
    return own + NEAR.get("/".join(parts[:2]), [])


def programs_for(mutation, programs, covering, only_near):
    """The programs that can notice the change: the room's own first, then the cheapest."""
    near = rooms_near(mutation)
    chosen = [p for p in programs.values() if (covering is None or p.name in covering) and (p.room in near or not only_near)]
    rank = lambda p: (near.index(p.room) if p.room in near else len(near), p.seconds)
    return sorted(chosen, key=rank)


class Coverage:
    """The lines and the kernel files that each program executes."""

    def __init__(self, file):
        self.map = json.loads(file.read_text()) if file else None

    def programs(self, mutation):
        if self.map is None:
            return None
        if mutation.file.endswith(".cl"):
            return set(self.map["kernel_files"].get(mutation.file.split("/", 1)[1], []))
        lines = self.map["host_lines"].get(mutation.file)
        if lines is None or mutation.file.endswith(".h") or str(mutation.line) not in lines:
            # Declarations and headers have no line counters: any program that enters the file may notice.
            return {p for programs in (lines or {}).values() for p in programs} or None
        return set(lines[str(mutation.line)])


def targets_of(programs):
    """The targets that ninja has to make before they run; tests of the command line drive the program."""
    return [f"bin/{p.name}" for p in programs] + (["bin/prelight"] if any(p.room == "cli" for p in programs) else [])


@contextlib.contextmanager
def written(file, text):
    """Writes `text` into the file for as long as the context lasts."""
    before = file.read_text()
    file.write_text(text)
    try:
        yield
    finally:
        file.write_text(before)


def fails_anyway(place, program, outcome, mutation, original, known):
    """Runs the failed tests without the change. Tests that fail again are left out from then on."""
    with written(place.source / mutation.file, original):
        place.make(*targets_of([program]))
        names = [name for name in outcome.by.split(", ") if "." in name]
        again = suite.run(place.build, program, place.caches, tests=":".join(names) or "*", fail_fast=False)
        known.learn(program, 0.0 if names else again.seconds, again.by.split(", ") if again.caught else ())
    place.make(*targets_of([program]))
    return again.caught


def judge(place, mutation, original, programs, result, known, options):
    """Runs programs until one fails, and adds their results to `result`."""
    spent = 0.0
    for program in programs:
        if program.name in result["ran"]:
            continue
        if spent >= options.seconds:
            result["verdict"] = "unfinished"
            return
        made = place.make(*targets_of([program]))
        if made.returncode != 0:
            result["verdict"] = "does not compile"
            return
        outcome = suite.run(place.build, program, place.caches)
        while outcome.caught and fails_anyway(place, program, outcome, mutation, original, known):
            outcome = suite.run(place.build, program, place.caches)
        spent += outcome.seconds
        result["seconds"] = result.get("seconds", 0.0) + outcome.seconds
        result["ran"].append(program.name)
        if outcome.caught:
            result.update(verdict="caught", program=program.name, by=outcome.by)
            return
        known.learn(program, outcome.seconds)
    result["verdict"] = "unfinished" if options.near else "survived"


def relocated(mutation, root):
    """The change in sources that have changed since: the same line of text, nearest to its former place."""
    lines = pathlib.Path(root, mutation.file).read_text().split("\n")
    found = [n for n, line in enumerate(lines, 1) if line == mutation.text]
    if not found:
        return None
    return dataclasses.replace(mutation, line=min(found, key=lambda n: abs(n - mutation.line)))


def described(number, mutation):
    return f"{number:4} {mutation.file}:{mutation.line}:{mutation.column} {mutation.old} -> {mutation.new or '(nothing)'}"


def load_results(file):
    if not file.exists():
        return {}
    return {r["number"]: r for r in map(json.loads, file.read_text().splitlines())}


def summary(results):
    counts = {}
    for result in results.values():
        counts[result["verdict"]] = counts.get(result["verdict"], 0) + 1
    print(", ".join(f"{count} {verdict}" for verdict, count in sorted(counts.items())))
    for number, result in sorted(results.items()):
        if result["verdict"] in ("survived", "unfinished"):
            mutation = mutations.Mutation(**result["mutation"])
            print(f"{described(number, mutation)} ({result['verdict']})\n      {mutation.text.strip()}")


def changes_to_make(options, results):
    """(number, mutation, result so far) in the order in which they are tested."""
    only = {int(n) for n in options.only.split(",")} if options.only else None
    if options.again:
        for number, old in sorted(load_results(options.again).items()):
            if number in only if only else old["verdict"] in ("survived", "unfinished"):
                mutation = relocated(mutations.Mutation(**old["mutation"]), options.root)
                if mutation:
                    yield number, mutation, {"ran": []}
                else:
                    print(f"{number:4} its line is gone")
        return
    for number, mutation in enumerate(mutations.drawn(options.root, options.seed)):
        known = results.get(number)
        if only is not None and number not in only:
            continue
        if known is None and not options.finish:
            yield number, mutation, {"ran": []}
        elif known and options.finish and known["verdict"] in ("survived", "unfinished"):
            yield number, mutation, known


def main():
    options = parse()
    options.work.mkdir(parents=True, exist_ok=True)
    file = options.work / (f"again-{int(time.time())}.jsonl" if options.again else f"results-{options.seed}.jsonl")
    results = load_results(file)
    if options.list:
        for number, mutation, _ in changes_to_make(options, results):
            if number >= options.count and not options.only:
                break
            print(f"{described(number, mutation)}\n      {mutation.text.strip()}")
        return 0
    place = Workplace(options.root, options.work.resolve(), options.jobs)
    programs = suite.test_programs(place.build)
    known = suite.Known(options.work / "programs.json", programs)
    coverage = Coverage(options.map)
    for number, mutation, result in changes_to_make(options, results):
        if not options.finish and not options.again and \
                sum(r["verdict"] != "does not compile" for r in results.values()) >= options.count:
            break
        started = time.time()
        asked = programs_for(mutation, programs, coverage.programs(mutation), options.near)
        original = (place.source / mutation.file).read_text()
        with written(place.source / mutation.file, mutation.applied(original)):
            judge(place, mutation, original, asked, result, known, options)
        result.update(number=number, mutation=dataclasses.asdict(mutation))
        results[number] = result
        with file.open("a") as out:
            out.write(json.dumps(result) + "\n")
        print(f"{described(number, mutation)}: {result['verdict']} {result.get('by', '')} ({time.time() - started:.0f} s)", flush=True)
    summary(results)
    return 0


if __name__ == "__main__":
    sys.exit(main())
