"""A furnished room lit by Cycles, drawn by Prelight, and shown by Cycles with the light map that Prelight baked."""

import math

import bpy
import numpy as np
import prelight
from support import KEEP, AddonTest, add, drawn_by_cycles, lambertian, lamp, select, world

from prelight_blender import scene_file, sky
from prelight_blender.axes import TO_PRELIGHT

WIDTH, HEIGHT = 256, 144


def tiles():
    """A picture of 8 x 8 squares."""
    image = bpy.data.images.new("Tiles", 64, 64)
    y, x = np.mgrid[0:64, 0:64] // 8
    values = np.where(((x + y) % 2 == 0)[..., None], (0.85, 0.8, 0.7, 1.0), (0.35, 0.3, 0.3, 1.0))
    image.pixels.foreach_set(values.astype(np.float32).reshape(-1))
    image.pack()
    return image


def textured():
    material = lambertian()
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image, node.interpolation = tiles(), "Closest"
    material.node_tree.links.new(node.outputs["Color"], material.node_tree.nodes["Diffuse BSDF"].inputs["Color"])
    return material


def furnished_room():
    """A room that is open above and in front, with a lamp of each kind and a blue sky."""
    white, red, green = lambertian((0.7, 0.7, 0.7)), lambertian((0.6, 0.1, 0.08)), lambertian((0.15, 0.45, 0.1))
    half = math.pi / 2
    walls = {"floor": ((0, 0, 0), (0, 0, 0), textured()), "back": ((0, 2, 1), (half, 0, 0), white),
             "left": ((-2, 0, 1), (half, 0, half), red), "right": ((2, 0, 1), (half, 0, -half), green)}
    items = []
    for name, (location, rotation, material) in walls.items():
        item = add("plane", size=4, location=location, rotation=rotation)
        if name != "floor":
            item.location.z = 2
        item.data.materials.append(material)
        items.append(item)
    head = add("monkey", size=1.3, location=(-0.6, 0.3, 0.75), rotation=(-0.4, 0, 0.4))
    head.modifiers.new("Smooth", "SUBSURF").levels = 2
    bpy.ops.object.modifier_apply(modifier="Smooth")
    for face in head.data.polygons:
        face.use_smooth = True
    box = add("cube", size=0.8, location=(0.9, 0.4, 0.4), rotation=(0, 0, 0.5))
    for item in (head, box):
        item.data.materials.append(white)
        items.append(item)
    lamp("AREA", (0.3, 0.3, 3.5), energy=60, size=0.8)
    lamp("SPOT", (1.5, -1.5, 2.5), (0.9, 0, 0.7), energy=60, spot_size=0.7, shadow_soft_size=0, color=(1, 0.8, 0.5))
    lamp("SUN", rotation=(0.5, -0.3, 0), energy=1.0).data.angle = 0.0
    world((0.25, 0.35, 0.6))
    return items


def camera():
    data = bpy.data.cameras.new("Camera")
    item = bpy.data.objects.new("Camera", data)
    item.location, item.rotation_euler = (0, -5.2, 1.9), (1.42, 0, 0)
    bpy.context.scene.collection.objects.link(item)
    bpy.context.view_layer.update()
    return item


def drawn_by_prelight(path, of, samples):
    seen = prelight.look_at((0, 0, 0), (0, 0, -1))
    seen.world = (TO_PRELIGHT @ np.array(of.matrix_world)).tolist()
    seen.y_fov = 2 * math.atan(math.tan(of.data.angle / 2) * HEIGHT / WIDTH)
    radiance = sky.radiance_of(bpy.context.scene.world)
    light = None if radiance is None else prelight.Sky(np.ascontiguousarray(radiance))
    return prelight.render(prelight.load(path), width=WIDTH, height=HEIGHT, samples=samples, camera=seen, sky=light)


def write_png(path, picture):
    image = bpy.data.images.new("Shown", picture.shape[1], picture.shape[0])
    rgba = np.ones((*picture.shape[:2], 4), np.float32)
    clipped = np.clip(picture, 0, 1)
    rgba[..., :3] = np.where(clipped <= 0.0031308, 12.92 * clipped, 1.055 * clipped ** (1 / 2.4) - 0.055)
    image.pixels.foreach_set(np.ascontiguousarray(rgba[::-1]).reshape(-1))
    image.filepath_raw, image.file_format = str(path), "PNG"
    image.save()


class Pictures(AddonTest):
    def test_BakedRoom_LooksAsItsOwnLightDid(self):
        items = furnished_room()
        eye = camera()
        own = drawn_by_cycles(self.folder, WIDTH, HEIGHT, eye, samples=96, bounces=12)
        scene_file.write(bpy.context, self.folder / "room.glb", items)
        traced = drawn_by_prelight(self.folder / "room.glb", eye, 48)
        select(*items)
        self.bake(what="LIGHT_MAP", rays=1024, texel_size=0.03)
        self.assertEqual(self.notes(), "")
        for item in list(bpy.data.objects):
            if item.type == "LIGHT":
                item.hide_render = True
        shown = drawn_by_cycles(self.folder, WIDTH, HEIGHT, eye, samples=32, bounces=0)
        if KEEP:
            write_png(self.folder / "blender.png", np.concatenate([own, traced, shown], axis=1))
        surfaces = np.abs(own - (0.25, 0.35, 0.6)).max(axis=-1) > 1e-3  # Leaves out the sky.
        for name, picture in (("drawn by Prelight", traced), ("light map", shown)):
            ratio = picture[surfaces].mean() / own[surfaces].mean()
            apart = np.abs(picture - own)[surfaces].mean() / own[surfaces].mean()
            print(f"\n    {name}: {ratio:.4f} of Cycles' light, pixels {apart:.4f} apart", end=" ")
            self.assertAlmostEqual(ratio, 1.0, delta=0.01)
            self.assertLess(apart, 0.06)

    def test_MappedPictures_LieWhereTheyDoInCycles(self):
        """A glowing plane whose four quarters differ, moved, turned and scaled by Mapping, on the second of two UV maps."""
        plane = add("plane", size=2)
        plane.data.uv_layers.new(name="Other")
        plane.data.uv_layers["Other"].data.foreach_set("uv", np.float32([0.1, 0, 0.9, 0.2, 1, 1, 0, 0.8]))
        image = bpy.data.images.new("Quarters", 32, 32, float_buffer=False)
        values = np.ones((32, 32, 4), np.float32)
        for rows, columns, color in (((0, 16), (0, 16), (1, 0, 0)), ((0, 16), (16, 32), (0, 1, 0)), ((16, 32), (0, 16), (0, 0, 1))):
            values[slice(*rows), slice(*columns), :3] = color
        image.pixels.foreach_set(values.reshape(-1))
        material = bpy.data.materials.new("Glow")
        material.use_nodes = True
        nodes, links = material.node_tree.nodes, material.node_tree.links
        nodes.clear()
        kinds = ("ShaderNodeUVMap", "ShaderNodeMapping", "ShaderNodeTexImage", "ShaderNodeEmission", "ShaderNodeOutputMaterial")
        place, mapping, texture, glow, output = (nodes.new(kind) for kind in kinds)
        place.uv_map, texture.image, texture.interpolation = "Other", image, "Closest"
        mapping.inputs["Location"].default_value = (0.3, -0.1, 0)
        mapping.inputs["Rotation"].default_value = (0, 0, 0.5)
        mapping.inputs["Scale"].default_value = (1.5, 0.8, 1)
        for source, target in zip((place, mapping, texture, glow), (mapping, texture, glow, output)):
            links.new(source.outputs[0], target.inputs[0])
        plane.data.materials.append(material)
        eye = camera()
        eye.location, eye.rotation_euler = (0.2, -0.5, 3), (0.15, 0, 0.1)
        bpy.context.view_layer.update()
        own = drawn_by_cycles(self.folder, WIDTH, HEIGHT, eye, samples=16, bounces=0)
        scene_file.write(bpy.context, self.folder / "glow.glb", [plane])
        drawn = drawn_by_prelight(self.folder / "glow.glb", eye, 16)
        self.assertGreater(min(own[..., channel].mean() for channel in range(3)), 0.05)
        self.assertGreater(np.abs(own[..., 0] - own[..., 1]).mean(), 0.05)
        self.assertLess((np.abs(drawn - own).max(axis=-1) > 0.2).mean(), 0.01)  # Pixels at edges may differ.
