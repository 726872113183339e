"""Balls under an exported sky (EXT_lights_image_based), drawn by Babylon.js, and the sky's numbers compared with integrals."""

import base64
import io
import pathlib
import shutil

import numpy

import glb_file
import three_client

# Axis, right and down of each cube face, in OpenGL's order.
FACES = (((1, 0, 0), (0, 0, -1), (0, -1, 0)), ((-1, 0, 0), (0, 0, 1), (0, -1, 0)), ((0, 1, 0), (1, 0, 0), (0, 0, 1)),
         ((0, -1, 0), (1, 0, 0), (0, 0, -1)), ((0, 0, 1), (1, 0, 0), (0, -1, 0)), ((0, 0, -1), (-1, 0, 0), (0, -1, 0)))


def babylon_bundle():
    """The scripts of Babylon.js from PyPI's pybabylonjs."""
    import importlib.util

    spec = importlib.util.find_spec("pybabylonjs")
    folder = pathlib.Path(spec.submodule_search_locations[0]) / "labextension/static"
    return sorted(folder.glob("605.*.js"))[0], sorted(folder.glob("944.*.js"))[0]


def sphere(rows=64, columns=128):
    v, u = numpy.meshgrid(numpy.linspace(0, numpy.pi, rows + 1), numpy.linspace(0, 2 * numpy.pi, columns + 1), indexing="ij")
    points = numpy.stack([numpy.sin(v) * numpy.sin(u), numpy.cos(v), numpy.sin(v) * numpy.cos(u)], axis=-1).reshape(-1, 3)
    row, column = numpy.meshgrid(numpy.arange(rows), numpy.arange(columns), indexing="ij")
    a = (row * (columns + 1) + column).ravel()
    b = a + columns + 1
    return points.astype("<f4"), numpy.stack([a, b, a + 1, a + 1, b, b + 1], axis=-1).astype("<u4").ravel()


def write_balls(path):
    """A mirror on the left and a matt ball without a layer on the right, both of radius 1 m."""
    points, indices = sphere()
    chunks = points.tobytes() + indices.tobytes()
    views = [{"buffer": 0, "byteOffset": 0, "byteLength": points.nbytes},
             {"buffer": 0, "byteOffset": points.nbytes, "byteLength": indices.nbytes}]
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0, "translation": [-1.5, 0, 0]}, {"mesh": 1, "translation": [1.5, 0, 0]}],
        "materials": [{"pbrMetallicRoughness": {"metallicFactor": 1, "roughnessFactor": 0}},
                      {"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 1},
                       "extensions": {"KHR_materials_specular": {"specularFactor": 0}}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0}, "indices": 1, "material": m}]} for m in (0, 1)],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3",
                       "min": points.min(axis=0).tolist(), "max": points.max(axis=0).tolist()},
                      {"bufferView": 1, "componentType": 5125, "count": len(indices), "type": "SCALAR"}],
        "bufferViews": views, "buffers": [{"byteLength": len(chunks)}], "extensionsUsed": ["KHR_materials_specular"]}
    import struct

    glb_file.write(path, document, struct.pack("<II", len(chunks), 0x004E4942) + chunks)


def sky_directions(sky):
    """Direction and solid angle of the texels of a sky in Prelight's layout."""
    height, width = sky.shape[:2]
    azimuth = 2 * numpy.pi * ((numpy.arange(width) + 0.5) / width - 0.5)
    border = numpy.cos(numpy.pi * numpy.arange(height + 1) / height)
    polar = numpy.arccos((border[1:] + border[:-1]) / 2)[:, None]
    directions = numpy.stack(numpy.broadcast_arrays(numpy.sin(polar) * numpy.sin(azimuth), numpy.cos(polar),
                                                    -numpy.sin(polar) * numpy.cos(azimuth)), axis=-1)
    return directions, numpy.broadcast_to(((border[:-1] - border[1:]) * 2 * numpy.pi / width)[:, None], (height, width))


def read_light(path):
    """The light's JSON, and its levels: radiance [face][row][column][channel], rows from above."""
    from PIL import Image

    document, chunks = glb_file.read(path)
    light = document["extensions"]["EXT_lights_image_based"]["lights"][0]
    levels = []
    for faces in light["specularImages"]:
        level = []
        for image in faces:
            view = document["bufferViews"][document["images"][image]["bufferView"]]
            at = 8 + view.get("byteOffset", 0)
            pixels = numpy.asarray(Image.open(io.BytesIO(chunks[at:at + view["byteLength"]])), float)[::-1] / 255
            level.append(light["intensity"] * pixels[..., :3] ** 2.2 / pixels[..., 3:])
        levels.append(numpy.stack(level))
    return light, levels


def face_directions(size):
    """World directions of texels, [face][row][column]; the cube is looked up with (x, y, -z)."""
    at = (numpy.arange(size) + 0.5) / size * 2 - 1
    found = [numpy.asarray(axis) + at[None, :, None] * numpy.asarray(right) + at[:, None, None] * numpy.asarray(down)
             for axis, right, down in FACES]
    directions = numpy.stack(found) * (1, 1, -1)
    return directions / numpy.linalg.norm(directions, axis=-1, keepdims=True)


def integrals(sky, normals, roughness=None):
    """Irradiance for a normal, or the mean over the lobe of a roughness, summed over the sky's texels."""
    directions, weights = sky_directions(sky)
    cosine = numpy.clip(normals @ directions.reshape(-1, 3).T, 0, None)
    kernel = cosine * weights.ravel()
    if roughness is not None:
        kernel = kernel / ((roughness ** 4 - 1) * (0.5 + 0.5 * cosine) + 1) ** 2
        kernel /= kernel.sum(axis=1, keepdims=True)
    return kernel @ sky.reshape(-1, 3)


def worst_numbers(path, sky):
    """Differences of the file's irradiance and its blurred levels from integrals, as shares of the mean."""
    import raw_file

    light, levels = read_light(path)
    generator = numpy.random.default_rng(1)
    normals = generator.normal(size=(64, 3))
    normals /= numpy.linalg.norm(normals, axis=-1, keepdims=True)
    said = light["intensity"] * raw_file.harmonics(normals * (1, 1, -1)) @ numpy.array(light["irradianceCoefficients"])
    directions, weights = sky_directions(sky)
    projected = numpy.einsum("yxi,yxc,yx->ic", raw_file.harmonics(directions), sky, weights)
    true = raw_file.irradiance(projected, normals)
    found = {"irradiance": numpy.abs(said - true).max() / true.mean()}
    for i, level in enumerate(levels[1:], 1):
        size, roughness = level.shape[1], i / (len(levels) - 1)
        texels = generator.integers(0, 6 * size * size, 48)
        true = integrals(sky, face_directions(size).reshape(-1, 3)[texels], roughness)
        found[f"roughness {roughness:.2f}"] = numpy.abs(level.reshape(-1, 3)[texels] - true).max() / true.mean()
    return found


def draw_balls(browser, folder, name, width, height, across):
    """Radiance of up to 1 [row][column][channel], the messages of the console, and Babylon.js' version."""
    for place, part in enumerate(babylon_bundle(), 1):
        shutil.copy(part, folder / f"babylon_{place}.js")
    picture, messages = three_client.wait_for_picture(browser, folder, "babylon_page.html",
                                                      f"file={name}&width={width}&height={height}&across={across}")
    pixels = numpy.frombuffer(base64.b64decode(picture), numpy.uint8).reshape(height, width, 4)[::-1, :, :3]
    return (pixels / 255.0) ** 2.2, [m for m in messages if "BJS -" not in m and "DevTools" not in m], browser.execute_script("return window.version")


def ball_normals(width, height, across, middle):
    """Pixels of a ball of 1 m without its rim, and their normals."""
    x, y = numpy.meshgrid((numpy.arange(width) + 0.5 - width / 2) * across / width - middle,
                          -(numpy.arange(height) + 0.5 - height / 2) * across / width)
    inside = x * x + y * y < 0.9
    return inside, numpy.stack([x, y, numpy.sqrt(numpy.maximum(1 - x * x - y * y, 0))], axis=-1)[inside]


def look_up(sky, directions):
    height, width = sky.shape[:2]
    u = numpy.arctan2(directions[:, 0], -directions[:, 2]) / (2 * numpy.pi) + 0.5
    v = numpy.arccos(numpy.clip(directions[:, 1], -1, 1)) / numpy.pi
    return sky[numpy.minimum((v * height).astype(int), height - 1), (u * width).astype(int) % width]
