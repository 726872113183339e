"""Blender's lamps in Prelight's units.

In Cycles, a point or spot lamp of P watts sends P / (4 pi) W/sr, and an area lamp sends P / (pi A) W/(m2 sr) from every place of
its area A; a sun's strength is its irradiance, W/m2. Lamps with a size become clusters of points that share their power, because
lamps in Blender cast no shadows themselves, as surfaces would.
"""

import math

import numpy as np

from . import clusters, profiles
from .axes import node_matrix
from .nodes import Input

_LIGHTS, _PROFILES = "KHR_lights_punctual", "EXT_lights_ies"
_SHARP_SUN = math.radians(1.0)  # twice the angle of the real sun


class Lamps:
    """Writes lamps into a file."""

    def __init__(self, gltf, notes):
        self._gltf, self._notes = gltf, notes
        self.shine = False  # whether any lamp shines

    def add(self, name, lamp, matrix_world):
        matrix = np.array(matrix_world, dtype=np.float64)
        power = [_size(lamp, matrix) * p for p in _power(lamp, self._notes)]
        if max(power) <= 0.0:
            return
        self.shine = True
        frame = np.array(matrix_world.normalized(), dtype=np.float64)  # an object's scale changes only area lamps
        {"POINT": self._add_point, "SPOT": self._add_spot, "SUN": self._add_sun, "AREA": self._add_area}[lamp.type](
            name, lamp, power, frame, matrix
        )

    def _add_point(self, name, lamp, power, frame, _):
        frames = _ball(lamp, frame)
        self._add_plain(name, "point", [p / (4.0 * math.pi * len(frames)) for p in power], frames)

    def _add_spot(self, name, lamp, power, frame, _):
        frames = _ball(lamp, frame)
        profile = profiles.spot(lamp.spot_size, lamp.spot_blend)
        self._add_profile(name, profile, [p / (4.0 * math.pi * len(frames)) for p in power], frames)

    def _add_sun(self, name, lamp, power, frame, _):
        frames = [frame]
        if lamp.angle > _SHARP_SUN:
            radius = math.tan(min(0.5 * lamp.angle, math.radians(85.0)))
            frames = [frame @ clusters.aimed(radius * x, radius * y, -1.0) for x, y in clusters.in_disk()]
        self._add_plain(name, "directional", [p / len(frames) for p in power], frames)

    def _add_area(self, name, lamp, power, frame, matrix):
        places = clusters.in_square() if lamp.shape in ("SQUARE", "RECTANGLE") else clusters.in_disk()
        wide, tall = _extent(lamp)
        frames = []
        for x, y in places:
            placed = frame.copy()
            placed[:3, 3] = (matrix @ (0.5 * wide * x, 0.5 * tall * y, 0.0, 1.0))[:3]
            frames.append(placed)
        self._add_profile(name, profiles.area(lamp.spread), [p / (math.pi * len(frames)) for p in power], frames)

    def _add_plain(self, name, kind, intensity, frames):
        most = max(intensity)
        light = {"name": name, "type": kind, "color": [c / most for c in intensity], "intensity": most}
        self._add_nodes(name, _LIGHTS, light, {}, frames)

    def _add_profile(self, name, profile, intensity, frames):
        most = max(intensity)
        light = {"name": name, "bufferView": self._gltf.add_bytes(profile), "mimeType": "application/x-ies-lm-63"}
        self._add_nodes(name, _PROFILES, light, {"multiplier": most, "color": [c / most for c in intensity]}, frames)

    def _add_nodes(self, name, extension, light, dimming, frames):
        self._gltf.use(extension)
        lights = self._gltf.document.setdefault("extensions", {}).setdefault(extension, {"lights": []})["lights"]
        lights.append(light)
        for frame in frames:
            reference = {"light": len(lights) - 1, **dimming}
            self._gltf.add_node({"name": name, "matrix": node_matrix(frame), "extensions": {extension: reference}})


def _extent(lamp):
    return lamp.size, lamp.size_y if lamp.shape in ("RECTANGLE", "ELLIPSE") else lamp.size


def _size(lamp, matrix):
    """The factor for a lamp's power, which since Blender 4.5 need not be that of the whole lamp."""
    if getattr(lamp, "normalize", True):
        return 1.0
    if lamp.type == "SUN":
        return math.pi * math.sin(0.5 * lamp.angle) ** 2 if lamp.angle > 0.0 else 1.0
    if lamp.type == "AREA":
        wide, tall = _extent(lamp)
        rectangle = wide * tall * np.linalg.norm(np.cross(matrix[:3, 0], matrix[:3, 1]))
        return rectangle * (1.0 if lamp.shape in ("SQUARE", "RECTANGLE") else 0.25 * math.pi)
    return 4.0 * (math.pi * lamp.shadow_soft_size**2 if lamp.shadow_soft_size > 0.0 else 1.0)


def _ball(lamp, frame):
    if lamp.shadow_soft_size <= 0.0:
        return [frame]
    return [frame @ clusters.moved(*place) for place in lamp.shadow_soft_size * clusters.in_ball()]


def _power(lamp, notes):
    """Power by channel, in W, for a sun in W/m2."""
    strength = lamp.energy * 2.0 ** getattr(lamp, "exposure", 0.0)
    color = np.array(lamp.color[:], dtype=float)
    if getattr(lamp, "use_temperature", False):
        color *= np.array(lamp.temperature_color[:], dtype=float)
    if lamp.use_nodes and lamp.node_tree is not None:
        emission = next((node for node in lamp.node_tree.nodes if node.type == "EMISSION"), None)
        constants = [Input(emission, name).constant() for name in ("Color", "Strength")] if emission is not None else [None]
        if any(constant is None for constant in constants):
            notes.append(f'nodes of lamp "{lamp.name}" are not read: its own colour and power are used')
        else:
            strength *= constants[1]
            color *= np.array(constants[0][:3])
    return [float(max(0.0, strength * c)) for c in color]
