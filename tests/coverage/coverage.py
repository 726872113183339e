#!/usr/bin/env python3
"""Runs test programs of a coverage build and lists what of host/ and which kernels they never execute.

    cmake --preset coverage && cmake --build --preset coverage
    tests/coverage/coverage.py --build build-coverage

docs/notes/testing.md says how to read the result. A map from lines and kernel files to test programs goes where --map says;
tests/mutation reads it.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "mutation"))
import suite  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build-coverage")
    parser.add_argument("--root", type=pathlib.Path, default=ROOT, help="the sources of that build")
    parser.add_argument("--programs", help="names of test programs, separated by commas; all without it")
    parser.add_argument("--map", type=pathlib.Path, default=None, help="default: coverage.json in the build folder; what "
                        "earlier runs have found of other programs is kept")
    parser.add_argument("--report", action="store_true", help="run nothing, report what the map says")
    parser.add_argument("--jobs", type=int, default=2)
    return parser.parse_args()


def preloaded(build):
    """The library that notes down kernel launches."""
    library = build / "trace_kernels.so"
    subprocess.run(["cc", "-O1", "-shared", "-fPIC", "-o", library, ROOT / "tests/coverage/trace_kernels.c", "-ldl"],
                   check=True)
    return library


def gcov_lines(counters):
    """{file: {line: times executed}} of one object's counters."""
    out = subprocess.run(["gcov", "--json-format", "--stdout", counters.name], cwd=counters.parent, capture_output=True)
    found = collections.defaultdict(dict)
    for text in out.stdout.splitlines():
        for file in json.loads(text)["files"]:
            # The path as the compiler was given it: from the root or from somewhere in the build folder.
            match = re.search(r"^(?:.*/)?(host/.*\.(?:cpp|h))$", file["file"])
            if not match or file["file"].startswith("/usr/"):
                continue
            lines = found[match.group(1)]
            for line in file["lines"]:
                number = line["line_number"]
                lines[number] = max(lines.get(number, 0), line["count"])
    return found


def run_traced(options, program, library):
    """Runs a program alone and returns its lines and kernels."""
    for counters in options.build.rglob("*.gcda"):
        counters.unlink()
    with tempfile.TemporaryDirectory() as folder:
        trace = pathlib.Path(folder, "kernels")
        env = dict(os.environ, LD_PRELOAD=str(library), PRELIGHT_KERNEL_TRACE=str(trace),
                   # Makes the device compile kernels from their sources, which name their files.
                   XDG_CACHE_HOME="/dev/null",
                  
                   POCL_CACHE_DIR=os.environ.get("POCL_CACHE_DIR", str(options.build / "pocl")))
        subprocess.run([options.build / "bin" / program.name, "--gtest_brief=1"], cwd=program.folder, env=env)
        launches = trace.read_text().splitlines() if trace.exists() else []
    lines = collections.defaultdict(dict)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for found in pool.map(gcov_lines, list(options.build.rglob("*.gcda"))):
            for file, counts in found.items():
                for number, count in counts.items():
                    lines[file][number] = max(lines[file].get(number, 0), count)
    return lines, launches


def take_in(known, program, lines, launches):
    """Adds a program's run to the map in place of what an earlier run of it has found."""
    for table in ("host_lines", "kernel_files", "kernels"):
        values = known[table].values() if table != "host_lines" else [p for f in known[table].values() for p in f.values()]
        for programs in values:
            if program in programs:
                programs.remove(program)
    for file, counts in lines.items():
        entry = known["host_lines"].setdefault(file, {})
        for number, count in counts.items():
            programs = entry.setdefault(str(number), [])
            if count > 0:
                programs.append(program)
    for launch in launches:
        name, *files = launch.split()
        for table, keys in (("kernels", [name]), ("kernel_files", files)):
            for key in keys:
                programs = known[table].setdefault(key, [])
                if program not in programs:
                    programs.append(program)
    known["programs"] = sorted({*known["programs"], program})


def ranges(numbers):
    """[1, 2, 3, 7] as "1-3, 7"."""
    parts = []
    for n in sorted(numbers):
        if parts and parts[-1][1] == n - 1:
            parts[-1][1] = n
        else:
            parts.append([n, n])
    return ", ".join(str(a) if a == b else f"{a}-{b}" for a, b in parts)


def all_kernels(root):
    names = {}
    for path in sorted([*(root / "kernels").rglob("*.cl"), *(root / "host").rglob("*.cl")]):
        for name in re.findall(r"__kernel\s+(?:__attribute__\s*\(\(.*?\)\)\s*)*void\s+(\w+)", path.read_text(), re.DOTALL):
            names[name] = path.relative_to(root).as_posix()
    return names


def report(known, root):
    print(f"{len(known['programs'])} test programs: {', '.join(known['programs'])}\n")
    names = all_kernels(root)
    idle = [n for n in names if not known["kernels"].get(n)]
    print(f"Kernels: {len(names) - len(idle)} of {len(names)} launched")
    for name in idle:
        print(f"  {name} ({names[name]})")
    total = executed = 0
    rows = []
    for file, lines in sorted(known["host_lines"].items()):
        missed = [int(n) for n, programs in lines.items() if not programs]
        total, executed = total + len(lines), executed + len(lines) - len(missed)
        if missed:
            rows.append(f"  {file}: {len(lines) - len(missed)} of {len(lines)}; not {ranges(missed)}")
    print(f"\nLines of host/: {executed} of {total} executed ({100.0 * executed / max(total, 1):.1f} %)")
    print("\n".join(rows))
    absent = [f for f in (p.relative_to(root).as_posix() for p in sorted((root / "host").rglob("*.cpp")))
              if f not in known["host_lines"]]
    if absent:
        print("\nFiles that no program enters:\n  " + "\n  ".join(absent))


def main():
    options = parse()
    options.build = options.build.resolve()
    file = options.map or options.build / "coverage.json"
    known = json.loads(file.read_text()) if file.exists() else \
        {"programs": [], "host_lines": {}, "kernel_files": {}, "kernels": {}}
    if not options.report:
        library = preloaded(options.build)
        programs = suite.test_programs(options.build)
        chosen = options.programs.split(",") if options.programs else sorted(programs)
        for name in chosen:
            print(f"{name} ...", file=sys.stderr, flush=True)
            take_in(known, name, *run_traced(options, programs[name], library))
            file.write_text(json.dumps(known))
    report(known, options.root.resolve())
    return 0


if __name__ == "__main__":
    sys.exit(main())
