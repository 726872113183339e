#!/usr/bin/env python3
"""Bytes per vertex of everything that a bake holds, as floats and as `bake --compress auto` stores it, and the errors of
pictures that are drawn from it.

    error_by_bytes.py measure PRELIGHT SCENE.glb FOLDER > NUMBERS.json
    error_by_bytes.py draw NUMBERS.json [NUMBERS.json ...] CHART.png

`measure` bakes, draws and compares with `prelight --json`; FOLDER keeps its files. Errors are relMSE against
`prelight reference` and the RMS difference of pictures from compressed and plain files over the RMS of the latter.
`draw` needs matplotlib.
"""

import argparse
import json
import pathlib
import struct
import subprocess
import sys

# Each bake holds one order of everything; the last options are drawn once.
BAKES = [
    ["--sh", "2", "--ch", "2", "--haar", "32", "--haar-error", "0.3", "--glossy", "2"],
    ["--sh", "3", "--ch", "3", "--haar", "32", "--haar-error", "0.2", "--glossy", "3"],
    ["--sh", "4", "--ch", "4", "--haar", "32", "--haar-error", "0.1", "--glossy", "4"],
    ["--sh", "6", "--ch", "6", "--haar", "32", "--haar-error", "0.03", "--cones", "--horizons", "8", "--vo"],
]
MEMBERS = {"sh": ["sh", "shCompressed"], "ao": ["ao", "bentNormal"], "cones": ["ao", "bentNormal", "aperture"]}
SETTINGS = {"sh": "--sh", "ch": "--ch", "haar": "--haar-error", "glossy": "--glossy", "horizons": "--horizons"}


def run(*command):
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{result.stderr}")
    return result.stdout


def accessors_in(json_value, names):
    """Indices in members of a baked file's extension that refer to accessors."""
    if isinstance(json_value, list):
        return [i for value in json_value for i in accessors_in(value, names)]
    if not isinstance(json_value, dict):
        return []
    found = []
    for key, value in json_value.items():
        found += [value] if key in names and isinstance(value, int) else accessors_in(value, names)
    return found


ACCESSORS = {"ao", "bentNormal", "aperture", "angles", "feet", "coefficients", "offsets", "indices", "values", "matrices", "bytes",
             "halves", "exponents", "clusters", "weights", "ranges", "means", "basis", "weightRanges", "scales", "gaps",
             "occluders", "vectors"}
SIZES = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
PARTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


def bytes_per_vertex(path, technique):
    """Bytes of a technique's accessors, wherever they stand, over the vertices of the file's entries."""
    data = path.read_bytes()
    document = json.loads(data[20:20 + struct.unpack("<I", data[12:16])[0]])
    members = MEMBERS.get(technique, [technique])
    found, vertices = [], 0
    for node in document["nodes"]:
        for k, entry in enumerate(node.get("extensions", {}).get("PRELIGHT_transfer", {}).get("primitives", [])):
            mesh = document["meshes"][node["mesh"]]["primitives"][k]
            vertices += document["accessors"][mesh["attributes"]["POSITION"]]["count"] if entry else 0
            for holder in (entry, entry.get("quantized", {})):
                found += [i for m in members if m in holder for i in accessors_in({m: holder[m]}, ACCESSORS)]
    root = document["extensions"]["PRELIGHT_transfer"]
    shared = {"sh": "shCompressed", "glossy": "glossyCompressed"}.get(technique)
    found += accessors_in(root.get(shared, {}), ACCESSORS)
    accessors = [document["accessors"][i] for i in found]
    return sum(a["count"] * SIZES[a["componentType"]] * PARTS[a["type"]] for a in accessors) / vertices


def compared(prelight, a, b):
    return json.loads(run(prelight, "compare", a, b, "--json"))["picture"]


def measure(options):
    folder = pathlib.Path(options.folder)
    folder.mkdir(parents=True, exist_ok=True)
    view = ["--size", options.size, "--quiet", *(["--env", options.env] if options.env else [])]
    reference = folder / "reference.exr"
    if not reference.exists():
        run(options.prelight, "reference", options.scene, "-o", reference, "--spp", options.spp, "--depth", "3", *view)
    rows = []
    for number, bake in enumerate(BAKES):
        techniques = [part[2:] for part in bake if part.startswith("--") and part != "--haar-error"]
        files = {}
        for name, more in (("plain", []), ("small", ["--compress", "auto"])):
            files[name] = folder / f"{number}.{name}.glb"
            if not files[name].exists():
                run(options.prelight, "bake", options.scene, "-o", files[name], *bake, *more, "--bounces", "1", "--rays",
                    options.rays, "--quiet")
        for technique in techniques:
            pictures = {}
            for name, file in files.items():
                pictures[name] = folder / f"{number}.{name}.{technique}.exr"
                run(options.prelight, "render", file, "-o", pictures[name], "--shading", technique, *view)
            change = compared(options.prelight, pictures["small"], pictures["plain"])
            setting = SETTINGS.get(technique)
            rows.append({
                "technique": technique,
                "setting": bake[bake.index(setting) + 1] if setting else "",
                "bytes": bytes_per_vertex(files["plain"], technique),
                "smallBytes": bytes_per_vertex(files["small"], technique),
                "relMSE": compared(options.prelight, pictures["plain"], reference)["relMSE"],
                "smallRelMSE": compared(options.prelight, pictures["small"], reference)["relMSE"],
                "change": change["rmse"] / rms(pictures["plain"]),
            })
            print(rows[-1], file=sys.stderr, flush=True)
    print(json.dumps({"scene": pathlib.Path(options.scene).stem, "env": options.env, "results": rows}, indent=1))


def rms(picture):
    import numpy
    import OpenEXR
    channels = OpenEXR.File(str(picture)).channels()
    pixels = (channels["RGB"] if "RGB" in channels else channels["RGBA"]).pixels[..., :3].astype(numpy.float64)
    return float(numpy.sqrt((pixels**2).mean()))


def draw(options):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    reports = [json.loads(pathlib.Path(file).read_text()) for file in options.numbers]
    colours = {"ao": "#5b6770", "cones": "#7a5c43", "horizons": "#c2a83e", "sh": "#2f6db5", "ch": "#1b9aaa", "haar": "#d97b29",
               "glossy": "#b8474d", "vo": "#3c9d6e"}
    figure, axes = plt.subplots(1, len(reports), figsize=(6.2 * len(reports), 5), squeeze=False, layout="constrained")
    for plot, report in zip(axes[0], reports):
        for technique, colour in colours.items():
            rows = [r for r in report["results"] if r["technique"] == technique]
            if not rows:
                continue
            for size, error, style in (("bytes", "relMSE", dict(ls=":", mfc="white")), ("smallBytes", "smallRelMSE", dict(ls="-"))):
                plot.plot([r[size] for r in rows], [r[error] for r in rows], marker="o", ms=5, color=colour, lw=1.3, **style)
            for row in rows:
                plot.annotate(row["setting"], (row["smallBytes"], row["smallRelMSE"]), textcoords="offset points", xytext=(-3, 6),
                              fontsize=7, color=colour, ha="center")
            plot.plot([], [], marker="o", color=colour, label=technique)
        plot.plot([], [], marker="o", ls=":", mfc="white", color="black", label="floats")
        plot.plot([], [], marker="o", color="black", label="--compress auto")
        plot.set(xscale="log", yscale="log", xlabel="bytes per vertex", ylabel="relMSE against the path tracer",
                 title=f"{report['scene']}, {report['env'] or 'its own lamps'}")
        plot.grid(True, which="major", color="#e4e6e9")
    axes[0][-1].legend(frameon=False, fontsize=8)
    figure.savefig(options.chart, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    measuring = commands.add_parser("measure")
    measuring.add_argument("prelight")
    measuring.add_argument("scene")
    measuring.add_argument("folder")
    measuring.add_argument("--env", default="", help="sky; default: the scene's own lamps")
    measuring.add_argument("--size", default="320x240")
    measuring.add_argument("--spp", default="256")
    measuring.add_argument("--rays", default="256")
    measuring.set_defaults(work=measure)
    drawing = commands.add_parser("draw")
    drawing.add_argument("numbers", nargs="+")
    drawing.add_argument("chart")
    drawing.set_defaults(work=draw)
    options = parser.parse_args()
    options.work(options)


if __name__ == "__main__":
    main()
