#!/usr/bin/env python3
"""Processor time of denoised `full` and of Cycles with its own denoiser to the same errors.

    time_denoised.py FOLDER SCENE[@SKY] ... --prelight build/bin/prelight [--size 320x180] [--runs 2]

For each scene: draws truths in parts by `prelight reference` where they are not in FOLDER yet, pictures of both at several
samples per pixel, in one go, and prints a table: relMSE over 99 % of the pixels less the truth's own noise, mean FLIP, and
seconds of all processors for the whole command (the least of --runs). Then, for every picture of Cycles, the cheapest one of
`full` that errs no more by either measure, and its share of Cycles' time: as it is, and less what starting Python and
Blender takes (`import bpy`), which is measured, too. Needs bpy, OpenEXR, Pillow, numpy, matplotlib, flip_evaluator;
Prelight finds the library of its denoiser by PRELIGHT_OIDN_LIBRARY.
"""

import argparse
import pathlib
import resource
import subprocess
import sys

import flip_evaluator
import numpy

from compare_grid import read_picture, relative_error
from compare_models import prepare
from time_models import draw, picture_path, read_truths

SAMPLES = {"denoised": (4, 16, 64), "full-denoised": (2, 4, 8, 16, 32, 64)}
PART = 256  # samples per pixel of a part of a truth
STARTS = 3


def draw_truths(options):
    for part in range(options.parts):
        path = options.folder / f"{options.name}_truth_reference_{part:02}.exr"
        if not path.exists():
            draw(options, "reference", PART, 1000 + part, path)


def displayed(picture, truth):
    """As a display shows it, exposed for the truth's geometric mean."""
    light = picture * 0.2 / numpy.exp(numpy.log(truth.mean(-1) + 1e-4).mean())
    return (numpy.clip(1.25 * light / (1 + light), 0, 1) ** (1 / 2.2)).astype(numpy.float32)


def start_seconds():
    """Seconds of processors of a Python that loads Blender and ends."""
    least = []
    for _ in range(STARTS):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([sys.executable, "-c", "import bpy"], check=True, capture_output=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        least.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return min(least)


def measure(options, truth, noise):
    """{kind: [(samples, relMSE, FLIP, seconds)]}; one picture is drawn of each and not counted."""
    rows = {kind: [] for kind in SAMPLES}
    for kind, counts in SAMPLES.items():
        draw(options, kind, 1, 1, picture_path(options, kind, 1, 0))
        for samples in counts:
            path = picture_path(options, kind, samples, 1)
            seconds = min(draw(options, kind, samples, 1, path)[2] for _ in range(options.runs))
            picture = read_picture(path)
            flip = flip_evaluator.evaluate(displayed(truth, truth), displayed(picture, truth), "LDR")[1]
            rows[kind].append((samples, relative_error(picture, truth) - noise, float(flip), seconds))
            print(options.name, kind, *rows[kind][-1], file=sys.stderr, flush=True)
    return rows


def shares(rows, start):
    lines = []
    for samples, error, flip, seconds in rows["denoised"]:
        enough = [r for r in rows["full-denoised"] if r[1] <= error and r[2] <= flip]
        if not enough:
            lines.append(f"Cycles, {samples} samples: no picture of `full` errs as little")
            continue
        best = min(enough, key=lambda r: r[3])
        lines.append(f"Cycles, {samples} samples: `full` with {best[0]} takes {best[3] / seconds:.2f} of its time, "
                     f"{best[3] / (seconds - start):.2f} without the start of Python and Blender ({start:.2f} s)")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--prelight", required=True)
    parser.add_argument("--size", default="320x180")
    parser.add_argument("--runs", type=int, default=2)
    parser.add_argument("--parts", type=int, default=4, help=f"of {PART} samples per pixel, that a truth is drawn in")
    options = parser.parse_args()
    options.frame, options.part = False, PART
    options.folder.mkdir(parents=True, exist_ok=True)
    start = start_seconds()
    for scene in options.scenes:
        source, _, options.env = scene.partition("@")
        options.name = pathlib.Path(source).stem
        options.scene = options.folder / f"{options.name}.glb"
        if not options.scene.exists():
            prepare(pathlib.Path(source), options.scene, options)
        draw_truths(options)
        truth, noise, samples = read_truths(options)["reference"]
        rows = measure(options, truth, noise)
        print(f"\n`{options.name}`, {options.size}, truth of {samples} samples, its noise {noise:.5f}\n")
        print("| | samples | relMSE | FLIP | seconds |\n|---|---|---|---|---|")
        for kind, name in (("denoised", "Cycles, denoised"), ("full-denoised", "`full --denoise`")):
            for row in rows[kind]:
                print(f"| {name} | {row[0]} | {row[1]:.5f} | {row[2]:.4f} | {row[3]:.2f} |")
        print("\n" + "\n".join(shares(rows, start)), flush=True)


if __name__ == "__main__":
    main()
