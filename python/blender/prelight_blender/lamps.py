"""Lamps of Blender in Prelight's units.

A lamp of P watts sends, in Cycles, P / (4 pi) W/sr if it is a point or a spot, and P / (pi A) W/(m2 sr) from every place of its
area A if it is an area. A sun's strength is its irradiance, W/m2.
"""

import math

import numpy as np

from .axes import node_matrix
from .nodes import Input

_LIGHTS, _PROFILES = "KHR_lights_punctual", "EXT_lights_ies"
_SIDES_OF_A_DISK = 48
_STEPS_OF_A_FADE = 33
_NARROWEST_FADE = math.radians(0.01)  # files tell angles apart from 0.0001 degrees on
_WIDE_SUN = math.radians(2.0)


class Lamps:
    """Writes lamps into a file."""

    def __init__(self, gltf, notes):
        self._gltf, self._notes = gltf, notes

    def add(self, name, lamp, matrix_world):
        color = _color(lamp, self._notes)
        if max(color) <= 0.0:
            return
        if lamp.type == "AREA":
            self._add_area(name, lamp, color, matrix_world)
            return
        if lamp.type == "SPOT":
            self._add_spot(name, lamp, color, matrix_world)
            return
        if lamp.type == "SUN":
            scale, kind = 1.0, {"type": "directional"}
            if lamp.angle > _WIDE_SUN:
                self._notes.append(f'shadows of sun "{name}" are sharp: its angle is not followed')
        else:
            scale, kind = 1.0 / (4.0 * math.pi), {"type": "point"}
        most = max(color)
        light = {"name": name, "color": [c / most for c in color], "intensity": most * scale, **kind}
        self._add_node(name, matrix_world, _LIGHTS, self._place(_LIGHTS, light))

    def _add_spot(self, name, lamp, color, matrix_world):
        most = max(color)
        profile = {"name": name, "bufferView": self._gltf.add_bytes(_profile(lamp)), "mimeType": "application/x-ies-lm-63"}
        dimming = {"multiplier": most / (4.0 * math.pi), "color": [c / most for c in color]}
        self._add_node(name, matrix_world, _PROFILES, self._place(_PROFILES, profile), dimming)

    def _place(self, extension, light):
        self._gltf.use(extension)
        lights = self._gltf.document.setdefault("extensions", {}).setdefault(extension, {"lights": []})["lights"]
        lights.append(light)
        return len(lights) - 1

    def _add_node(self, name, matrix_world, extension, light, more=()):
        matrix = node_matrix(matrix_world.normalized())  # an object's scale changes no lamp but an area
        self._gltf.add_node({"name": name, "matrix": matrix, "extensions": {extension: {"light": light, **dict(more)}}})

    def _add_area(self, name, lamp, color, matrix_world):
        if lamp.spread < math.pi - 1e-3:
            self._notes.append(f'area lamp "{name}" shines to all sides: its spread is not followed')
        outline = _outline(lamp)
        matrix = np.array(matrix_world, dtype=np.float64)
        area = _area(outline @ matrix[:3, :3].T)
        if area <= 0.0:
            self._notes.append(f'area lamp "{name}" has no area: it is dark')
            return
        normal = np.float32([0.0, 0.0, -1.0])
        fan = [(0, k, k + 1) for k in range(1, len(outline) - 1)]
        attributes = {
            "POSITION": self._gltf.add_array(outline.astype(np.float32), bounds=True),
            "NORMAL": self._gltf.add_array(np.tile(normal, (len(outline), 1))),
        }
        most = max(color)
        material = {
            "name": name,
            "pbrMetallicRoughness": {"baseColorFactor": [0.0, 0.0, 0.0, 1.0], "metallicFactor": 0.0, "roughnessFactor": 1.0},
            "emissiveFactor": [c / most for c in color],
            "extensions": {
                "KHR_materials_emissive_strength": {"emissiveStrength": most / (math.pi * area)},
                "KHR_materials_specular": {"specularFactor": 0.0},
            },
        }
        for extension in material["extensions"]:
            self._gltf.use(extension)
        primitive = {
            "attributes": attributes,
            "indices": self._gltf.add_array(np.array(fan, np.uint32).reshape(-1)),
            "material": self._gltf.add("materials", material),
        }
        mesh = self._gltf.add("meshes", {"name": name, "primitives": [primitive]})
        self._gltf.add_node({"name": name, "matrix": node_matrix(matrix), "mesh": mesh})


def _color(lamp, notes):
    """Power by channel."""
    strength = lamp.energy * 2.0 ** getattr(lamp, "exposure", 0.0)
    color = np.array(lamp.color[:], dtype=float)
    if getattr(lamp, "use_temperature", False):
        color *= np.array(lamp.temperature_color[:], dtype=float)
    if lamp.use_nodes and lamp.node_tree is not None:
        emission = next((node for node in lamp.node_tree.nodes if node.type == "EMISSION"), None)
        constants = [Input(emission, name).constant() for name in ("Color", "Strength")] if emission is not None else [None]
        if any(constant is None for constant in constants):
            notes.append(f'nodes of lamp "{lamp.name}" are not read: its own colour and power count')
        else:
            strength *= constants[1]
            color *= np.array(constants[0][:3])
    return [float(max(0.0, strength * c)) for c in color]


def _profile(lamp):
    """The share of a spot's intensity by angle, as a photometric file: within its cone it fades by t^2 (3 - 2 t) of the cosine over a
    share `blend` of it, which the cones of glTF's spots do not."""
    half = min(0.5 * lamp.spot_size, 0.5 * math.pi)
    edge = math.cos(half)
    inner = min(math.acos(edge + lamp.spot_blend * (1.0 - edge)), half - _NARROWEST_FADE)
    faded = np.linspace(inner, half, _STEPS_OF_A_FADE if half - inner > 4.0 * _NARROWEST_FADE else 2)
    t = np.clip((np.cos(faded) - edge) / (math.cos(inner) - edge), 0.0, 1.0)
    shares = t * t * (3.0 - 2.0 * t)
    if inner > _NARROWEST_FADE:
        faded, shares = np.append(0.0, faded), np.append(1.0, shares)
    angles = " ".join(f"{angle:.6f}" for angle in np.degrees(faded))
    values = " ".join(f"{share:.6f}" for share in shares)
    return f"IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 {len(shares)} 1 1 2 0 0 0\n1 1 0\n{angles}\n0\n{values}\n".encode()


def _outline(lamp):
    """Corners of an area, which shines along -Z, in counter-clockwise order seen from there."""
    tall = lamp.size_y if lamp.shape in ("RECTANGLE", "ELLIPSE") else lamp.size
    if lamp.shape in ("SQUARE", "RECTANGLE"):
        corners = np.array([(-1, -1), (-1, 1), (1, 1), (1, -1)], dtype=float)
    else:
        angles = -2.0 * math.pi * np.arange(_SIDES_OF_A_DISK) / _SIDES_OF_A_DISK
        corners = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return np.concatenate([corners * (0.5 * lamp.size, 0.5 * tall), np.zeros((len(corners), 1))], axis=1)


def _area(corners):
    edges = corners - corners[0]
    return 0.5 * float(np.linalg.norm(np.cross(edges[1:-1], edges[2:]).sum(axis=0)))
