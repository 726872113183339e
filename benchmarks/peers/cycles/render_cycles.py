#!/usr/bin/env python3
"""Renders a glTF scene with Blender Cycles the way `prelight reference` draws it: an independent picture to compare with.

    render_cycles.py SCENE.glb -o OUT.exr --size WxH [--camera I] [--env MAP.exr] [--sky R,G,B] [--spp 512] [--depth 32]
                     [--denoise]

The same camera, sky, radiometric units and pixel filter; linear pictures; nothing clamped, caustics on. A picture holds
radiance in W/(m2 sr), R,G,B. Materials are what Blender's glTF importer makes of them (README.md says where that differs).
Needs bpy 4.2 and numpy (PyPI, Python 3.11).
"""

import argparse
import math
import os
import pathlib
import sys
import time

import bpy

from gltf_files import read_gltf


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("--size", default="128x128", help="width x height in pixels")
    parser.add_argument("--camera", type=int, default=0, help="index of the node with a camera, in the order of nodes")
    parser.add_argument("--env", help="equirectangular .hdr or .exr")
    parser.add_argument("--sky", default="0,0,0", help="radiance of an even sky, where no --env is given")
    parser.add_argument("--spp", type=int, default=512)
    parser.add_argument("--depth", type=int, default=32, help="bounces of every kind")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--denoise", action="store_true", help="OpenImageDenoise with albedo and normals, as Blender sets it up")
    parser.add_argument("--threads", type=int, default=0, help="0: as many as there are cores")
    return parser.parse_args()


def import_scene(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    # COMPAT reads candela as W/sr and lux as W/m2, without 683 lumens a watt, as Prelight does.
    bpy.ops.import_scene.gltf(filepath=str(pathlib.Path(path).resolve()), export_import_convert_lighting_mode="COMPAT")
    for light in bpy.data.lights:
        if light.type in {"POINT", "SPOT"}:
            light.shadow_soft_size = 0.0
        elif light.type == "SUN":
            light.angle = 0.0
        light.cycles.max_bounces = 1024
        light.cycles.use_multiple_importance_sampling = True


def emit_from_fronts():
    """Emission of one-sided materials leaves the front alone, as Prelight has it; the importer's leaves both sides."""
    for material in bpy.data.materials:
        if not material.use_backface_culling or material.node_tree is None:
            continue
        nodes, links = material.node_tree.nodes, material.node_tree.links
        for shader in [n for n in nodes if n.type == "BSDF_PRINCIPLED"]:
            color, strength = shader.inputs["Emission Color"], shader.inputs["Emission Strength"]
            dark = not color.is_linked and max(color.default_value[:3]) == 0.0
            if dark or strength.is_linked or strength.default_value == 0.0:
                continue
            front, scaled = nodes.new("ShaderNodeMath"), nodes.new("ShaderNodeMath")
            front.operation, scaled.operation = "SUBTRACT", "MULTIPLY"
            front.inputs[0].default_value = 1.0
            links.new(nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"], front.inputs[1])
            scaled.inputs[0].default_value = strength.default_value
            links.new(front.outputs[0], scaled.inputs[1])
            links.new(scaled.outputs[0], strength)


def choose_camera(path, index, scene):
    """Takes the camera's numbers from the file: the importer rounds its angle through a lens of a sensor."""
    document, _ = read_gltf(path)
    holders = [node for node in document.get("nodes", []) if "camera" in node]
    if index >= len(holders):
        sys.exit(f"{path}: --camera {index}, but the scene has {len(holders)} cameras; add_camera.py writes one")
    lens = document["cameras"][holders[index]["camera"]]
    objects = [o for o in bpy.data.objects if o.type == "CAMERA"]
    named = [o for o in objects if o.name == holders[index].get("name")]
    scene.camera = (named or objects)[0]
    camera = scene.camera.data
    camera.shift_x = camera.shift_y = 0.0
    camera.sensor_fit = "VERTICAL"
    if lens["type"] == "perspective":
        camera.angle_y = lens["perspective"]["yfov"]
        camera.clip_start = lens["perspective"]["znear"]
    else:
        camera.ortho_scale = 2.0 * lens["orthographic"]["ymag"]
    camera.clip_end = 1e6


def set_sky(scene, path, radiance):
    world = bpy.data.worlds.new("sky")
    scene.world = world
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    background = nodes["Background"]
    if path is None:
        background.inputs["Color"].default_value = (*radiance, 1.0)
        return
    picture = nodes.new("ShaderNodeTexEnvironment")
    picture.image = bpy.data.images.load(str(pathlib.Path(path).resolve()))
    picture.image.colorspace_settings.name = "Linear Rec.709"
    # glTF's -Z is Blender's +Y. There the centre column looks along +X and u grows towards -Y; here along +Y and towards +X.
    mapping = nodes.new("ShaderNodeMapping")
    mapping.vector_type = "POINT"
    mapping.inputs["Rotation"].default_value = (0.0, 0.0, -math.pi / 2)
    coordinates = nodes.new("ShaderNodeTexCoord")
    links.new(coordinates.outputs["Generated"], mapping.inputs["Vector"])
    links.new(mapping.outputs["Vector"], picture.inputs["Vector"])
    links.new(picture.outputs["Color"], background.inputs["Color"])
    world.cycles.sampling_method = "MANUAL"
    world.cycles.sample_map_resolution = 2048


def set_integrator(scene, options):
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = options.spp
    cycles.seed = options.seed
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = options.denoise
    if options.denoise:
        cycles.denoiser = "OPENIMAGEDENOISE"
        cycles.denoising_input_passes = "RGB_ALBEDO_NORMAL"
        cycles.denoising_prefilter = "ACCURATE"
    cycles.use_light_tree = True
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.blur_glossy = 0.0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1.0
    for kind in ("max", "diffuse", "glossy", "transmission", "transparent_max", "volume"):
        setattr(cycles, f"{kind}_bounces", options.depth)
    cycles.min_light_bounces = cycles.min_transparent_bounces = 0


def set_picture(scene, options):
    width, height = (int(v) for v in options.size.split("x"))
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.film_transparent = False
    render.use_compositing = render.use_sequencer = False
    render.dither_intensity = 0.0
    render.threads_mode = "FIXED" if options.threads else "AUTO"
    render.threads = options.threads or 1
    scene.view_settings.view_transform = "Raw"
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode = "RGB"
    render.image_settings.color_depth = "32"
    render.filepath = str(pathlib.Path(options.output).resolve())


def main():
    options = parse()
    import_scene(options.scene)
    emit_from_fronts()
    scene = bpy.context.scene
    choose_camera(options.scene, options.camera, scene)
    set_sky(scene, options.env, [float(v) for v in options.sky.split(",")])
    set_integrator(scene, options)
    set_picture(scene, options)
    start = time.monotonic()
    bpy.ops.render.render(write_still=True)
    seconds = time.monotonic() - start
    print(f"Cycles {bpy.app.version_string}, {options.spp} samples per pixel, {seconds:.3f} s: {options.output}", flush=True)
    os._exit(0)  # bpy 4.2 as a module crashes while Python takes it down, with the picture already written


if __name__ == "__main__":
    main()
