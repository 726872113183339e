#!/usr/bin/env python3
"""Error over time of Prelight and Cycles, both with and without denoiser, on one scene.

    time_models.py FOLDER SCENE --prelight build/bin/prelight [--env SKY.exr] [--size 256x256] --truths [--truth-spp 4096]
    time_models.py FOLDER SCENE ... --times [--runs 3] [--only KIND ...]
    time_models.py FOLDER SCENE ...

The first draws the truths, in parts (--part, 512 samples per pixel), and keeps those that are there: one of Cycles, one of `prelight
reference`. The second draws every KIND (cycles, denoised, reference, full, reference-denoised, full-denoised) at several samples per pixel, `--runs` times with a
seed each (once where a picture takes more than ten seconds), after one picture of each that is not counted, and writes
NAME_times.json. The third writes NAME_times.md (a table, and times at equal error) and NAME_times.png (a chart).

Errors are relMSE over 99 % of the pixels (compare_grid.py), the mean of the runs, less the truth's own noise, which the scatter
of its parts tells. Times are medians: of rendering alone as each program reports it (Cycles: the call that renders, with its
scene sent, tree built, picture written; Prelight: stages `render` or `trace`, and `denoise`), of the whole command (with starting Python and
Blender), and of all its processors.
Needs bpy, OpenEXR, Pillow, numpy, matplotlib.
"""

import argparse
import json
import math
import pathlib
import re
import resource
import statistics
import subprocess
import sys
import time

import numpy

from compare_grid import read_picture, relative_error
from compare_models import prepare

SLOW = 10.0
DEPTH = 32
KINDS = {"cycles": (4, 16, 64, 256), "denoised": (4, 16, 64, 256), "reference": (4, 16, 64, 256), "full": (1, 4, 8, 16, 64),
         "reference-denoised": (4, 16, 64, 256), "full-denoised": (1, 4, 8, 16, 64)}
NAMES = {"cycles": "Cycles", "denoised": "Cycles, denoised", "reference": "`reference`", "full": "`full`",
         "reference-denoised": "`reference --denoise`", "full-denoised": "`full --denoise`"}


def command(options, kind, spp, seed, path):
    """The command that draws, of --depth 32 where paths have a depth; `full` has none."""
    common = [options.scene, "-o", path, "--size", options.size, "--spp", spp, "--seed", seed]
    common += ["--env", options.env] if options.env else []
    filtered = ["--denoise"] if kind.endswith("denoised") else []
    if kind.startswith("full"):
        return [options.prelight, "render", *common, "--shading", "full", "--json", *filtered]
    common += ["--depth", DEPTH]
    if kind.startswith("reference"):
        return [options.prelight, "reference", *common, "--json", *filtered]
    script = pathlib.Path(__file__).with_name("render_cycles.py")
    return [sys.executable, script, *common, *filtered]


def render_seconds(kind, output):
    if kind in ("cycles", "denoised"):
        return float(re.search(r"samples per pixel, ([0-9.]+) s", output).group(1))
    stages = json.loads(output)["stages"]
    return stages["trace" if kind.startswith("reference") else "render"] + stages.get("denoise", 0.0)


def draw(options, kind, spp, seed, path):
    """Draws, and tells the seconds: of the render, of the command, of the processors."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run([str(c) for c in command(options, kind, spp, seed, path)], capture_output=True, text=True)
    whole, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        sys.exit(f"{path.name}: ended with {done.returncode}\n{done.stdout[-2000:]}{done.stderr}")
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return render_seconds(kind, done.stdout), whole, processor


def truth_parts(options, kind):
    return sorted(options.folder.glob(f"{options.name}_truth_{kind}_*.exr"))


def draw_truths(options):
    for part in range(options.truth_spp // options.part):
        for kind in ("cycles", "reference"):
            path = options.folder / f"{options.name}_truth_{kind}_{part:02}.exr"
            if not path.exists():
                draw(options, kind, options.part, 1000 + part, path)


def read_truths(options):
    """{program: (mean of the parts, the relMSE that its own noise makes, its samples per pixel)} of those that were drawn"""
    out = {}
    for kind in ("cycles", "reference"):
        parts = numpy.array([read_picture(p) for p in truth_parts(options, kind)])
        if len(parts) < 2:
            continue
        even = parts[: len(parts) // 2 * 2]
        signs = numpy.where(numpy.arange(len(even)) % 2, -1.0, 1.0)[:, None, None, None]
        mean = parts.mean(0)
        out[kind] = (mean, relative_error(mean + (even * signs).mean(0), mean), len(parts) * options.part)
    if not out:
        sys.exit(f"{options.name}: draw the truths first (--truths), in two parts or more")
    return out


def picture_path(options, kind, spp, seed):
    return options.folder / f"{options.name}_{kind}_{spp}_{seed}.exr"


def measure(options, path):
    """Rows of times, written after each; those of kinds that are not asked for stay."""
    kinds = options.only or list(KINDS)
    rows = [r for r in json.loads(path.read_text()) if r["kind"] not in kinds] if path.exists() else []
    for kind in kinds:
        draw(options, kind, 1, 1, picture_path(options, kind, 1, 0))
        for spp in [n for n in KINDS[kind] if n <= options.most]:
            times = []
            while len(times) < options.runs and (not times or times[0][1] < SLOW):
                seed = len(times) + 1
                times.append(draw(options, kind, spp, seed, picture_path(options, kind, spp, seed)))
            row = {"kind": kind, "spp": spp, "runs": len(times), "times": [statistics.median(t) for t in zip(*times)]}
            row["spread"] = [[min(t), max(t)] for t in zip(*times)]
            rows.append(row)
            path.write_text(json.dumps(rows, indent=1))
            print(kind, spp, [round(t, 3) for t in row["times"]], flush=True)


def add_errors(options, rows, truths):
    for row in rows:
        runs = range(1, row["runs"] + 1)
        pictures = [read_picture(picture_path(options, row["kind"], row["spp"], seed)) for seed in runs]
        row["errors"] = [float(numpy.mean([relative_error(p, m) for p in pictures])) - n for m, n, _ in truths.values()]
        row["means"] = [float(numpy.mean([p.mean() / m.mean() for p in pictures])) for m, _, _ in truths.values()]


def time_to(curve, error):
    """Seconds at which a curve of (seconds, error) has come down to `error`; straight lines in logarithms, None beyond its ends."""
    for (t0, e0), (t1, e1) in zip(curve, curve[1:]):
        if e0 >= error >= e1:
            share = 0.0 if e0 == e1 else math.log(e0 / error) / math.log(e0 / e1)
            return math.exp(math.log(t0) + share * math.log(t1 / t0))
    return None


def curve_of(rows, kind, clock, which):
    return [(r["times"][clock], max(r["errors"][which], 1e-7)) for r in rows if r["kind"] == kind]


def time_cell(rows, kind, clock, which, error):
    curve = curve_of(rows, kind, clock, which)
    seconds = time_to(curve, error)
    if seconds is not None:
        return f"{seconds:.2f}"
    return f"under {curve[0][0]:.2f}" if curve[0][1] < error else f"over {curve[-1][0]:.1f}"


def table(name, rows, truths):
    lines = [f"`{name}`: noise of the truths " + ", ".join(f"{k} {n:.6f} ({s} samples)" for k, (_, n, s) in truths.items())]
    lines += ["", "| | samples | " + " | ".join(f"relMSE to the truth of {NAMES[k]}" for k in truths)]
    lines[-1] += " | mean | render, s | command, s | processors, s |"
    lines += ["|---|---|" + "---|" * (len(truths) + 4)]
    for row in rows:
        errors = " | ".join(f"{e:.5f}" for e in row["errors"])
        times = " | ".join(f"{t:.2f}" for t in row["times"])
        lines.append(f"| {NAMES[row['kind']]} | {row['spp']} | {errors} | {row['means'][-1]:.4f} | {times} |")
    lines += ["", "| seconds of rendering alone (of all processors, whole command) to the error of | relMSE | "]
    lines[-1] += " | ".join(NAMES.values()) + " |"
    lines += ["|---|---|" + "---|" * len(NAMES)]
    for which, program in enumerate(truths):
        for row in [r for r in rows if (r["kind"], r["spp"]) in (("full", 8), ("reference", 64), ("denoised", 16))]:
            error = row["errors"][which]
            cells = [f"{time_cell(rows, k, 0, which, error)} ({time_cell(rows, k, 2, which, error)})" for k in NAMES]
            label = f"{NAMES[row['kind']]}, {row['spp']} samples, to the truth of {NAMES[program]}"
            lines.append(f"| {label} | {error:.5f} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def chart(path, name, rows, truths):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(len(truths), 2, figsize=(11, 4 * len(truths)), sharey="row", squeeze=False)
    for line, program in enumerate(truths):
        for column, clock in enumerate(("render alone", "all processors, whole command")):
            axis = axes[line][column]
            for kind in NAMES:
                curve = curve_of(rows, kind, 2 * column, line)
                axis.loglog(*zip(*curve), marker="o", label=NAMES[kind].replace("`", ""))
            axis.set_xlabel(f"seconds, {clock}")
            axis.set_ylabel(f"relMSE of 99 % to {NAMES[program].replace('`', '')}'s truth")
            axis.grid(True, which="both", alpha=0.25)
    axes[0][0].legend()
    figure.suptitle(name)
    figure.tight_layout()
    figure.savefig(path, dpi=90)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("--prelight", required=True)
    parser.add_argument("--env")
    parser.add_argument("--size", default="256x256")
    parser.add_argument("--truth-spp", type=int, default=4096)
    parser.add_argument("--part", type=int, default=512, help="samples per pixel of a part of a truth")
    parser.add_argument("--truths", action="store_true", help="draw the truths and nothing else")
    parser.add_argument("--times", action="store_true", help="measure and nothing else: on a machine that does nothing besides")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--most", type=int, default=256, help="leave out pictures of more samples per pixel")
    parser.add_argument("--only", nargs="*", choices=list(KINDS))
    options = parser.parse_args()
    options.frame = False
    options.folder.mkdir(parents=True, exist_ok=True)
    options.name = options.scene.stem if options.scene.stem != "scene" else options.scene.parent.name
    source, options.scene = options.scene, options.folder / f"{options.name}.glb"
    if not options.scene.exists():
        prepare(source, options.scene, options)
    if options.truths:
        draw_truths(options)
        return
    stem = options.folder / f"{options.name}_times"
    if options.times:
        measure(options, stem.with_suffix(".json"))
        return
    rows = json.loads(stem.with_suffix(".json").read_text())
    rows.sort(key=lambda row: list(KINDS).index(row["kind"]))
    truths = read_truths(options)
    add_errors(options, rows, truths)
    stem.with_suffix(".md").write_text(table(options.name, rows, truths))
    chart(stem.with_suffix(".png"), options.name, rows, truths)


if __name__ == "__main__":
    main()
