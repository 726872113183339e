"""Things that cannot be baked are named with a fix, and nothing is changed."""

import bpy
from support import AddonTest, add, lambertian, lamp, select, world


class Problems(AddonTest):
    def refused(self, *parts):
        said = " | ".join(self.problem())
        for part in parts:
            self.assertIn(part, said)

    def test_NothingSelected(self):
        add("plane")
        select()
        self.refused("Nothing is selected", "select the meshes")

    def test_NoMeshSelected(self):
        bpy.ops.object.empty_add()
        bpy.ops.object.text_add()
        bpy.ops.object.select_all(action="SELECT")
        self.refused("No mesh is selected", '"Empty" (Empty)', '"Text" (Font)', "Convert")

    def test_MeshWithoutFaces(self):
        item = add("plane")
        item.data.clear_geometry()
        self.refused('"Plane" has no faces')

    def test_LinkedData(self):
        add("plane")
        path = str(self.folder / "library.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.read_factory_settings(use_empty=True)
        with bpy.data.libraries.load(path, link=True) as (_, wanted):
            wanted.objects = ["Plane"]
        bpy.context.scene.collection.objects.link(wanted.objects[0])
        bpy.context.view_layer.update()
        select(wanted.objects[0])
        self.refused('"Plane" is linked from', "library.blend", "Make Local")

    def test_SharedMesh(self):
        one = add("plane")
        two = bpy.data.objects.new("Copy", one.data)
        bpy.context.scene.collection.objects.link(two)
        select(two)
        self.refused('"Copy" shares its mesh "Plane"', "Make Single User")
        one.data.use_fake_user = True
        bpy.data.objects.remove(one)
        self.assertEqual(self.bake(rays=16), {"FINISHED"})

    def test_ModifiersThatChangeFaces(self):
        item = add("plane")
        item.modifiers.new("Smooth", "SUBSURF")
        self.refused('modifiers of "Plane" (Smooth)', "Visual Geometry to Mesh")

    def test_HiddenObject(self):
        item = add("plane")
        item.hide_render = True
        self.refused('"Plane" is hidden or not rendered', "outliner")

    def test_MissingTexture(self):
        item = add("plane")
        material = bpy.data.materials.new("Bricks")
        material.use_nodes = True
        image = bpy.data.images.new("wall.png", 4, 4)
        image.source, image.filepath = "FILE", "//textures/wall.png"
        node = material.node_tree.nodes.new("ShaderNodeTexImage")
        node.image = image
        material.node_tree.links.new(node.outputs["Color"], material.node_tree.nodes["Principled BSDF"].inputs["Base Color"])
        item.data.materials.append(material)
        self.refused('"wall.png" of material "Bricks" is missing', "textures/wall.png", "Find Missing Files")

    def test_WorldsThatAreNotRead(self):
        add("plane").data.materials.append(lambertian())
        self.settings.what = "LIGHT"
        made = world()
        sky = made.node_tree.nodes.new("ShaderNodeTexSky")
        made.node_tree.links.new(sky.outputs["Color"], made.node_tree.nodes["Background"].inputs["Color"])
        self.refused('"Sky Texture" of world "World" is not read', "Environment Texture", "World off")
        self.assertEqual(self.bake(world=False, rays=16), {"FINISHED"})

    def test_MissingWorldPicture(self):
        add("plane").data.materials.append(lambertian())
        self.settings.what = "LIGHT"
        made = world()
        node = made.node_tree.nodes.new("ShaderNodeTexEnvironment")
        made.node_tree.links.new(node.outputs["Color"], made.node_tree.nodes["Background"].inputs["Color"])
        self.refused("has no picture")
        node.image = bpy.data.images.new("sky.hdr", 4, 2, float_buffer=True)
        node.image.source, node.image.filepath = "FILE", "/nowhere/sky.hdr"
        self.refused('"sky.hdr" of world "World" is missing', "/nowhere/sky.hdr")

    def test_NoRoomForUvMaps(self):
        item = add("plane")
        while len(item.data.uv_layers) < 8:
            item.data.uv_layers.new()
        self.settings.what = "LIGHT_MAP"
        self.refused('"Plane" has 8 UV maps', "remove one")

    def test_EditMode(self):
        add("plane")
        bpy.ops.object.mode_set(mode="EDIT")
        self.assertFalse(bpy.ops.prelight.bake.poll())
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertTrue(bpy.ops.prelight.bake.poll())

    def test_WhatPrelightRefuses(self):
        """A light map of surfaces that reflect nothing fails with the library's own message."""
        item = add("plane")
        item.data.materials.append(lambertian((0, 0, 0)))
        self.settings.what = "LIGHT_MAP"
        self.refused("no surface reflects diffusely, so none needs a light map")

    def test_DenoiserThatIsNotThere(self):
        """The bake is denoised if the denoiser is installed."""
        item = add("plane")
        item.data.materials.append(lambertian())
        lamp("SUN", energy=1)
        self.settings.what, self.settings.denoise = "LIGHT_MAP", True
        try:
            self.assertEqual(self.bake(rays=16), {"FINISHED"})
        except RuntimeError as error:
            self.assertIn("Denoise", str(error))
