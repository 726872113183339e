#!/usr/bin/env python3
"""Measures how soon the window answers a drag, for each shading: measure.py PRELIGHT SCENE SHADING...

It needs a C compiler, GLFW and xvfb-run. Each line has the number of drags, and the median, the 99th percentile and the
maximum of the time from a drag to the end of the next swap, in ms of wall-clock time and of processor time (all
threads): where other programs keep the machine busy, the processor time over the cores is what the wall-clock
time would be without them. `rest`: drags 1.5 s apart, while the picture is refined or done. `moving`: 30 a second.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

PHASES = os.environ.get("LATENCY_PHASES", "rest:30:1500 moving:15:33")
OPTIONS = ["--size", "1280x720"]


def percentile(values, share):
    return sorted(values)[min(int(share * len(values)), len(values) - 1)]


def measure(program, scene, shading, folder, library):
    results = folder / f"{shading}.txt"
    environment = {**os.environ, "LATENCY_FILE": str(results), "LATENCY_PHASES": PHASES, "LP_NUM_THREADS": "2"}
    command = ["xvfb-run", "-a", "-s", "-screen 0 1400x900x24", "env", f"LD_PRELOAD={library}", program, "view", scene,
               "--shading", shading, *OPTIONS]
    subprocess.run(command, env=environment, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    rows = [line.split() for line in results.read_text().splitlines()]
    for phase in dict.fromkeys(row[0] for row in rows):
        columns = [[float(row[column]) for row in rows if row[0] == phase] for column in (1, 2)]
        numbers = "   ".join(f"{percentile(c, 0.5):7.1f} {percentile(c, 0.99):7.1f} {max(c):7.1f}" for c in columns)
        print(f"{shading:12} {phase:8} {len(columns[0]):5}   {numbers}", flush=True)


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    program, scene, shadings = sys.argv[1], sys.argv[2], sys.argv[3:]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        library = folder / "inject.so"
        source = pathlib.Path(__file__).with_name("inject.c")
        subprocess.run(["cc", "-O1", "-shared", "-fPIC", "-o", library, source, "-ldl", "-lpthread", "-lm"], check=True)
        print("shading      phase    drags   wall ms: median, 99 %, most   processor ms: median, 99 %, most")
        for shading in shadings:
            measure(program, scene, shading, folder, library)


if __name__ == "__main__":
    main()
