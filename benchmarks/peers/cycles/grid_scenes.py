#!/usr/bin/env python3
"""Writes the scenes of the grid of materials, a .glb a cell, and its sky: grid_scenes.py FOLDER

A cell is a ball of radius 1 or a card of 2 x 2 metres, tilted, under one directional light and a sky that is smooth and
different along every axis; with `even`, under an even sky of radiance 1 and no light. No cell lights another.
Needs numpy, and OpenEXR for the skies.
"""

import pathlib
import struct
import sys
import zlib

import numpy

from gltf_files import add_camera, looking_at, write_glb
from grid_cells import cells

TEXELS = 64
NEAREST, LINEAR, CLAMP, MIRROR, REPEAT = 9728, 9729, 33071, 33648, 10497
SAMPLERS = {
    "repeat": (LINEAR, REPEAT),
    "clamp": (LINEAR, CLAMP),
    "mirror": (LINEAR, MIRROR),
    "nearest": (NEAREST, REPEAT),
}


def png(pixels):
    """8-bit RGBA PNG of values in 0..1."""
    rows = (numpy.clip(pixels, 0, 1) * 255 + 0.5).astype(numpy.uint8)
    raw = b"".join(b"\0" + row.tobytes() for row in rows)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", rows.shape[1], rows.shape[0], 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b"")


def picture(name):
    t = (numpy.arange(TEXELS) + 0.5) / TEXELS
    u, v = numpy.meshgrid(t, t)
    one = numpy.ones_like(u)
    if name == "colors":  # no two quarters alike
        return numpy.stack([0.2 + 0.7 * u, 0.2 + 0.7 * v, numpy.where((u > 0.5) ^ (v > 0.5), 0.8, 0.3), one], -1)
    if name == "few":
        grey = ((numpy.arange(4)[:, None] * 3 + numpy.arange(4)[None] * 5) % 7 + 1) / 8
        return numpy.stack([grey, grey.T, 1 - grey, numpy.ones((4, 4))], -1)
    if name == "dots":
        return numpy.stack([one * 0.8, one * 0.5, one * 0.2, (numpy.hypot(u - 0.5, v - 0.5) < 0.35) * one], -1)
    if name == "fade":  # every channel that an extension may read falls from 1 to 0 along u
        return numpy.stack([1 - u, 1 - u, 1 - u, 1 - u], -1)
    if name == "metals":
        return numpy.stack([one, 0.2 + 0.6 * v, (u > 0.5) * one, one], -1)
    if name == "bumps":
        slope = numpy.stack([0.5 * numpy.sin(4 * numpy.pi * u), 0.3 * numpy.cos(4 * numpy.pi * v) + 0.2, one], -1)
        slope /= numpy.linalg.norm(slope, axis=-1, keepdims=True)
        return numpy.concatenate([slope / 2 + 0.5, one[..., None]], -1)
    raise KeyError(name)


def ball(columns=96, rows=48):
    u, v = numpy.meshgrid(numpy.linspace(0, 1, columns + 1), numpy.linspace(0, 1, rows + 1))
    a, p = 2 * numpy.pi * u.ravel(), numpy.pi * v.ravel()
    normals = numpy.stack([numpy.sin(p) * numpy.sin(a), numpy.cos(p), numpy.sin(p) * numpy.cos(a)], -1)
    tangents = numpy.stack([numpy.cos(a), 0 * a, -numpy.sin(a), 0 * a + 1], -1)
    return normals, normals, numpy.stack([u.ravel(), v.ravel()], -1), tangents, grid_triangles(columns, rows)


def grid_triangles(columns, rows):
    first = (numpy.arange(rows)[:, None] * (columns + 1) + numpy.arange(columns)).ravel()
    below = first + columns + 1
    return numpy.stack([first, below, first + 1, first + 1, below, below + 1], -1).reshape(-1, 3)


def card(size=8):
    t = numpy.linspace(0, 1, size + 1)
    u, v = (m.ravel() for m in numpy.meshgrid(t, t))
    corners = numpy.stack([2 * u - 1, 1 - 2 * v, 0 * u], -1)
    normals = numpy.tile([0.0, 0.0, 1.0], (len(u), 1))
    return corners, normals, numpy.stack([u, v], -1), numpy.tile([1.0, 0, 0, 1], (len(u), 1)), grid_triangles(size, size)


class Builder:
    """A document whose buffer grows."""

    def __init__(self):
        self.binary = b""
        self.names = []
        self.document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "bufferViews": [], "accessors": []}

    def view(self, data):
        self.binary += b"\0" * (-len(self.binary) % 4)
        self.document["bufferViews"].append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)})
        self.binary += data
        return len(self.document["bufferViews"]) - 1

    def accessor(self, values, kind, bounded=False):
        integers = kind == "SCALAR"
        values = numpy.asarray(values, "<u4" if integers else "<f4")
        out = {"bufferView": self.view(values.tobytes()), "componentType": 5125 if integers else 5126}
        out |= {"count": len(values), "type": kind}
        if bounded:
            out |= {"min": values.min(0).tolist(), "max": values.max(0).tolist()}
        self.document["accessors"].append(out)
        return len(self.document["accessors"]) - 1

    def texture(self, name, sampler):
        d = self.document
        d.setdefault("images", []).append({"mimeType": "image/png", "bufferView": self.view(png(picture(name)))})
        filters, wrap = SAMPLERS[sampler]
        d.setdefault("samplers", []).append({"magFilter": filters, "minFilter": filters, "wrapS": wrap, "wrapT": wrap})
        d.setdefault("textures", []).append({"source": len(d["images"]) - 1, "sampler": len(d["samplers"]) - 1})
        return len(d["textures"]) - 1

    def resolve(self, value):
        """Names of textures become indices; extensions are noted."""
        if not isinstance(value, dict):
            return value
        self.names += [k for k in value if k.startswith("KHR_")]
        out = {k: self.resolve(v) for k, v in value.items() if k not in ("texture", "sampler")}
        if "texture" in value:
            out["index"] = self.texture(value["texture"], value.get("sampler", "repeat"))
        return out


def build(what, even=False):
    positions, normals, uv, tangents, triangles = ball() if what["shape"] == "ball" else card()
    if "MIRRORED" in what["attributes"]:
        uv = numpy.stack([numpy.abs(2 * uv[:, 0] - 1), uv[:, 1]], -1)
    turned = numpy.stack([uv[:, 1], 1 - uv[:, 0]], -1)
    b = Builder()
    attributes = {
        "POSITION": b.accessor(positions, "VEC3", True),
        "NORMAL": b.accessor(normals, "VEC3"),
        "TEXCOORD_0": b.accessor(uv, "VEC2"),
        "TEXCOORD_1": b.accessor(turned, "VEC2"),
    }
    if "TANGENT" in what["attributes"]:
        attributes["TANGENT"] = b.accessor(tangents, "VEC4")
    if "COLOR_0" in what["attributes"]:
        shades = numpy.concatenate([0.2 + 0.7 * uv, 0.5 + 0 * uv[:, :1], 1 + 0 * uv[:, :1]], -1)
        attributes["COLOR_0"] = b.accessor(shades, "VEC4")
    primitive = {"attributes": attributes, "indices": b.accessor(triangles.ravel(), "SCALAR"), "material": 0}
    d = b.document
    d["meshes"] = [{"primitives": [primitive]}]
    # Cards are two-sided where light passes; they lean so that no symmetry hides a mistake.
    two_sided = {"doubleSided": True} if what["shape"] == "card" else {}
    d["materials"] = [{"name": what["name"], **b.resolve(what["material"]), **two_sided}]
    lean = [0.17, 0.2, 0.03, 0.964] if what["shape"] == "card" else [0, 0, 0, 1]
    lean = (numpy.array(lean) / numpy.linalg.norm(lean)).tolist()
    d["nodes"] = [{"name": what["name"], "mesh": 0, "rotation": lean}]
    if not even:
        d["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": 2.0}]}}
        shining = looking_at(numpy.array([1.0, 2.0, 3.0]), numpy.zeros(3))
        d["nodes"].append({"matrix": shining.T.ravel().tolist(), "extensions": {"KHR_lights_punctual": {"light": 0}}})
        d["scenes"][0]["nodes"].append(1)
        b.names.append("KHR_lights_punctual")
    if b.names:
        d["extensionsUsed"] = sorted(set(b.names))
    add_camera(d, looking_at(numpy.array([0.0, 0.6, 4.0]), numpy.zeros(3)))
    d["buffers"] = [{"byteLength": len(b.binary) + -len(b.binary) % 4}]
    return d, b.binary


def write_skies(folder):
    import OpenEXR

    from check_units import sky_picture

    sky_picture(folder / "sky.exr")
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    OpenEXR.File(header, {"RGB": numpy.ones((16, 32, 3), "float32")}).write(str(folder / "even_sky.exr"))


def write_grid(folder):
    folder.mkdir(parents=True, exist_ok=True)
    write_skies(folder)
    for what in cells():
        write_glb(folder / f"{what['name']}.glb", *build(what))
        if what["lossless"]:
            write_glb(folder / f"{what['name']}_even.glb", *build(what, even=True))


if __name__ == "__main__":
    write_grid(pathlib.Path(sys.argv[1]))
