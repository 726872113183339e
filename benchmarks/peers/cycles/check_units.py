#!/usr/bin/env python3
"""Checks that Cycles and Prelight mean the same by lights, skies, cameras and units, against closed forms.

    check_units.py --prelight build/bin/prelight [--folder DIR]

A white Lambertian plane under a point light, a directional light, an even sky, and (seen directly) a sky whose texels differ.
Prints the largest error over the pixels of either program; exits with 1 when one is above 0.5 %.
"""

import argparse
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy
import OpenEXR

from gltf_files import add_camera, looking_at, write_glb

ALBEDO = 0.8
SIZE = 16
YFOV = math.radians(40.0)
HEIGHT = 3.0  # of the camera over the plane, metres
TOLERANCE = 0.005


def read_picture(path):
    return OpenEXR.File(str(path)).channels()["RGB"].pixels.astype(float)


def plane_scene(light=None, upwards=False):
    """A plane of 8 x 8 metres at y = 0, its camera above it (or looking at the sky alone, towards -Z)."""
    corners = numpy.array([[-4, 0, 4], [4, 0, 4], [4, 0, -4], [-4, 0, -4]], "<f4")
    normals = numpy.array([[0, 1, 0]] * 4, "<f4")
    indices = numpy.array([0, 1, 2, 0, 2, 3], "<u4")
    binary = corners.tobytes() + normals.tobytes() + indices.tobytes()
    document = {
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_materials_specular", "KHR_lights_punctual"],
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": "plane"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2, "material": 0}]}],
        "materials": [
            {
                "doubleSided": True,
                "pbrMetallicRoughness": {"baseColorFactor": [ALBEDO] * 3 + [1], "metallicFactor": 0, "roughnessFactor": 1},
                "extensions": {"KHR_materials_specular": {"specularFactor": 0}},
            }
        ],
        "buffers": [{"byteLength": len(binary)}],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": 48},
            {"buffer": 0, "byteOffset": 48, "byteLength": 48},
            {"buffer": 0, "byteOffset": 96, "byteLength": 24},
        ],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-4, 0, -4], "max": [4, 0, 4]},
            {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"bufferView": 2, "componentType": 5125, "count": 6, "type": "SCALAR"},
        ],
    }
    if light is not None:
        kind, matrix = light
        document["extensions"] = {"KHR_lights_punctual": {"lights": [kind]}}
        document["nodes"].append({"matrix": matrix.T.ravel().tolist(), "extensions": {"KHR_lights_punctual": {"light": 0}}})
        document["scenes"][0]["nodes"].append(1)
    eye = numpy.array([0.0, 1.0, 0.0]) if upwards else numpy.array([0.0, HEIGHT, 1e-4])
    target = numpy.array([0.0, 1.5, -1.0]) if upwards else numpy.zeros(3)
    camera = looking_at(eye, target)
    add_camera(document, camera, YFOV)
    return document, binary, camera


def rays(camera, samples=16):
    """Directions through the pixels: [row][column][samples²][3], samples at the centres of a grid."""
    t = (numpy.arange(SIZE * samples) + 0.5) / (SIZE * samples) * 2 - 1
    x, y = numpy.meshgrid(t, -t)
    local = numpy.stack([x, y, -numpy.full_like(x, 1 / math.tan(YFOV / 2))], -1)
    world = local @ camera[:3, :3].T
    world /= numpy.linalg.norm(world, axis=-1, keepdims=True)
    return world.reshape(SIZE, samples, SIZE, samples, 3).transpose(0, 2, 1, 3, 4).reshape(SIZE, SIZE, -1, 3)


def under_point(camera, position, intensity):
    directions = rays(camera)
    eye = camera[:3, 3]
    points = eye + directions * (-eye[1] / directions[..., 1:2])
    towards = position - points
    squared = (towards**2).sum(-1)
    return (ALBEDO / math.pi * intensity * towards[..., 1] / squared**1.5).mean(-1)[..., None] * numpy.ones(3)


def sky_picture(path):
    """Smooth in all directions and different along every axis, so that a wrong turn or mirror shows."""
    height, width = 256, 512
    polar = numpy.pi * (numpy.arange(height) + 0.5) / height
    azimuth = 2 * numpy.pi * ((numpy.arange(width) + 0.5) / width - 0.5)
    x = numpy.sin(polar)[:, None] * numpy.sin(azimuth)
    y = numpy.cos(polar)[:, None] * numpy.ones(width)
    z = -numpy.sin(polar)[:, None] * numpy.cos(azimuth)
    pixels = numpy.stack([1 + 0.5 * x, 1 + 0.5 * y, 1 + 0.5 * z], -1).astype("float32")
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    OpenEXR.File(header, {"RGB": pixels}).write(str(path))


def cases(folder):
    """(name, document, binary, options of both programs, picture in closed form)"""
    point = numpy.eye(4)
    point[:3, 3] = [0.5, 2.0, 0.3]
    document, binary, camera = plane_scene(({"type": "point", "intensity": 10.0}, point))
    yield "point", document, binary, [], under_point(camera, point[:3, 3], 10.0)
    slope = looking_at(numpy.array([1.0, 2.0, 0.5]), numpy.zeros(3))  # a light shines along its -Z
    document, binary, _ = plane_scene(({"type": "directional", "intensity": 3.0}, slope))
    yield "directional", document, binary, [], numpy.full((SIZE, SIZE, 3), ALBEDO / math.pi * 3.0 * slope[1, 2])
    even, shaded = folder / "even.exr", folder / "shaded.exr"
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    OpenEXR.File(header, {"RGB": numpy.ones((16, 32, 3), "float32")}).write(str(even))
    sky_picture(shaded)
    document, binary, _ = plane_scene()
    yield "even sky", document, binary, ["--env", str(even)], numpy.full((SIZE, SIZE, 3), ALBEDO)
    # Irradiance of 1 + a.w over the upper hemisphere: pi + a_y 2 pi / 3.
    lit = ALBEDO * numpy.array([1.0, 1.0 + 0.5 * 2 / 3, 1.0])
    yield "shaded sky", document, binary, ["--env", str(shaded)], lit * numpy.ones((SIZE, SIZE, 1))
    document, binary, camera = plane_scene(upwards=True)
    yield "sky itself", document, binary, ["--env", str(shaded)], (1 + 0.5 * rays(camera)).mean(2)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--prelight", required=True)
    parser.add_argument("--folder", help="where scenes and pictures stay; a temporary one without")
    parser.add_argument("--spp", type=int, default=1024)
    options = parser.parse_args()
    folder = pathlib.Path(options.folder or tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    script = pathlib.Path(__file__).with_name("render_cycles.py")
    failed = False
    for name, document, binary, both, expected in cases(folder):
        stem = folder / name.replace(" ", "_")
        scene = f"{stem}.glb"
        write_glb(scene, document, binary)
        common = ["--size", f"{SIZE}x{SIZE}", "--spp", str(options.spp), *both]
        cycles, ours = f"{stem}_cycles.exr", f"{stem}_prelight.exr"
        subprocess.run([sys.executable, str(script), scene, "-o", cycles, *common], check=True, stdout=subprocess.DEVNULL)
        subprocess.run([options.prelight, "reference", scene, "-o", ours, "--quiet", *common], check=True)
        for program, path in (("Cycles", cycles), ("Prelight", ours)):
            ratio = read_picture(path) / expected
            off = abs(ratio.mean((0, 1)) - 1).max()
            failed |= off > TOLERANCE
            print(f"{name:12} {program:9} mean/closed form {ratio.mean((0, 1)).round(5)}  pixels {ratio.min():.4f} to {ratio.max():.4f}")
    sys.exit(int(bool(failed)))


if __name__ == "__main__":
    main()
