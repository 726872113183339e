#!/usr/bin/env python3
"""Draws whole models with Prelight and Cycles and compares them, a model a row.

    compare_models.py FOLDER MODEL... --prelight build/bin/prelight --env SKY.exr [--size 160x120] [--spp 512]

FOLDER gets a packed copy of each model (with a framing camera where it has none), the pictures, and a contact sheet a model:
Prelight's reference | full, traced | full, rasterised | Cycles | reference - Cycles (grey = none). Pictures that are there
already are kept. A row: means of the reference, full and rasterised full over those of Cycles for each channel, and their
relMSE over 99 % of the pixels (compare_grid.py), first of the whole picture, then of the pixels that show the model; last the
relMSE there of Cycles' and the reference's own noise, from two seeds each. Needs bpy, OpenEXR, Pillow, numpy.
"""

import argparse
import pathlib
import subprocess
import sys

import numpy
from PIL import Image, ImageDraw

from compare_grid import SEEDS, display, read_picture, relative_error
from gltf_files import add_framing_camera, packed, world_matrices, write_glb

ZOOM = 2
HEAD = 16


def prepare(model, path, options):
    """Packs the model, with one camera, and a scene of that camera alone (a triangle below it has no size to be seen)."""
    document, binary = packed(model)
    width, height = (int(v) for v in options.size.split("x"))
    if options.frame:
        for node in document["nodes"]:
            node.pop("camera", None)
        document.pop("cameras", None)
    if not any("camera" in node for node in document.get("nodes", [])):
        add_framing_camera(document, width / height)
    write_glb(path, document, binary)
    holder, matrix = next((document["nodes"][i], m) for i, m in world_matrices(document).items() if "camera" in document["nodes"][i])
    at = (matrix @ [0, 0, 1, 1])[:3]
    corners = numpy.array([at, at + [1e-3, 0, 0], at + [0, 1e-3, 0]], "<f4")
    empty = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"camera": 0, "matrix": matrix.T.ravel().tolist()}, {"mesh": 0}],
        "cameras": [document["cameras"][holder["camera"]]],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": corners.min(0).tolist(), "max": corners.max(0).tolist()}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36}],
    }  # fmt: skip
    write_glb(path.with_name(f"{path.stem}_sky.glb"), empty, corners.tobytes())


def run(command, path):
    if not path.exists():
        done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
        if done.returncode:
            sys.exit(f"{path.name}: ended with {done.returncode}\n{done.stdout[-2000:]}{done.stderr}")
    return read_picture(path)


def render(options, name):
    """{kind: mean picture}, {kind: a draw of its noise}, and which pixels show the model."""
    scene, base = options.folder / f"{name}.glb", options.folder / name
    sky = ["--env", options.env, "--size", options.size]
    script = pathlib.Path(__file__).with_name("render_cycles.py")
    traced = ["--spp", options.spp // len(SEEDS), "--depth", options.depth]
    starts = {"reference": [options.prelight, "reference"], "cycles": [sys.executable, script]}
    pictures, noise = {}, {}
    for kind, start in starts.items():
        halves = []
        for seed in SEEDS:
            path = base.with_name(f"{name}_{kind}_{seed}.exr")
            halves.append(run([*start, scene, "-o", path, *sky, *traced, "--seed", seed], path))
        pictures[kind] = numpy.mean(halves, axis=0)
        noise[kind] = (halves[0] - halves[1]) / 2
    path = base.with_name(f"{name}_sky.exr")
    alone = run([options.prelight, "reference", path.with_suffix(".glb"), "-o", path, *sky, "--spp", "32"], path)
    model = numpy.abs(pictures["reference"] / numpy.maximum(alone, 1e-6) - 1).max(-1) > 0.05
    full = [options.prelight, "render", scene, "--shading", "full", "--spp", "16", *sky]
    for kind, more in (("full", []), ("rasterised", ["--rasterised"])):
        path = base.with_name(f"{name}_{kind}.exr")
        pictures[kind] = run([*full, "-o", path, *more], path)
    return pictures, noise, model


def write_sheet(path, name, pictures, exposure):
    kinds = ("reference", "full", "rasterised", "cycles")
    tiles = [display(exposure * pictures[k]) for k in kinds]
    difference = exposure * (pictures["reference"] - pictures["cycles"])
    tiles.append(numpy.clip(128 + 255 * difference, 0, 255).astype(numpy.uint8))
    height, width = tiles[0].shape[:2]
    sheet = Image.new("RGB", (len(tiles) * (width * ZOOM + 4), height * ZOOM + HEAD))
    draw = ImageDraw.Draw(sheet)
    for i, (tile, kind) in enumerate(zip(tiles, (*kinds, "reference - cycles"))):
        x = i * (width * ZOOM + 4)
        draw.text((x + 2, 2), f"{name}: {kind}" if i == 0 else kind)
        sheet.paste(Image.fromarray(tile).resize((width * ZOOM, height * ZOOM), Image.NEAREST), (x, HEAD))
    sheet.save(path)


def row(name, pictures, noise, model):
    out = f"| {name}"
    for pixels in (numpy.ones_like(model), model):
        truth = pictures["cycles"][pixels]
        for kind in ("reference", "full", "rasterised"):
            ratio = pictures[kind][pixels].mean(0) / truth.mean(0)
            out += " | " + " ".join(f"{r:.3f}" for r in ratio) + f", {relative_error(pictures[kind][pixels], truth):.4f}"
    ours, theirs = (relative_error(truth + noise[k][model], truth) for k in ("reference", "cycles"))
    return out + f" | {theirs:.4f} {ours:.4f} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("models", nargs="+", type=pathlib.Path)
    parser.add_argument("--prelight", required=True)
    parser.add_argument("--env", required=True)
    parser.add_argument("--size", default="160x120")
    parser.add_argument("--spp", type=int, default=512)
    parser.add_argument("--frame", action="store_true", help="frame the model even if the file has a camera")
    parser.add_argument("--depth", type=int, default=32)
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    print("| model | reference | full | rasterised | reference, model alone | full | rasterised | noise: Cycles, reference |")
    for model in options.models:
        name = model.stem if model.stem != "scene" else model.parent.name
        scene = options.folder / f"{name}.glb"
        if not scene.exists():
            prepare(model, scene, options)
        pictures, noise, shown = render(options, name)
        exposure = 0.9 / max(1e-6, float(numpy.quantile(pictures["cycles"][shown], 0.97)))
        write_sheet(options.folder / f"sheet_{name}.png", name, pictures, exposure)
        print(row(name, pictures, noise, shown), flush=True)


if __name__ == "__main__":
    main()
