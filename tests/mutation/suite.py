"""The test programs of a build: their names, their cost, and how to run one until its first failure."""

import dataclasses
import json
import os
import pathlib
import re
import resource
import subprocess

MEMORY = 12 << 30  # Bytes of address space that a test program may use.
UNKNOWN_SECONDS = 600.0  # Processor time for a program that has no complete run yet.


@dataclasses.dataclass
class TestProgram:
    name: str
    room: str  # Folder below tests/, such as "scene/gltf".
    folder: str  # Working directory.
    seconds: float = 0.0  # Processor time of a complete run without a mutation.
    failing: tuple = ()  # Tests that fail without a mutation.


@dataclasses.dataclass
class Outcome:
    caught: bool
    by: str  # The first test that failed, or what else happened.
    seconds: float  # Processor time.


def test_programs(build):
    """The programs that gtest_discover_tests knows, by name, without running any."""
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
    """Separate caches of kernels, because mutated kernels would fill the user's."""
    return dict(os.environ, XDG_CACHE_HOME=str(caches), POCL_CACHE_DIR=str(caches / "pocl"),
                GTEST_COLOR="no", NO_COLOR="1")


def run(build, program, caches, tests="*", fail_fast=True):
    """Runs the program's tests of a filter. Processor time bounds it, so that a busy machine does not; what sleeps for
    good is ended after ten times that."""
    seconds = 20.0 + 4.0 * program.seconds if program.seconds else UNKNOWN_SECONDS
    filters = tests + ("-" + ":".join(program.failing) if program.failing else "")
    command = [str(pathlib.Path(build, "bin", program.name)), f"--gtest_filter={filters}", "--gtest_brief=1"]
    if fail_fast:
        command.append("--gtest_fail_fast")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    # The process gets a group of its own, so that processes started by a test end with it.
    process = subprocess.Popen(command, cwd=program.folder, env=environment(caches), preexec_fn=limits(seconds),
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               start_new_session=True)
    try:
        output = process.communicate(timeout=180.0 + 10.0 * seconds)[0].decode(errors="replace")
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


class Known:
    """Results of programs without a change: processor seconds of a whole run, and tests that fail anyway."""

    def __init__(self, file, programs):
        self.file = file
        self.entries = json.loads(file.read_text()) if file.exists() else {}
        for program in programs.values():
            entry = self.entries.get(program.name, {})
            program.seconds = entry.get("seconds", 0.0)
            program.failing = tuple(entry.get("failing", []))

    def learn(self, program, seconds=0.0, failing=()):
        program.seconds = max(program.seconds, seconds)
        program.failing = tuple(dict.fromkeys([*program.failing, *failing]))
        self.entries[program.name] = {"seconds": program.seconds, "failing": list(program.failing)}
        self.file.write_text(json.dumps(self.entries, indent=1))
