"""Draws an exported scene by Godot 3 with the script that lies beside it, on a display of its own (Xvfb, software GL)."""

import os
import pathlib
import shutil
import subprocess

import numpy

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = """config_version=4

[application]
config/name="client"
run/main_scene="res://main.tscn"

[rendering]
quality/driver/driver_name="GLES3"
"""
SCENE = """[gd_scene load_steps=2 format=2]

[ext_resource path="res://main.gd" type="Script" id=1]

[node name="Main" type="Node"]
script = ExtResource( 1 )
"""
# Messages that Godot 3.2 prints for every project where there is no sound or no locale, and when it ends.
USUAL = ("init_device", "alsa", "ALSA", "audio", "locale", "free_static", "memory.cpp", "translation.cpp", "At: core/")


def run(project, *arguments):
    done = subprocess.run(["xvfb-run", "-a", "-s", "-screen 0 640x480x24", "godot3", "--path", project, *arguments], check=False, timeout=300,
                          capture_output=True, text=True, env={**os.environ, "LIBGL_ALWAYS_SOFTWARE": "1"})
    return [line for line in (done.stdout + done.stderr).splitlines()
            if ("ERROR" in line or "error" in line) and not any(usual in line for usual in USUAL)]


def draw(folder, name, project, width, height):
    """Linear radiance [row][column][channel], and the errors that Godot wrote about the scene."""
    shutil.rmtree(project, ignore_errors=True)
    project.mkdir(parents=True)
    (project / "project.godot").write_text(PROJECT)
    (project / "main.tscn").write_text(SCENE)
    (project / "main.gd").write_text((HERE / "godot_main.gd").read_text().replace("{WIDTH}", str(width)).replace("{HEIGHT}", str(height)))
    shutil.copy(folder / f"{name}.glb", project / "scene.glb")
    shutil.copy(folder / f"{name}.lightmap.exr", project / "light_map.exr")
    shutil.copy(folder / "prelight_light_map_godot3.gd", project)
    complaints = run(project, "--editor", "--quit") + run(project)
    pixels = numpy.fromfile(project / "out.bin", "<f4").reshape(height, width, 4)
    return numpy.ascontiguousarray(pixels[..., :3]), complaints
