#!/usr/bin/env python3
"""Draws the grid of materials with Prelight and Cycles and compares them, a cell a row.

    compare_grid.py FOLDER --prelight build/bin/prelight [--spp 512] [--size 32] [--only NAME ...] [--table FILE]

FOLDER gets the scenes (grid_scenes.py), the pictures, and contact sheets (sheet_*.png: Prelight | Cycles | difference, grey =
none). Pictures that are there already are kept. A row: means of Prelight over those of Cycles for each channel, z of the
luminance's mean (the difference over the noise of both, from two seeds each), relMSE over 99 % of the pixels: the squared
difference over the squared picture of Cycles plus 0.01. --table also writes Cycles' means, for tests.
Needs bpy, OpenEXR, Pillow, numpy.
"""

import argparse
import pathlib
import subprocess
import sys

import numpy
import OpenEXR
from PIL import Image, ImageDraw

from grid_cells import cells
from grid_scenes import write_grid

SEEDS = (1, 2)
ZOOM = 4
ROWS_A_SHEET = 10


def read_picture(path):
    return OpenEXR.File(str(path)).channels()["RGB"].pixels.astype(float)


def render(options, folder, name, sky):
    """Pictures of every seed: {program: [picture]}"""
    out = {"prelight": [], "cycles": []}
    scene = folder / f"{name}.glb"
    script = pathlib.Path(__file__).with_name("render_cycles.py")
    commands = {"prelight": [options.prelight, "reference"], "cycles": [sys.executable, str(script)]}
    for program, start in commands.items():
        for seed in SEEDS:
            path = folder / f"{name}_{program}_{seed}.exr"
            if not path.exists():
                size = f"{options.size}x{options.size}"
                more = ["--env", folder / sky, "--size", size, "--spp", options.spp // len(SEEDS), "--depth", 32, "--seed", seed]
                command = [*start, scene, "-o", path, *more] + (["--quiet"] if program == "prelight" else [])
                done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
                if done.returncode:
                    sys.exit(f"{name}: {program} ended with {done.returncode}\n{done.stderr}")
            out[program].append(read_picture(path))
    return out


def relative_error(ours, truth):
    errors = numpy.sort((((ours - truth) ** 2) / (truth**2 + 0.01)).mean(-1).ravel())
    return errors[: int(0.99 * len(errors))].mean()


def compare(pictures):
    ours, theirs = (numpy.mean(pictures[p], axis=0) for p in ("prelight", "cycles"))
    # Half the difference of two equal halves is a draw of the noise of their mean; pixels are independent.
    noise = [((p[0] - p[1]) / 2).mean(-1) for p in pictures.values()]
    error = numpy.sqrt(sum((n**2).sum() for n in noise)) / noise[0].size
    z = (ours.mean() - theirs.mean()) / max(error, 1e-9)
    return ours, theirs, ours.mean((0, 1)) / theirs.mean((0, 1)), z, relative_error(ours, theirs), error


def display(picture):
    linear = numpy.clip(picture * 0.6, 0, 1)
    return (255 * numpy.where(linear < 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)).astype(numpy.uint8)


def write_sheets(folder, rows):
    for first in range(0, len(rows), ROWS_A_SHEET):
        part = rows[first : first + ROWS_A_SHEET]
        edge = part[0][1].shape[0] * ZOOM
        columns = 2
        lines = (len(part) + columns - 1) // columns
        sheet = Image.new("RGB", (columns * (3 * edge + 10), lines * (edge + 16)))
        draw = ImageDraw.Draw(sheet)
        for i, (name, ours, theirs) in enumerate(part):
            x, y = i % columns * (3 * edge + 10), i // columns * (edge + 16)
            draw.text((x, y), name)
            difference = numpy.clip(128 + 255 * (ours - theirs), 0, 255).astype(numpy.uint8)
            for k, pixels in enumerate((display(ours), display(theirs), difference)):
                tile = Image.fromarray(pixels).resize((edge, edge), Image.NEAREST)
                sheet.paste(tile, (x + k * edge, y + 14))
        sheet.save(folder / f"sheet_{first // ROWS_A_SHEET}.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--prelight", required=True)
    parser.add_argument("--spp", type=int, default=512)
    parser.add_argument("--size", type=int, default=32)
    parser.add_argument("--only", nargs="*", default=[])
    parser.add_argument("--table", type=pathlib.Path)
    options = parser.parse_args()
    write_grid(options.folder)
    rows, table = [], []
    for what in cells():
        if options.only and what["name"] not in options.only:
            continue
        variants = [(what["name"], "sky.exr")] + ([(f"{what['name']}_even", "even_sky.exr")] if what["lossless"] else [])
        for name, sky in variants:
            ours, theirs, ratio, z, error, noise = compare(render(options, options.folder, name, sky))
            rows.append((name, ours, theirs))
            table.append((name, *theirs.mean((0, 1)), noise))
            print(f"{name:24} {ratio[0]:.4f} {ratio[1]:.4f} {ratio[2]:.4f}  z {z:7.1f}  relMSE {error:.5f}", flush=True)
    write_sheets(options.folder, rows)
    if options.table:
        head = f"# cell, mean R G B of Cycles 4.2.0 ({options.spp} samples per pixel, {options.size} x {options.size}), noise of both programs' mean\n"
        options.table.write_text(head + "".join(f"{r[0]} {r[1]:.6f} {r[2]:.6f} {r[3]:.6f} {r[4]:.6f}\n" for r in table))


if __name__ == "__main__":
    main()
