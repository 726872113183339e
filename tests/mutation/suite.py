"""The test programs of a build: which there are, what they cost, and how to run one until its first failure."""

import dataclasses
import json
import os
import pathlib
import re
import resource
import subprocess

MEMORY = 12 << 30  # bytes of address space that a test program may take


@dataclasses.dataclass
class TestProgram:
    name: str
    room: str  # folder below tests/, "scene/gltf"
    folder: str  # it runs in
    seconds: float = 0.0  # of processor time, of a whole run without a mutation
    failing: tuple = ()  # tests that fail without a mutation


@dataclasses.dataclass
class Outcome:
    caught: bool
    by: str  # the first test that failed, or what else happened
    seconds: float  # of processor time


def test_programs(build):
    """Those that gtest_discover_tests knows, by name. None is run for it."""
    programs = {}
    for script in sorted(pathlib.Path(build, "tests").glob("**/*_include.cmake")):
        name = re.sub(r"\[\d+\]_include$", "", script.stem)
        room = script.parent.relative_to(pathlib.Path(build, "tests")).as_posix()
        programs[name] = TestProgram(name, room, str(script.parent))
    return programs


def limits(seconds):
    def apply():
        resource.setrlimit(resource.RLIMIT_CPU, (int(seconds), int(seconds) + 5))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    return apply


def environment(caches):
    """Caches of kernels apart from the user's: mutated kernels would fill those."""
    return dict(os.environ, XDG_CACHE_HOME=str(caches), POCL_CACHE_DIR=str(caches / "pocl"),
                GTEST_COLOR="no", NO_COLOR="1")


def run(build, program, caches, tests="*", fail_fast=True, seconds=None):
    """Runs the program's tests of a filter. Processor time bounds it, so that a busy machine does not; what sleeps for
    good is ended after ten times that."""
    seconds = seconds or 20.0 + 4.0 * program.seconds
    filters = tests + ("-" + ":".join(program.failing) if program.failing else "")
    command = [str(pathlib.Path(build, "bin", program.name)), f"--gtest_filter={filters}", "--gtest_brief=1"]
    if fail_fast:
        command.append("--gtest_fail_fast")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    # A group of its own, so that what a test has started ends with it.
    process = subprocess.Popen(command, cwd=program.folder, env=environment(caches), preexec_fn=limits(seconds),
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               start_new_session=True)
    try:
        output = process.communicate(timeout=180.0 + 10.0 * program.seconds)[0].decode(errors="replace")
        status = f"exit {process.returncode}"
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, 9)
        output = process.communicate()[0].decode(errors="replace")
        status = "time-out"
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    failed = re.findall(r"^\[  FAILED  \] ([\w./]+)", output, re.MULTILINE)
    if process.returncode == -24 or process.returncode == -9:
        status = "time-out"
    return Outcome(process.returncode != 0, ", ".join(dict.fromkeys(failed)) or status, spent)


def measured(build, programs, caches, file):
    """Seconds and failures of every program, from the file or else by running them all once."""
    known = json.loads(file.read_text()) if file.exists() else {}
    for program in programs.values():
        if program.name not in known:
            outcome = run(build, program, caches, fail_fast=False, seconds=3000.0)
            failing = outcome.by.split(", ") if outcome.caught else []
            known[program.name] = {"seconds": outcome.seconds, "failing": failing}
            file.write_text(json.dumps(known, indent=1))
            print(f"{program.name}: {outcome.seconds:.0f} s{', fails: ' + outcome.by if failing else ''}", flush=True)
        program.seconds = known[program.name]["seconds"]
        program.failing = tuple(known[program.name]["failing"])
