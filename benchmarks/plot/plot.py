#!/usr/bin/env python3
"""Draws the charts of a report that `prelight bench --json` wrote, each as FOLDER/NAME.svg.

    plot.py REPORT.json FOLDER

Needs matplotlib 3.6 (Debian's python3-matplotlib). `prelight bench --plot FOLDER` runs it. Prints the files written.
"""

import json
import pathlib
import sys
from collections import defaultdict
from dataclasses import dataclass, field
from typing import Optional

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.patches import Patch

PALETTE = ["#2f6db5", "#d97b29", "#3c9d6e", "#8b5fb0", "#b8474d", "#1b9aaa", "#c2a83e", "#7a5c43", "#c0699f", "#5b6770"]
BLUE, ORANGE, GREEN, GREY = PALETTE[0], PALETTE[1], PALETTE[2], "#a9b0b8"
STRONG, THIN, DASHED = dict(lw=2.0, marker="o", ms=4), dict(lw=1.0, marker="o", ms=2.5), dict(lw=1.5, ls="--", marker="o", ms=3)
plt.rcParams.update({
    "font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "axes.axisbelow": True,
    "grid.color": "#e4e6e9", "svg.hashsalt": "prelight", "legend.frameon": False,
    # Axes fill their figure: what lies beside them is saved with it.
    "figure.subplot.left": 0, "figure.subplot.right": 1, "figure.subplot.bottom": 0, "figure.subplot.top": 1,
    "savefig.bbox": "tight", "savefig.pad_inches": 0.15})


@dataclass
class Row:
    """A number that was measured; `case` is without the name of its part."""
    case: str
    metric: str
    value: float
    peer: Optional[str]
    ratio: Optional[float]

    @property
    def scene(self):
        return self.case.split("/", 1)[0]

    @property
    def setting(self):
        return self.case.partition("/")[2]


@dataclass
class Bar:
    """A row of a bar chart: parts one after the other, and a thinner bar of what it is compared with."""
    label: str
    parts: list = field(default_factory=list)  # (length, colour)
    peer: float = 0.0
    note: str = ""


@dataclass
class Curve:
    name: str
    colour: str
    style: dict
    points: list = field(default_factory=list)  # (x, y)


# Kinds of charts.

def finish(figure, title, subtitle):
    inch = 1.0 / figure.get_figheight()
    figure.text(0, 1 + 0.55 * inch, title, fontweight="bold", fontsize=12)
    figure.text(0, 1 + 0.34 * inch, subtitle, fontsize=8, color="#6b7178")
    return figure


def legend_below(axes, legend):
    """Squares of colour with their names, below the axis' name."""
    if legend:
        handles = [Patch(color=colour, label=name) for name, colour in dict(legend).items()]
        inch = 1.0 / axes.figure.get_figheight()
        axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(0, -0.42 * inch), ncol=4, fontsize=8, borderaxespad=0)


def bar_chart(title, axis, groups, legend=()):
    """`groups`: {name: [Bar]}; `legend`: {name: colour}."""
    count = sum(len(bars) + (1.4 if name else 0.4) for name, bars in groups.items())
    figure, axes = plt.subplots(figsize=(6, 0.3 + 0.21 * count))
    y, ticks, names = 0.0, [], []
    for name, bars in groups.items():
        if name:
            axes.text(0, y, " " + name, fontweight="bold", va="center")
            y += 1.0
        for bar in bars:
            left = 0.0
            for length, colour in bar.parts:
                axes.barh(y, length, 0.62, left, color=colour)
                left += length
            if bar.peer:
                axes.barh(y + 0.4, bar.peer, 0.2, color=GREY)
            axes.annotate(bar.note, (max(left, bar.peer), y), (4, 0), textcoords="offset points", va="center", fontsize=8, color="#6b7178")
            ticks.append(y)
            names.append(bar.label)
            y += 1.0
        y += 0.4
    axes.set_yticks(ticks, names)
    axes.tick_params(axis="y", length=0)
    axes.set_ylim(y - 0.2, -0.8)
    axes.margins(x=0.05 + 0.012 * max((len(bar.note) for bars in groups.values() for bar in bars), default=0))
    axes.set_xlim(left=0)
    axes.set_xlabel(axis)
    axes.grid(axis="x")
    legend_below(axes, legend)
    return figure, title


def curve_chart(title, x, y, curves):
    """Both axes are logarithmic. `curves`: [Curve], or {panel's title: [Curve]}."""
    panels = curves if isinstance(curves, dict) else {"": curves}
    panels = panels or {"": []}
    columns = min(len(panels), 2)
    rows = (len(panels) + columns - 1) // columns
    space = {"wspace": 0.5, "hspace": 0.3}  # names of curves lie between panels
    figure, grid = plt.subplots(rows, columns, figsize=(6 if columns == 1 else 13, 4.2 * rows), squeeze=False, gridspec_kw=space)
    for axes, (name, list_) in zip(grid.flat, panels.items()):
        for curve in list_:
            points = sorted(p for p in curve.points if p[0] > 0 and p[1] > 0)
            if points:
                axes.plot(*zip(*points), color=curve.colour, label=curve.name, **curve.style)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlabel(x)
        axes.set_ylabel(y)
        axes.set_title(name, fontsize=10)
        axes.grid(which="major")
        if axes.lines:
            axes.legend(fontsize=8, loc="center left", bbox_to_anchor=(1.01, 0.5))
        else:
            axes.text(0.5, 0.5, "no results", transform=axes.transAxes, ha="center")
    for axes in grid.flat[len(panels):]:
        axes.set_axis_off()
    return figure, title


def dot_chart(title, axis, groups, legend):
    """`groups`: {name: {label: [(value, colour)]}}, on a logarithmic axis."""
    count = sum(len(rows) + 1.4 for rows in groups.values())
    figure, axes = plt.subplots(figsize=(6, 0.3 + 0.21 * count))
    y, ticks, names = 0.0, [], []
    for name, rows in groups.items():
        axes.text(0.005, y, name, transform=axes.get_yaxis_transform(), fontweight="bold", va="center")
        for label, dots in rows.items():
            y += 1.0
            axes.scatter([v for v, _ in dots], [y] * len(dots), s=22, c=[c for _, c in dots])
            ticks.append(y)
            names.append(label)
        y += 1.4
    axes.set_xscale("log")
    axes.set_yticks(ticks, names)
    axes.set_ylim(y - 0.4, -0.8)
    axes.grid()
    axes.set_xlabel(axis)
    legend_below(axes, legend)
    return figure, title


# Parts that all charts are made of.

class Colours(dict):
    """A colour of the palette for each name, in the order in which names are met."""

    def __missing__(self, name):
        self[name] = PALETTE[len(self) % len(PALETTE)]
        return self[name]


class Curves(dict):
    """Curves by name; a new one takes the colour and style that add() is called with."""

    def add(self, name, colour, style, point):
        self.setdefault(name, Curve(name, colour, style)).points.append(point)

    def list(self):
        return list(self.values())


def number(text):
    """The leading number of a text, "64 rays" or "250k"."""
    word = text.split()[0]
    scale = {"k": 1e3, "M": 1e6}.get(word[-1], 1.0)
    return float(word.rstrip("kM")) * scale


def numeric(text):
    try:
        return number(text) > 0
    except (ValueError, IndexError):
        return False


def pairs_of(rows, x, y):
    """(x, y) of the cases that have both metrics, by case."""
    xs = {row.case: row.value for row in rows if row.metric == x}
    return {row.case: (xs[row.case], row.value) for row in rows if row.metric == y and row.case in xs}


def ratio_note(text, row):
    return text + (f", {row.ratio:.2f} x" if row.ratio else "")


def peer_of(row, more):
    """The peer's value: `more` of it is better, or less."""
    if not row.ratio:
        return 0.0
    return row.value / row.ratio if more else row.value * row.ratio


def metric_bars(title, axis, metric, scale=1.0, note="{:.3g}", colour=lambda setting: BLUE, legend=(), keep=lambda row: True):
    """A chart of one metric: a group for each scene, a bar for each setting."""
    def draw(rows):
        groups = defaultdict(list)
        for row in rows:
            if row.metric == metric and keep(row):
                value = scale * row.value
                groups[row.scene].append(Bar(row.setting.replace("/", ", "), [(value, colour(row.setting))], note=note.format(value)))
        return bar_chart(title, axis, groups, legend)
    return draw


def time_curves(title, metric):
    """A curve for each scene of a relative squared error against time."""
    def draw(rows):
        curves, colours = Curves(), Colours()
        for case, point in pairs_of(rows, "time", metric).items():
            scene, _, label = case.partition("/")
            if not label.startswith("long run"):
                curves.add(scene, colours[scene], STRONG, point)
        return curve_chart(title, "seconds", "relative MSE", curves.list())
    return draw


# Suite by suite.

def cast(rows):
    groups, legend = defaultdict(list), {"the device's tree": BLUE}
    for row in rows:
        note = ratio_note(f"{row.value * 1e-6:.3g}", row)
        groups[row.scene].append(Bar(row.setting.replace("/", ", "), [(row.value * 1e-6, BLUE)], peer_of(row, True) * 1e-6, note))
        if row.peer:
            legend[row.peer] = GREY
    return bar_chart("Rays per second through each tree", "million rays per second", groups, legend)


def beside_embree(title, axis, metric, scale, more, unit, peer):
    def draw(rows):
        groups, legend = defaultdict(list), {"Prelight": BLUE}
        for row in rows:
            if row.metric == metric:
                kind, _, size = row.case.rpartition(" ")
                note = ratio_note(f"{row.value * scale:.3g}{unit}", row)
                groups[size].append(Bar(kind, [(row.value * scale, BLUE)], peer_of(row, more) * scale, note))
                if row.ratio:
                    legend[peer] = GREY
        return bar_chart(title, axis, groups, legend)
    return draw


def trees(rows):
    bars = {}
    for row in rows:
        bar = bars.setdefault(row.case, Bar(row.setting))
        if row.metric == "build":
            bar.note = f"built in {row.value:.3g} s"
        if row.metric in ("nodes", "blocks"):
            bar.parts.append((row.value, BLUE if row.metric == "nodes" else ORANGE))
    groups = defaultdict(list)
    for case, bar in bars.items():
        groups[case.split("/")[0]].append(bar)
    return bar_chart("Steps of a ray through the tree", "steps per ray", groups, {"nodes": BLUE, "blocks of triangles": ORANGE})


def over_size(title, y, metric, scale, more):
    def draw(rows):
        curves, colours = Curves(), Colours()
        for row in rows:
            if row.metric == metric:
                kind, _, size = row.case.rpartition(" ")
                curves.add(kind + ", Prelight", colours[kind], STRONG, (number(size), row.value * scale))
                if row.ratio:
                    curves.add(kind + ", Embree", colours[kind], DASHED, (number(size), peer_of(row, more) * scale))
        return curve_chart(title, "triangles", y, curves.list())
    return draw


def stages(rows):
    bars, colours = {}, Colours()
    for row in rows:
        bar = bars.setdefault(row.case, Bar(row.setting))
        if row.metric == "total":
            bar.note = f"{row.value:.2f} s"
        else:
            bar.parts.append((row.value, colours[row.metric]))
    groups = defaultdict(list)
    for case, bar in bars.items():
        groups[case.split("/")[0]].append(bar)
    return bar_chart("Seconds of a bake, by stage", "seconds", groups, colours)


@dataclass
class ScalingCase:
    """"balls 407k/--ao --sh 3 --bounces 1/64 rays" in parts."""
    scene: str
    technique: str = ""
    rays: str = ""

    @property
    def growing(self):
        return self.scene.startswith("balls ") and bool(self.rays)

    @property
    def transfer(self):
        return "SH" in self.technique or "--sh" in self.technique

    @property
    def triangles(self):
        return number(self.scene.split()[-1])


def scaling_cases(rows):
    """Each row with its case; the technique may have slashes in it."""
    for row in rows:
        first, last = row.case.find("/"), row.case.rfind("/")
        yield row, ScalingCase(row.scene, row.case[first + 1:last], row.case[last + 1:]) if last > first > 0 else ScalingCase(row.scene)


def common_rays(rows):
    """The number of rays at which sizes are compared: 64 per vertex, or what there is."""
    found = [case.rays for _, case in scaling_cases(rows) if case.growing]
    return "64 rays" if "64 rays" in found else (found or [""])[0]


def bake_stages(rows):
    rays, curves, colours = common_rays(rows), Curves(), Colours()
    metrics = ["prepare to write", "prepare", "cast", "fit", "bounce", "write", "rays alone"]
    styles = {"prepare to write": STRONG, "rays alone": DASHED}
    for row, case in scaling_cases(rows):
        if row.metric in metrics and case.growing and case.rays == rays and "--sh" in case.technique:
            curves.add(row.metric, colours[row.metric], styles.get(row.metric, THIN), (case.triangles, row.value))
    return curve_chart("Seconds of a bake's stages as scenes grow, AO, SH 3 and a bounce, " + rays, "triangles", "seconds", curves.list())


def bake_share(rows):
    curves, colours = Curves(), Colours()
    for row, case in scaling_cases(rows):
        if row.metric == "prepare to write" and row.ratio:
            name = f"{case.scene}, {'SH' if case.transfer else 'AO'}"
            curves.add(name, colours[case.scene], STRONG if case.transfer else THIN, (number(case.rays), 1.0 / row.ratio))
    return curve_chart("Seconds of whole bakes over those of their rays alone", "rays per vertex", "prepare to write over rays alone", curves.list())


def bake_memory(rows):
    rays, curves = common_rays(rows), Curves()
    for row, case in scaling_cases(rows):
        if row.metric == "peak memory" and case.growing and case.rays == rays:
            what, colour = ("SH", BLUE) if case.transfer else ("AO", ORANGE)
            curves.add(what + ", measured", colour, STRONG, (case.triangles, 1e-6 * row.value))
            if row.ratio:
                curves.add(what + ", planned", colour, DASHED, (case.triangles, 1e-6 * row.value * row.ratio))
    return curve_chart("Peak memory of bakes as scenes grow, " + rays, "triangles", "MB", curves.list())


def bake_error(rows):
    curves, colours = Curves(), Colours()
    seconds = {row.case: row.value for row in rows if row.metric == "bake"}
    for row, case in scaling_cases(rows):
        if row.metric == "error" and case.transfer and row.case in seconds:
            own = "--sh" in case.technique
            curves.add(f"{case.scene}, {'Prelight' if own else 'Embree'}", colours[case.scene], STRONG if own else DASHED, (seconds[row.case], row.value))
    return curve_chart("Error of SH transfer with a bounce against time", "seconds", "relative RMS error over the surface", curves.list())


def ao_error(rows):
    curves, colours = Curves(), Colours()
    for name, metric, style in (("at vertices", "vertex error", STRONG), ("over the surface", "surface error", THIN), ("reported", "reported error", DASHED)):
        for case, point in pairs_of(rows, "time", metric).items():
            scene, _, label = case.partition("/")
            if not label.startswith("reference"):
                curves.add(f"{scene}, {name}", colours[scene], style, point)
    return curve_chart("Error of ambient occlusion against time", "seconds", "RMS error of AO", sorted(curves.list(), key=lambda c: c.name.split(",")[0]))


def panels_by_choice(title, y):
    """A panel for each scene, of error against time by choice. Cases are "scene/choice/effort"."""
    def draw(rows):
        panels, colours = defaultdict(Curves), Colours(all=BLUE, cache=ORANGE, guided=GREEN)
        for case, point in pairs_of(rows, "time", "error").items():
            scene, _, rest = case.partition("/")
            choice = rest.rpartition("/")[0]
            panels[scene].add(choice, colours[choice], STRONG, point)
        return curve_chart(title, "seconds of all processors", y, {scene: curves.list() for scene, curves in panels.items()})
    return draw


def gather_bias(rows):
    groups, colours = defaultdict(list), {"all": BLUE, "cache": ORANGE, "guided": GREEN}
    doubt = {row.case: row.value for row in rows if row.metric == "standard error of bias"}
    for row in rows:
        if row.metric == "bias":
            choice = row.setting.split("/")[0]
            note = f"{100 * row.value:.2g} %" + (f" ± {100 * doubt[row.case]:.1g}" if row.case in doubt else "")
            groups[row.scene].append(Bar(choice, [(100 * row.value, colours.get(choice, GREY))], note=note))
    return bar_chart("Error that remains with many rays, by how light is gathered", "rms bias over mean light, %", groups, colours)


def wavelets(rows):
    curves, colours = Curves(), Colours()
    for row in rows:
        words = row.case.split("/")
        if words[0] != "select" or row.metric != "error" or len(words) < 4 or not words[3].startswith("transfer"):
            continue
        plain = words[3] == "transfer"
        curves.add(f"{words[1]}, {'as they are' if plain else 'fitted'}", colours[words[1]], THIN if plain else STRONG, (number(words[2]), row.value))
    return curve_chart("Error of lighting by Haar wavelets", "coefficients of the light", "relative RMS error, %", curves.list())


def relight(rows):
    bars = []
    for row in rows:
        if row.metric == "bandwidth per core" and row.ratio:
            gigabytes = row.value * 1e-9
            bars.append(Bar(row.case, [(gigabytes, BLUE)], gigabytes / row.ratio, f"{gigabytes:.3g} GB/s, {row.ratio:.2g} x"))
    return bar_chart("Bytes per second of processor time, against copying", "GB/s per core", {"": bars}, {"kernel": BLUE, "copy": GREY})


def compress(rows):
    """A family of methods has one colour; every scene but the first is dashed."""
    curves, colours, scenes = Curves(), Colours({"half, band8, rgbe": GREY}), []
    for case, point in pairs_of(rows, "bytes per vertex", "vector error").items():
        scene, _, method = case.partition("/")
        if method.endswith(":byte"):
            continue
        if scene not in scenes:
            scenes.append(scene)
        words = method.split(":")
        family = "half, band8, rgbe" if len(words) == 1 else ":".join(words[:2]) if words[0] == "cpca" else words[0]
        curves.add(f"{scene}, {family}", colours[family], STRONG if scene == scenes[0] else DASHED, point)
    return curve_chart("Error of compressed transfer against its size", "bytes per vertex, everything counted", "relative RMS error of vectors", curves.list())


def radiosity(rows):
    curves, colours, scenes = Curves(), Colours(), []
    for row in rows:
        if row.metric == "residual":
            scene, method, sweeps = row.case.split("/")
            if scene not in scenes:
                scenes.append(scene)
            curves.add(f"{scene}, {method}", colours[method], STRONG if scene == scenes[0] else DASHED, (number(sweeps), row.value))
    return curve_chart("Residual of the radiosity equation", "row operations over rows", "residual over the direct light", curves.list())


def photons(rows):
    curves, colours = Curves(), Colours()
    for row in rows:
        if row.metric == "relative MSE":
            curves.add(row.scene, colours[row.scene], STRONG, (number(row.setting), row.value))
    return curve_chart("Error of irradiance from photons against their number", "photons", "relative MSE", curves.list())


def light_maps(rows):
    """Cases are "scene/by error/0.02"; texels of one size are dashed."""
    curves, colours = Curves(), Colours()
    for case, point in pairs_of(rows, "texels", "error").items():
        scene, kind, _ = case.split("/")
        curves.add(f"{scene}, {kind}", colours[scene], STRONG if kind == "by error" else DASHED, point)
    return curve_chart("Error of light maps against their texels", "texels", "error over mean light", curves.list())


def update(rows):
    names = ["scene", "photons", "density", "gather", "caustics"]
    legend = dict(zip(names, PALETTE))
    groups, bars = defaultdict(list), {}
    for row in rows:
        if row.metric == "frame":
            peer = 1e3 * peer_of(row, False)
            bars[row.case] = Bar(row.setting, [], peer, f"{1e3 * row.value:.3g} ms")
            groups[row.scene].append(bars[row.case])
            legend.setdefault(f"{row.peer}, with drawing", GREY)
    for row in rows:
        if row.metric in names and row.case in bars:
            bars[row.case].parts.append((1e3 * row.value, legend[row.metric]))
    return bar_chart("A frame in which light follows what moves, without drawing", "milliseconds", groups, legend)


def following(rows):
    curves, colours = Curves(), Colours()
    for row in rows:
        if row.metric.endswith("of that of the first light") and "frame" in row.metric and "greatest" not in row.metric:
            moving = row.metric.startswith("frame ")
            frames = number(row.metric.removeprefix("frame ").replace(":", " "))
            curves.add(row.case + (", moving" if moving else ", at rest"), colours[row.case], STRONG if moving else DASHED, (frames, row.value))
    return curve_chart("Error of indirect light that follows a node", "frames since it began to move, or stopped",
                       "error, of that of light that does not follow", curves.list())


def skip(rows):
    times = {row.case: row.value for row in rows if row.metric == "processor time"}
    bars = []
    for row in rows:
        if row.metric == "cost":
            absent = times.get(row.scene + "/absent", 0.0)
            needed = f"; needed {times.get(row.scene + '/needed', 0.0) / absent:.2f}" if absent > 0 else ""
            bars.append(Bar(row.scene, [(row.value, BLUE)], 1.0, f"{row.value:.2f}{needed}"))
    return bar_chart("Cost of features that are present but not needed", "processor time over that without the feature", {"": bars},
                     {"present, not needed": BLUE, "absent": GREY})


def growth(title, x, parameters):
    """The worst relative error of each subject of `stability` by what errors grow with."""
    def draw(rows):
        worst = defaultdict(dict)
        for row in rows:
            last = row.case.rpartition("/")[2]
            for parameter in parameters:
                if row.metric == "relative error" and last.startswith(parameter + " ") and numeric(last[len(parameter):]):
                    at = number(last[len(parameter):])
                    worst[row.scene][at] = max(worst[row.scene].get(at, 0.0), row.value)
        curves = []
        for subject, values in worst.items():
            points = [(at, value) for at, value in values.items() if value > 1e-9]  # less is double precision's
            if len(points) > 1:
                style = STRONG if len(curves) < len(PALETTE) else DASHED
                curves.append(Curve(subject, PALETTE[len(curves) % len(PALETTE)], style, points))
        return curve_chart(title, x, "relative error", curves)
    return draw


def techniques(rows):
    claims = {row.case: row.value for row in rows if row.metric == "claim"}
    groups = defaultdict(list)
    for row in rows:
        if row.metric == "RMSE":
            direct = claims.get(row.case, 16) <= 2  # segments of a path
            groups[row.scene].append(Bar(row.setting, [(row.value, GREY if direct else BLUE)], note=f"{row.value:.4f}"))
    return bar_chart("Difference of pictures from path-traced ones", "RMSE, W/(m2 sr)", groups,
                     {"direct light is claimed": GREY, "light that surfaces send on, too": BLUE})


def techniques_lights(rows):
    curves, colours = Curves(), Colours()
    for row in rows:
        if row.scene == "lights" and row.metric == "frames":
            name, _, lights = row.setting.rpartition(", ")
            curves.add(name, colours[name], STRONG, (number(lights), row.value))
    return curve_chart("Frames per second as lights are added", "point lights, all moving", "frames per second", curves.list())


def viewer_dots(title, axis, wanted):
    """`wanted`: {metric: what follows the size in the name of its group}, each with a movement."""
    def draw(rows):
        groups, colours = defaultdict(lambda: defaultdict(list)), Colours()
        for metric, (movement, what) in wanted.items():
            for row in rows:
                words = row.case.split("/")
                if row.metric == metric and len(words) == 4 and words[3] == movement and row.value > 0:
                    name = words[2].replace("x", " x ") + " pixels" + what
                    groups[name][words[1]].append((row.value, colours[words[0]]))
        return dot_chart(title, axis, groups, colours)
    return draw


def viewer_parts(rows):
    """Of the first size alone: parts of the others may not all have been measured."""
    groups, bars, colours, size = defaultdict(list), {}, Colours(), None
    for row in rows:
        words = row.case.split("/")
        if len(words) != 4:
            continue
        size = size or words[2]
        if not row.metric.startswith("part: ") or words[2:] != [size, "moving light"]:
            continue
        if row.case not in bars:
            bars[row.case] = Bar(words[1])
            groups[words[0]].append(bars[row.case])
        bars[row.case].parts.append((row.value, colours[row.metric[6:]]))
    for bar in bars.values():
        bar.note = f"{sum(length for length, _ in bar.parts):.3g} ms"
    pixels = f", {size.replace('x', ' x ')} pixels" if size else ""
    return bar_chart("Cost of a frame while a light is dragged", "ms of processor time, all threads" + pixels, groups, colours)


def shadows(rows):
    return metric_bars("Error of shadows of vector occluders", "RMS error of direct light, of that without shadows; 16 lights around the scene",
                       "error, lights around", note="{:.2f}", colour=lambda setting: BLUE if "/" in setting else GREY,
                       legend={"vector occluders": BLUE, "others": GREY}, keep=lambda row: row.setting != "no shadow")(rows)


COUNTS = ["rays", "photons", "lights", "elements", "components", "samples", "segments of a path", "passes", "rays per receiver"]
SIZES = ["texels per side", "rows of the sky", "1 / alpha", "distance over size"]

# By part: names of files and what draws them.
CHARTS = {
    "cast": {"cast": cast},
    "rays": {"rays": beside_embree("Rays per second through detailed rooms", "million rays per second", "throughput", 1e-6, True, "", "Embree, ray by ray")},
    "trees": {"trees": trees},
    "build": {"build": beside_embree("Seconds to build the tree over detailed rooms", "seconds", "build", 1.0, False, " s", "Embree at about the same effort")},
    "scaling": {"scaling": over_size("Rays per second as scenes grow", "million rays per second", "best throughput", 1e-6, True),
                "scaling-build": over_size("Seconds to build the tree as scenes grow", "seconds", "build", 1.0, False)},
    "stages": {"stages": stages},
    "bake-scaling": {"bake-scaling": bake_stages, "bake-scaling-share": bake_share, "bake-scaling-memory": bake_memory, "bake-scaling-error": bake_error},
    "error": {"error": ao_error},
    "reference": {"reference": time_curves("Error of the reference renderer against time", "relMSE")},
    "full": {"full": time_curves("Error of pictures with all light against time", "relMSE of 99 %")},
    "objects": {"objects": metric_bars("Error where objects shade a scene, against path-traced pictures", "rms error, of the rms", "error")},
    "materials": {"materials": panels_by_choice("Error against time", "rms error")},
    "vo": {"vo": shadows},
    "near-lamps": {"near-lamps": metric_bars("Error of lamps' light with shadows by shells, over that without shadows",
                                             "rms error against shadow rays, over that without shells", "with over without", note="{:.2f}")},
    "screen": {"screen": metric_bars("Error of occlusion found in pictures, against traced accessibility", "rms error", "rms error")},
    "rasterised": {"rasterised": metric_bars("Error of SH of visibility that OpenGL draws, and of as many rays", "relative RMS error, %", "error of transfer", 100.0)},
    "photons": {"photons": photons},
    "gather": {"gather": panels_by_choice("Error of indirect light against time", "rms error over mean light"), "gather-bias": gather_bias},
    "lightmaps": {"lightmaps": light_maps},
    "radiosity": {"radiosity": radiosity},
    "update": {"update": update},
    "following": {"following": following},
    "live-light": {"live-light": metric_bars("Error of indirect light that follows what moves, in pictures", "rms error, of the mean, %", "picture error", 100.0)},
    "compress": {"compress": compress},
    "encodings": {"encodings": metric_bars("Error of encodings of incident light",
                                           "RMS error of irradiance over normals up to 45 degrees from the surface's, of its RMS, %", "error", 100.0, "{:.1f} %",
                                           lambda setting: GREY if setting.startswith("sh-") else BLUE, {"spherical harmonics": GREY, "others": BLUE})},
    "animation": {"animation": metric_bars("Error of transfer between an animation's keys", "relative RMS error, %", "rms error", 100.0, "{:.3g} %")},
    "basis": {"basis": metric_bars("Time of evaluating spherical and cpherical harmonics", "ns per direction", "time", 1e9, "{:.2f}",
                                   lambda setting: GREY if setting.startswith("SH") else BLUE, {"spherical": GREY, "cpherical": BLUE})},
    "wavelets": {"wavelets": wavelets},
    "relight": {"relight": relight},
    "stability": {"stability": growth("Worst relative error by order", "order", ["order"]),
                  "stability-count": growth("Worst relative error by count", "what is added up", COUNTS),
                  "stability-size": growth("Worst relative error by size", "texels, rows, 1 / alpha, distance", SIZES)},
    "skip": {"skip": skip},
    "techniques": {"techniques": techniques, "techniques-lights": techniques_lights},
    "viewer": {"viewer": viewer_dots("A frame of the window while the camera orbits", "ms by the clock, the median of all", {"median frame": ("orbit", "")}),
               "viewer-parts": viewer_parts,
               "viewer-latency": viewer_dots("From a dragged light to the picture", "ms by the clock, the median of a few",
                                             {f"latency to the {which} picture": ("moving light", f": to the {which} picture") for which in ("next", "finished")})},
}


def rows_by_part(report):
    """Cases of a suite of several parts begin with the part's name."""
    parts = defaultdict(list)
    for result in report["results"]:
        part, case = result["suite"], result["case"]
        if part not in CHARTS:
            part, _, case = case.partition("/")
        parts[part].append(Row(case, result["metric"], result["value"], result["peer"], result["ratio"]))
    return parts


def where(report):
    return ("Quick run, not to be kept. " if report["options"].get("quick") else "") + f"{report['device']}, {report['driver'].split(',')[0]}"


def contact_sheets(folder, subtitle):
    """A sheet for each scene of techniques.json: the path-traced picture and every technique's, with errors and costs."""
    index = folder / "techniques.json"
    for sheet in json.loads(index.read_text(encoding="utf-8")) if index.exists() else []:
        cells = sheet["cells"]
        rows = (len(cells) + 3) // 4
        columns = (len(cells) + rows - 1) // rows
        figure, grid = plt.subplots(rows, columns, figsize=(3.4 * columns, 2.5 * rows), squeeze=False, gridspec_kw={"wspace": 0.05, "hspace": 0.3})
        for axes in grid.flat:
            axes.set_axis_off()
        for axes, cell in zip(grid.flat, cells):
            axes.imshow(plt.imread(folder / cell["picture"]), interpolation="nearest")
            axes.text(0, -0.03, cell["errors"] + "\n" + cell["costs"], transform=axes.transAxes, fontsize=8, color="#6b7178", va="top")
            axes.text(0, 1.02, cell["name"], transform=axes.transAxes, fontweight="bold")
        yield sheet["file"], finish(figure, sheet["title"], subtitle)


def main(report_file, folder):
    report = json.loads(pathlib.Path(report_file).read_text(encoding="utf-8"))
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    subtitle = where(report)

    def save(figure, name):
        kind = {"metadata": {"Date": None}} if name.endswith(".svg") else {"dpi": 110}
        figure.savefig(folder / name, **kind)
        plt.close(figure)
        print(folder / name)

    parts = rows_by_part(report)
    for part, charts in CHARTS.items():
        for name, draw in charts.items():
            if parts.get(part):
                figure, title = draw(parts[part])
                save(finish(figure, title, subtitle), name + ".svg")
    if parts.get("techniques"):
        for name, figure in contact_sheets(folder, subtitle):
            save(figure, name)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
