"""Scenes, results and pictures for the tests of the add-on."""

import contextlib
import json
import math
import os
import pathlib
import struct
import tempfile
import unittest

import bpy
import numpy as np

import prelight_blender

PROGRAM = os.environ["PRELIGHT_PROGRAM"]
KEEP = os.environ.get("PRELIGHT_KEEP")


class AddonTest(unittest.TestCase):
    """The base of tests that begin with an empty scene and the registered add-on."""

    def setUp(self):
        with quietly():
            bpy.ops.wm.read_factory_settings(use_empty=True)
        prelight_blender.register()
        self.addCleanup(prelight_blender.unregister)
        self.scene = bpy.context.scene
        self.settings = self.scene.prelight
        self.settings.rays = 64
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(KEEP or folder.name)

    def bake(self, **settings):
        for name, value in settings.items():
            setattr(self.settings, name, value)
        return bpy.ops.prelight.bake()

    def problem(self):
        """Returns the message and the fix of a bake that is refused."""
        with self.assertRaises(RuntimeError):
            bpy.ops.prelight.bake()
        state = bpy.context.window_manager.prelight_state
        return state.problem, state.fix

    def notes(self):
        return bpy.context.window_manager.prelight_state.notes


@contextlib.contextmanager
def quietly():
    """Silences the names of files that Blender writes to stdout, past Python."""
    kept = os.dup(1)
    with open(os.devnull, "w") as nothing:
        os.dup2(nothing.fileno(), 1)
    try:
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)


def add(kind, select=True, **options):
    """Adds a primitive such as "plane", which becomes the only selected one or is selected with others."""
    selected = list(bpy.context.selected_objects)
    getattr(bpy.ops.mesh, f"primitive_{kind}_add")(**options)
    item = bpy.context.object
    item.select_set(select)
    for other in selected:
        other.select_set(True)
    return item


def select(*items):
    bpy.ops.object.select_all(action="DESELECT")
    for item in items:
        item.select_set(True)
    bpy.context.view_layer.objects.active = items[0] if items else None


def lamp(kind, location=(0, 0, 3), rotation=(0, 0, 0), scale=(1, 1, 1), **options):
    data = bpy.data.lights.new(kind.title(), kind)
    for name, value in options.items():
        setattr(data, name, value)
    item = bpy.data.objects.new(kind.title(), data)
    item.location, item.rotation_euler, item.scale = location, rotation, scale
    bpy.context.scene.collection.objects.link(item)
    return item


def lambertian(color=(0.5, 0.5, 0.5), one_sided=True):
    """A material that reflects equally in all directions."""
    material = bpy.data.materials.new("Paint")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    shader, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
    shader.inputs["Color"].default_value = (*color, 1.0)
    material.node_tree.links.new(shader.outputs[0], output.inputs[0])
    material.use_backface_culling = one_sided
    return material


def world(color=(0, 0, 0), strength=1.0):
    made = bpy.data.worlds.new("World")
    made.use_nodes = True
    background = made.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (*color, 1.0)
    background.inputs["Strength"].default_value = strength
    bpy.context.scene.world = made
    return made


def colors(item, name):
    """The values [element, rgb] of a colour attribute."""
    attribute = item.data.color_attributes[name]
    values = np.empty(4 * len(attribute.data), np.float32)
    attribute.data.foreach_get("color", values)
    return values.reshape(-1, 4)[:, :3]


def uv(item, name):
    layer = item.data.uv_layers[name]
    values = np.empty(2 * len(layer.data), np.float32)
    layer.data.foreach_get("uv", values)
    return values.reshape(-1, 2)


def picture(image):
    """The pixels [row, column, rgb] of a picture, the upper row first."""
    values = np.empty(image.size[0] * image.size[1] * 4, np.float32)
    image.pixels.foreach_get(values)
    return values.reshape(image.size[1], image.size[0], 4)[::-1, :, :3]


def looked_up(image, at):
    """Bilinear values of a picture at Blender's [place, uv], where v grows upwards."""
    values = picture(image)
    height, width, _ = values.shape
    x = np.clip(at[:, 0] * width - 0.5, 0, width - 1)
    y = np.clip((1 - at[:, 1]) * height - 0.5, 0, height - 1)
    left, upper = x.astype(int), y.astype(int)
    right, lower = np.minimum(left + 1, width - 1), np.minimum(upper + 1, height - 1)
    fx, fy = (x - left)[:, None], (y - upper)[:, None]
    above = (1 - fx) * values[upper, left] + fx * values[upper, right]
    below = (1 - fx) * values[lower, left] + fx * values[lower, right]
    return (1 - fy) * above + fy * below


def drawn_by_cycles(folder, width, height, camera, samples=64, bounces=1):
    """The radiance [row, column, rgb] that Cycles computes."""
    scene = bpy.context.scene
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples, scene.cycles.max_bounces = samples, bounces
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    scene.cycles.sample_clamp_indirect = 0.0
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", 1.0
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    render.filepath = str(folder / "cycles.exr")
    with quietly():
        bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(render.filepath)
    image.colorspace_settings.name = "Non-Color"
    drawn = picture(image)
    bpy.data.images.remove(image)
    return drawn


def camera_above(extent):
    """Looks down on the plane z = 0 from just above it, so that lamps are behind the camera."""
    data = bpy.data.cameras.new("Above")
    data.type, data.ortho_scale, data.clip_start = "ORTHO", extent, 1e-3
    item = bpy.data.objects.new("Above", data)
    item.location = (0, 0, 0.02)
    bpy.context.scene.collection.objects.link(item)
    return item


def pixel_centres(size):
    """The places [place, uv] of the pixels of a square picture from above, row by row."""
    u, v = np.meshgrid((np.arange(size) + 0.5) / size, 1 - (np.arange(size) + 0.5) / size)
    return np.stack([u, v], axis=-1).reshape(-1, 2)


def glb(path):
    """(JSON, bytes) of a .glb file."""
    data = pathlib.Path(path).read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20 : 20 + length]), data[28 + length :]


def accessor(document, data, index):
    """The values [element, component] of a file's accessor."""
    found = document["accessors"][index]
    view = document["bufferViews"][found["bufferView"]]
    kind = {5126: np.float32, 5125: np.uint32}[found["componentType"]]
    width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[found["type"]]
    start = view.get("byteOffset", 0) + found.get("byteOffset", 0)
    return np.frombuffer(data, kind, found["count"] * width, start).reshape(-1, width)


PI = math.pi
