"""Draws an exported scene by Blender, with the loader that lies beside it.

    python blender_client.py FOLDER NAME WIDTH HEIGHT OUT.exr        (needs PyPI's bpy)
"""

import importlib.util
import os
import pathlib
import sys

import bpy


def load_scene(folder, name):
    spec = importlib.util.spec_from_file_location("load_in_blender", folder / "load_in_blender.py")
    loader = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(loader)
    loader.load(folder, name)


def set_up(width, height):
    scene = bpy.context.scene
    scene.camera = next(o for o in bpy.data.objects if o.type == "CAMERA")
    scene.world = bpy.data.worlds.new("black")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.0
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 32
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 0
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.filter_width = 1.0
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    return scene


def main(folder, name, width, height, output):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    load_scene(pathlib.Path(folder).resolve(), name)
    scene = set_up(int(width), int(height))
    scene.render.filepath = str(pathlib.Path(output).resolve())
    bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
    sys.stdout.flush()
    os._exit(0)  # bpy may crash while Python shuts down.
