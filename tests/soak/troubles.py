"""What may go wrong while a command runs: calls of the system that fail, signals, limits on memory and file sizes."""
import collections
import os
import resource
import signal
import subprocess
import time

# kind: none, call, kill, stop, memory or size; value: the failing call, seconds until the signal, or bytes of the limit.
Trouble = collections.namedtuple("Trouble", "kind value", defaults=("none", None))
# code: exit code, negative for a signal; output, errors: text; seconds: of wall-clock time; late: whether it was ended
# because it took too long.
End = collections.namedtuple("End", "code output errors seconds late")

LONGEST = 180.0  # seconds that a command may take
CALLS = {"allocation": 200000, "open": 400, "write": 200, "thread": 12, "rename": 4, "read": 400}
REFUSED = {2, 3}  # the command as a whole does not suit its scene
SPOILT = {3, 5}  # a scene that is damaged
AGREED = {0, 1, 3, 4, 5}


def draw(random):
    """Draws a trouble; numbers of calls and seconds are small more often than large."""
    kind = random.choice(["none", "call", "call", "kill", "stop", "memory", "size"])
    if kind == "call":
        call = random.choice(list(CALLS))
        number = int(CALLS[call] ** random.random())
        return Trouble(kind, f"{call} {number} {random.choice(['once', 'forever'])}")
    if kind in ("kill", "stop"):
        return Trouble(kind, 0.02 * 100 ** random.random())
    if kind == "memory":
        return Trouble(kind, int(2 ** random.uniform(28, 32)))
    if kind == "size":
        return Trouble(kind, int(2 ** random.uniform(6, 20)))
    return Trouble()


def limits_of(trouble):
    """Returns what the child process does before the program starts, or None."""
    if trouble.kind == "memory":
        return lambda: resource.setrlimit(resource.RLIMIT_AS, (trouble.value, trouble.value))
    if trouble.kind == "size":
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (trouble.value, trouble.value))
        return limit
    return None


def environment_of(trouble, place):
    environment = {**os.environ, "TMPDIR": str(place.spill), "XDG_CACHE_HOME": str(place.cache),
                   "POCL_CACHE_DIR": str(place.cache)}
    if trouble.kind == "call":
        counts = place.spill.parent / "counts"
        counts.write_bytes(bytes(8 * 16))
        # What Mesa, PoCL 3 and hwloc do when a call of theirs fails alone, no caller can notice.
        environment.update(LD_PRELOAD=str(place.faults), PRELIGHT_FAULT=trouble.value, PRELIGHT_FAULT_COUNTS=str(counts),
                           PRELIGHT_FAULT_SPARES="swrast_dri:gallium:libpocl:libhwloc")
    return environment


def run(arguments, place, trouble=Trouble()):
    """Runs the program in the place's folder and waits for its end."""
    started = time.monotonic()
    process = subprocess.Popen([place.program, *arguments], cwd=place.folder, env=environment_of(trouble, place),
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               preexec_fn=limits_of(trouble))
    late = False
    try:
        if trouble.kind in ("kill", "stop"):
            output, errors = wait_and_signal(process, trouble)
        else:
            output, errors = process.communicate(timeout=LONGEST)
    except subprocess.TimeoutExpired:
        late = True
        process.kill()
        output, errors = process.communicate()
    return End(process.returncode, output.decode(errors="replace"), errors.decode(errors="replace"),
               time.monotonic() - started, late)


def wait_and_signal(process, trouble):
    try:
        return process.communicate(timeout=trouble.value)
    except subprocess.TimeoutExpired:
        process.send_signal(signal.SIGKILL if trouble.kind == "kill" else signal.SIGTERM)
        return process.communicate(timeout=LONGEST)


def ends_as_agreed(end, trouble):
    """Returns whether an exit code is one that the manual names for what went wrong."""
    if trouble.kind == "kill":
        return end.code in (0, -signal.SIGKILL)
    if trouble.kind == "stop":
        return end.code in (0, 130)
    return end.code in (AGREED if trouble.kind != "none" else {0})
