"""Results of bakes, and the places where they are stored."""

import subprocess

import bpy
import numpy as np
from support import PI, PROGRAM, AddonTest, accessor, add, colors, glb, lambertian, lamp, looked_up, picture, select, uv, world

from prelight_blender import scene_file
from prelight_blender.tiles import Tiles


def room():
    """A floor, a box and a head with many normals; only the floor is turned and scaled."""
    floor = add("plane", size=4, rotation=(0, 0, 0.3))
    box = add("cube", size=1, location=(0.8, 0.2, 0.5), rotation=(0, 0, 0.5))
    head = add("monkey", size=1, location=(-0.5, -0.3, 0.6))
    bpy.ops.object.select_all(action="DESELECT")
    for face in head.data.polygons:
        face.use_smooth = True
    for item in (floor, box, head):
        item.data.materials.append(lambertian())
    select(floor, box, head)
    return floor, box, head


def written(folder, *items, **options):
    """The scene as the add-on writes it."""
    path = folder / "written.glb"
    scene_file.write(bpy.context, path, items, **options)
    return path


def baked_by_program(path, *arguments):
    """(JSON, bytes) of the file that the program bakes."""
    baked = path.with_name("baked.glb")
    subprocess.run([PROGRAM, "bake", path, "-o", baked, *map(str, arguments), "--quiet"], check=True)
    return glb(baked)


def corner_values(item, document, data, key):
    """The values [corner, ...] that a baked file holds at a node's vertices, found only by place and normal."""
    node = next(n for n in document["nodes"] if n.get("name") == item.name)
    primitives = document["meshes"][node["mesh"]]["primitives"]
    places, values = [], []
    for primitive, extra in zip(primitives, node["extensions"]["PRELIGHT_transfer"]["primitives"]):
        attributes = primitive["attributes"]
        places.append(np.concatenate([accessor(document, data, attributes[name]) for name in ("POSITION", "NORMAL")], axis=1))
        values.append(accessor(document, data, extra[key]))
    places, values = np.concatenate(places), np.concatenate(values)
    mesh = item.data
    mine = np.array([[*mesh.vertices[loop.vertex_index].co, *mesh.corner_normals[loop.index].vector] for loop in mesh.loops])
    apart = np.abs(mine[:, None] - places[None]).max(axis=2)
    assert apart.min(axis=1).max() < 1e-3
    return values[apart.argmin(axis=1)]


class Attributes(AddonTest):
    def test_Occlusion_IsTheProgramsOwn(self):
        items = room()
        document, data = baked_by_program(written(self.folder, *items, lamps=False), "--ao", "--rays", 64)
        self.assertEqual(self.bake(what="AO", rays=64), {"FINISHED"})
        for item in items:
            with self.subTest(item=item.name):
                found, expected = colors(item, "Prelight AO"), corner_values(item, document, data, "ao")
                self.assertLess(expected.min(), 0.8)
                self.assertEqual(len(found), len(item.data.loops))
                np.testing.assert_allclose(found, np.repeat(expected, 3, axis=1), atol=1e-6)

    def test_Light_IsTheProgramsOwn(self):
        items = room()
        lamp("POINT", (1, -1, 3), energy=300, color=(1, 0.8, 0.6))
        document, data = baked_by_program(written(self.folder, *items), "--lightmap", "--rays", 64)
        self.bake(what="LIGHT", rays=64)
        for item in items:
            with self.subTest(item=item.name):
                expected = corner_values(item, document, data, "irradiance")
                self.assertGreater(expected.max(), 0.5)
                np.testing.assert_allclose(colors(item, "Prelight Light"), expected, atol=1e-5 * expected.max())

    def test_Vertices_GetTheMeansOfTheirCorners(self):
        _, box, _ = room()
        self.bake(what="AO", domain="CORNER")
        of_corners = colors(box, "Prelight AO")
        self.bake(what="AO", domain="POINT")
        attribute = box.data.attributes["Prelight AO"]
        self.assertEqual(attribute.domain, "POINT")
        for vertex, found in enumerate(colors(box, "Prelight AO")):
            mine = [of_corners[loop.index] for loop in box.data.loops if loop.vertex_index == vertex]
            np.testing.assert_allclose(found, np.mean(mine, axis=0), atol=1e-6)

    def test_Distance_EndsOcclusion(self):
        floor = add("plane", size=4)
        add("plane", size=4, location=(0, 0, 1), select=False)
        select(floor)
        self.bake(what="AO", distance=0.5)
        self.assertGreater(colors(floor, "Prelight AO").min(), 0.99)
        self.bake(what="AO", distance=0.0)
        self.assertLess(colors(floor, "Prelight AO").max(), 0.9)

    def test_OthersOcclude_UnlessOnlyTheSelectedCount(self):
        floor = add("plane", size=1)
        add("plane", size=8, location=(0, 0, 0.2), select=False)
        select(floor)
        self.bake(what="AO", only_selected=False)
        self.assertLess(colors(floor, "Prelight AO").max(), 0.1)
        self.bake(what="AO", only_selected=True)
        self.assertGreater(colors(floor, "Prelight AO").min(), 0.99)

    def test_HiddenAndUnrendered_DoNotOcclude(self):
        floor = add("plane", size=1)
        roof = add("plane", size=8, location=(0, 0, 0.2), select=False)
        for hide in (lambda hidden: roof.hide_set(hidden), lambda hidden: setattr(roof, "hide_render", hidden)):
            hide(True)
            select(floor)
            self.bake(what="AO")
            self.assertGreater(colors(floor, "Prelight AO").min(), 0.99)
            hide(False)

    def test_ModifiersAndInstances_Occlude(self):
        floor = add("plane", size=1)
        small = add("plane", size=1, location=(-9, 0, 0.2), select=False)
        array = small.modifiers.new("Array", "ARRAY")
        array.count = 20
        select(floor)
        self.bake(what="AO")
        self.assertLess(colors(floor, "Prelight AO").max(), 0.9)
        bpy.data.objects.remove(small)
        roof = add("plane", size=8, location=(0, 50, 0.2), select=False)
        collection = bpy.data.collections.new("Roofs")
        collection.objects.link(roof)
        instance = bpy.data.objects.new("Instance", None)
        instance.instance_type, instance.instance_collection, instance.location = "COLLECTION", collection, (0, -50, 0)
        self.scene.collection.objects.link(instance)
        select(floor)
        self.bake(what="AO")
        self.assertLess(colors(floor, "Prelight AO").max(), 0.1)

    def test_ModifiersThatKeepFaces_AreBakedAsTheyStand(self):
        floor, ball = add("plane", size=4), add("uv_sphere", radius=0.5, location=(0, 0, 3))
        self.bake(what="AO")
        open_above = colors(ball, "Prelight AO").min()
        modifier = ball.modifiers.new("Move", "DISPLACE")
        modifier.direction, modifier.strength, modifier.mid_level = "Z", -2.4, 0.0
        self.bake(what="AO")
        self.assertLess(colors(ball, "Prelight AO").min(), 0.5 * open_above)

    def test_TwoMaterials_EachCornerHasItsOwn(self):
        box = add("cube", size=1, location=(0, 0, 0.55))
        for color in ((0.5, 0.1, 0.1), (0.1, 0.1, 0.5)):
            box.data.materials.append(lambertian(color))
        for face in box.data.polygons:
            face.material_index = face.index % 2
        add("plane", size=5, select=False).data.materials.append(lambertian())
        lamp("SUN", rotation=(0.4, 0.2, 0), energy=2)
        select(box)
        self.bake(what="LIGHT", rays=256)
        light = colors(box, "Prelight Light")
        for face in box.data.polygons:
            cosine = face.normal.dot((np.array(bpy.data.objects["Sun"].matrix_world)[:3, 2]).tolist())
            of_face = light[list(face.loop_indices)].mean()
            if face.normal.z > 0.9:
                self.assertAlmostEqual(of_face, 2 * cosine, delta=0.05)

    def test_Bounces_TakeTheColorOfPicturesAndAttributes(self):
        """A red wall beside a white one, by a picture, by a colour attribute and by a plain colour."""
        floor = add("plane", size=1)
        floor.data.materials.append(lambertian())
        wall = add("plane", size=4, location=(0.6, 0, 0), rotation=(0, -PI / 2, 0), select=False)
        lamp("SUN", rotation=(0, 0.8, 0), energy=0)
        sun = bpy.data.objects["Sun"]
        sun.rotation_euler, sun.data.energy = (0, -0.8, 0), 5
        wall_light = {}
        for kind in ("plain", "picture", "attribute"):
            material = bpy.data.materials.new(kind)
            material.use_nodes = True
            shader = material.node_tree.nodes["Principled BSDF"]
            shader.inputs["Specular IOR Level"].default_value = 0
            shader.inputs["Roughness"].default_value = 1
            if kind == "plain":
                shader.inputs["Base Color"].default_value = (0.8, 0.05, 0.05, 1)
            elif kind == "picture":
                image = bpy.data.images.new("Red", 4, 4)
                # The base colour, in sRGB.
                image.pixels.foreach_set(np.tile(np.float32([0.906332, 0.247801, 0.247801, 1]), 16))
                image.pack()
                node = material.node_tree.nodes.new("ShaderNodeTexImage")
                node.image = image
                material.node_tree.links.new(node.outputs["Color"], shader.inputs["Base Color"])
            else:
                made = wall.data.color_attributes.new("Paint", "FLOAT_COLOR", "CORNER")
                made.data.foreach_set("color", np.tile(np.float32([0.8, 0.05, 0.05, 1]), 4))
                node = material.node_tree.nodes.new("ShaderNodeVertexColor")
                node.layer_name = "Paint"
                material.node_tree.links.new(node.outputs["Color"], shader.inputs["Base Color"])
            wall.data.materials.clear()
            wall.data.materials.append(material)
            select(floor)
            self.bake(what="LIGHT", rays=256, show=False)
            wall_light[kind] = colors(floor, "Prelight Light").mean(axis=0)
            self.assertEqual(self.notes(), "")
        red = wall_light["plain"]
        self.assertGreater(red[0] - red[1], 0.02)
        for kind in ("picture", "attribute"):
            np.testing.assert_allclose(wall_light[kind], red, rtol=0.01)


class LightMaps(AddonTest):
    def test_LightMap_HasTheLightOfTheProgramsMap(self):
        items = room()
        lamp("POINT", (1, -1, 3), energy=300)
        path = written(self.folder, *items)
        self.bake(what="LIGHT_MAP", rays=64)
        document, data = baked_by_program(path, "--lightmap", "--rays", 64)
        image = items[0].data["Prelight Light Map"]
        own = bpy.data.images.load(str(self.folder / "baked.lightmap.exr"))
        own.colorspace_settings.name = "Non-Color"
        expected, found = picture(own), picture(image)
        np.testing.assert_array_equal(found[: expected.shape[0], : expected.shape[1]], expected)
        for item in items[1:]:
            with self.subTest(item=item.name):
                light = looked_up(image, uv(item, "Prelight")).mean()
                of_vertices = corner_values(item, document, data, "irradiance").mean()
                self.assertAlmostEqual(light / of_vertices, 1.0, delta=0.1)

    def test_CutPolygons_HaveTheLightOfTheirPlace(self):
        """Bakes rough ground under the sun: faces that look up get the cosine of their normal, wherever they lie in the map."""
        ground = add("grid", x_subdivisions=24, y_subdivisions=24, size=4)
        heights = np.random.default_rng(7).uniform(0, 0.25, len(ground.data.vertices))
        for vertex, height in zip(ground.data.vertices, heights):
            vertex.co.z = height
        ground.data.materials.append(lambertian((0.01, 0.01, 0.01)))
        lamp("SUN", energy=2)
        path = written(self.folder, ground)
        self.bake(what="LIGHT_MAP", rays=16, texel_size=0.02)
        baked_by_program(path, "--lightmap", "--rays", 16, "--texel-size", 0.02)
        own = bpy.data.images.load(str(self.folder / "baked.lightmap.exr"))
        image, at = ground.data["Prelight Light Map"], uv(ground, "Prelight")
        self.assertGreater(image.size[1], own.size[1])
        below = at[:, 1] * image.size[1] < image.size[1] - own.size[1]
        cut = [face for face in ground.data.polygons if below[list(face.loop_indices)].all()]
        self.assertGreater(len(cut), 5)
        for kind in (cut, ground.data.polygons):
            middles = np.array([at[list(face.loop_indices)].mean(axis=0) for face in kind])
            expected = 2 * np.array([face.normal.z for face in kind])
            apart = np.abs(looked_up(image, middles)[:, 0] - expected)
            self.assertLess(np.median(apart), 0.02)
            self.assertLess(np.percentile(apart, 95), 0.1)

    def test_NothingIsOutsideOfThePicture(self):
        head = add("monkey", size=1)
        lamp("SUN", energy=2)
        self.bake(what="LIGHT_MAP", rays=16)
        for name in ("Prelight", "Prelight Back"):
            at = uv(head, name)
            self.assertGreaterEqual(at.min(), 0.0)
            self.assertLessEqual(at.max(), 1.0)
            self.assertGreater(np.ptp(at, axis=0).min(), 0.3)

    def test_BacksThatAreNotCulled_HaveLightOfTheirOwn(self):
        """A sheet under the sun: the front is lit, the back is not, and the material shows each."""
        sheet = add("plane", size=1)
        lamp("SUN", energy=2)
        self.bake(what="LIGHT_MAP", rays=16)
        image = sheet.data["Prelight Light Map"]
        self.assertAlmostEqual(looked_up(image, uv(sheet, "Prelight")).mean(), 2.0, delta=0.02)
        self.assertLess(looked_up(image, uv(sheet, "Prelight Back")).max(), 0.01)
        bpy.ops.prelight.show()  # The second call hides it.
        sheet.data.materials[0] = lambertian(one_sided=True)
        self.bake(what="LIGHT_MAP", rays=16)
        self.assertEqual([layer.name for layer in sheet.data.uv_layers if "Prelight" in layer.name], ["Prelight"])

    def test_BakedAnew_GivesTheSameAndLeavesNothingBehind(self):
        head = add("monkey", size=1)
        head.data.materials.append(lambertian())
        lamp("SUN", energy=2)
        names, values = [], []
        for _ in range(2):
            self.bake(what="LIGHT_MAP", rays=16)
            names.append([sorted(item.name for item in kind) for kind in (bpy.data.images, bpy.data.materials, bpy.data.node_groups)])
            values.append((picture(head.data["Prelight Light Map"]), uv(head, "Prelight")))
        self.assertEqual(names[0], names[1])
        for one, two in zip(*values):
            np.testing.assert_array_equal(one, two)

    def test_UvMapsOfTheUser_StayAsTheyAre(self):
        head = add("monkey", size=1)
        before = uv(head, "UVMap")
        self.bake(what="LIGHT_MAP", rays=16)
        np.testing.assert_array_equal(uv(head, "UVMap"), before)
        self.assertTrue(head.data.uv_layers["UVMap"].active and head.data.uv_layers["UVMap"].active_render)

    def test_SavedFile_HasThePicture(self):
        head = add("monkey", size=1)
        lamp("SUN", energy=2)
        self.bake(what="LIGHT_MAP", rays=16)
        before = picture(head.data["Prelight Light Map"])
        bpy.ops.wm.save_as_mainfile(filepath=str(self.folder / "saved.blend"))
        bpy.ops.wm.open_mainfile(filepath=str(self.folder / "saved.blend"))
        np.testing.assert_array_equal(picture(bpy.data.objects["Suzanne"].data["Prelight Light Map"]), before)

    def test_Tile_HasTheLightOfItsPolygon(self):
        """Cuts a square into two triangles in a map whose light is linear over the square; the tile's light must be the same."""
        y, x = np.mgrid[0:40, 0:40]
        light = np.stack([x + 0.5, y + 0.5, 0 * x + 1], axis=-1).astype(np.float32)
        tiles = Tiles(light)
        points = np.float32([[0, 0, 5], [1, 0, 5], [1, 1, 5], [0, 1, 5]])
        triangles = np.array([[0, 1, 2], [0, 2, 3]])
        at = np.float32([[[1, 1], [9, 1], [9, 9]], [[1, 1], [9, 9], [1, 9]]])
        places = np.zeros((6, 2), np.float32)
        tiles.add(points, triangles, at, places, np.array([1, 2, 3, 5]))
        made = tiles.picture()
        self.assertEqual(made.shape, (49, 40, 3))
        corners = places[[1, 2, 3, 5]]
        np.testing.assert_allclose(corners.mean(axis=0), [4.5, 44.5])
        found = [made[int(v), int(u), :2] for u, v in corners]
        np.testing.assert_allclose(found, [[1, 1], [9, 1], [9, 9], [1, 9]], atol=1e-4)
        np.testing.assert_allclose(made[44, 4, :2], [5, 5], atol=1e-4)


class Materials(AddonTest):
    def test_ObjectsShowTheResult_AndTheirOwnMaterialsComeBack(self):
        floor, box, _ = room()
        own = [item.material_slots[0].material for item in (floor, box)]
        self.bake(what="AO")
        self.assertTrue(all(item.material_slots[0].material.prelight_is_shown for item in (floor, box)))
        self.assertEqual([item.data.materials[0] for item in (floor, box)], own)
        bpy.ops.prelight.show()
        self.assertEqual([item.material_slots[0].material for item in (floor, box)], own)
        bpy.ops.prelight.show()
        self.assertTrue(box.material_slots[0].material.prelight_is_shown)

    def test_ShownMaterials_AreNotBaked(self):
        """Light from a floor that shows a bake is reflected by the floor's own material."""
        items = room()
        lamp("SUN", energy=2)
        self.bake(what="LIGHT", show=False)
        first = colors(items[2], "Prelight Light")
        self.bake(what="LIGHT", show=True)
        self.bake(what="LIGHT", show=True)
        np.testing.assert_array_equal(colors(items[2], "Prelight Light"), first)

    def test_SharedMaterials_StaySharedAmongThoseBaked(self):
        one, two = add("plane", size=1), add("plane", size=1, location=(3, 0, 0))
        paint = lambertian()
        for item in (one, two):
            item.data.materials.append(paint)
        self.bake(what="AO")
        self.assertIsNotNone(one.material_slots[0].material)
        self.assertEqual(one.material_slots[0].material, two.material_slots[0].material)

    def test_GlowingSurfaces_LightOthers(self):
        """A disk of radiance 5 and radius 0.5 at height 1 gives the point below pi 5 r^2 / (h^2 + r^2) = 3.14 W/m2."""
        floor = add("plane", size=0.1)
        glow = add("circle", radius=0.5, vertices=64, fill_type="NGON", location=(0, 0, 1), rotation=(PI, 0, 0), select=False)
        material = bpy.data.materials.new("Glow")
        material.use_nodes = True
        nodes = material.node_tree.nodes
        nodes.clear()
        shader, output = nodes.new("ShaderNodeEmission"), nodes.new("ShaderNodeOutputMaterial")
        shader.inputs["Strength"].default_value = 5
        material.node_tree.links.new(shader.outputs[0], output.inputs[0])
        glow.data.materials.append(material)
        select(floor)
        self.bake(what="LIGHT", rays=1024)
        self.assertAlmostEqual(colors(floor, "Prelight Light").mean(), PI * 5 * 0.25 / 1.25, delta=0.05)

    def test_PicturesOfNumbersAndBehindOtherNodes_Count(self):
        """Reads the mean of a channel, and a picture behind another node as if that node were missing."""
        floor = add("plane", size=1)
        floor.data.materials.append(lambertian())
        wall = add("plane", size=4, location=(0.6, 0, 0), rotation=(0, -PI / 2, 0), select=False)
        lamp("SUN", rotation=(0, -0.8, 0), energy=5)

        def light_beside(material):
            wall.data.materials.clear()
            wall.data.materials.append(material)
            select(floor)
            self.bake(what="LIGHT", rays=256, show=False)
            return colors(floor, "Prelight Light").mean()

        material = bpy.data.materials.new("Steel")
        material.use_nodes = True
        nodes, links = material.node_tree.nodes, material.node_tree.links
        shader = nodes["Principled BSDF"]
        shader.inputs["Specular IOR Level"].default_value = 0
        shader.inputs["Roughness"].default_value = 1
        shader.inputs["Base Color"].default_value = (0.8, 0.8, 0.8, 1)
        image = bpy.data.images.new("Metal", 4, 4, is_data=True)
        image.pixels.foreach_set(np.tile(np.float32([0, 0.75, 0, 1]), 16))
        texture, channels = nodes.new("ShaderNodeTexImage"), nodes.new("ShaderNodeSeparateColor")
        texture.image = image
        links.new(texture.outputs["Color"], channels.inputs[0])
        links.new(channels.outputs["Green"], shader.inputs["Metallic"])
        wall.data.materials.append(material)
        document, _ = glb(written(self.folder, wall))
        steel = next(found for found in document["materials"] if found["name"] == "Steel")
        # The picture stores bytes.
        self.assertAlmostEqual(steel["pbrMetallicRoughness"]["metallicFactor"], 0.75, places=2)
        links.remove(shader.inputs["Metallic"].links[0])
        grey = bpy.data.images.new("Grey", 4, 4, is_data=True)
        grey.pixels.foreach_set(np.tile(np.float32([0.4, 0.4, 0.4, 1]), 16))
        texture.image = grey
        gamma = nodes.new("ShaderNodeGamma")
        links.new(texture.outputs["Color"], gamma.inputs["Color"])
        links.new(gamma.outputs["Color"], shader.inputs["Base Color"])
        found = light_beside(material)
        self.assertIn('"Grey" is used unchanged', self.notes())
        self.assertAlmostEqual(found / light_beside(lambertian((0.4, 0.4, 0.4))), 1.0, delta=0.02)

    def test_SceneWithoutLight_IsNoted(self):
        floor = add("plane", size=1)
        floor.data.materials.append(lambertian())
        self.bake(what="LIGHT", rays=16)
        self.assertIn("everything is dark", self.notes())
        self.assertEqual(colors(floor, "Prelight Light").max(), 0.0)
        for shine in (lambda: lamp("SUN", energy=1), lambda: world((1, 1, 1))):
            shine()
            self.bake(what="LIGHT", rays=16)
            self.assertEqual(self.notes(), "")
            if "Sun" in bpy.data.objects:
                bpy.data.objects.remove(bpy.data.objects["Sun"])

    def test_WhatIsNotRead_IsNoted(self):
        floor = add("plane", size=1)
        material = bpy.data.materials.new("Noisy")
        material.use_nodes = True
        noise = material.node_tree.nodes.new("ShaderNodeTexNoise")
        material.node_tree.links.new(noise.outputs["Color"], material.node_tree.nodes["Principled BSDF"].inputs["Base Color"])
        floor.data.materials.append(material)
        self.bake(what="LIGHT", rays=16)
        self.assertIn('Base Color of material "Noisy"', self.notes())
