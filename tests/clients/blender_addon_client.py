"""Imports a scene into Blender, bakes a light map there with the add-on and draws what its materials then show.

    python blender_addon_client.py SCENE.glb WIDTH HEIGHT RAYS OUT.exr        (needs PyPI's bpy, and prelight)
"""

import os
import pathlib
import sys

import bpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python/blender"))
import prelight_blender
from blender_client import set_up


def bake(scene, rays):
    """Converts the light to Blender's units: a lamp of I W/sr has 4 pi I watts."""
    bpy.ops.import_scene.gltf(filepath=scene, export_import_convert_lighting_mode="COMPAT")
    for item in bpy.data.objects:
        item.select_set(item.type == "MESH")
    settings = bpy.context.scene.prelight
    settings.what, settings.rays = "LIGHT_MAP", rays
    bpy.ops.prelight.bake()
    for note in bpy.context.window_manager.prelight_state.notes.splitlines():
        print(f"WARN {note}", file=sys.stderr)


def main(scene, width, height, rays, output):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    prelight_blender.register()
    bake(scene, int(rays))
    drawn = set_up(int(width), int(height))
    drawn.render.filepath = str(pathlib.Path(output).resolve())
    bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
    sys.stdout.flush()
    os._exit(0)  # bpy may crash while Python shuts down.
