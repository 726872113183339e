"""Light of Blender's lamps and worlds, baked by Prelight and drawn by Cycles."""

import math
import unittest

import bpy
import numpy as np
from support import PI, AddonTest, add, camera_above, drawn_by_cycles, lambertian, lamp, looked_up, pixel_centres, uv, world

ALBEDO = 0.5
SIZE = 48
MOST = 0.01


class Lamps(AddonTest):
    def setUp(self):
        super().setUp()
        self.plane = add("plane", size=2)
        self.plane.data.materials.append(lambertian((ALBEDO,) * 3))

    def compare(self, most=MOST, samples=128, rays=256):
        """Returns the irradiance of the plane by Cycles and by the light map, both [pixel, rgb]."""
        expected = drawn_by_cycles(self.folder, SIZE, SIZE, camera_above(2), samples).reshape(-1, 3) * PI / ALBEDO
        self.assertEqual(self.bake(what="LIGHT_MAP", texel_size=2 / 96, rays=rays, show=False), {"FINISHED"})
        at = pixel_centres(SIZE)
        corners = uv(self.plane, "Prelight")  # (-1, -1), (1, -1), (1, 1), (-1, 1)
        along = corners[1] - corners[0], corners[3] - corners[0]
        found = looked_up(self.plane.data["Prelight Light Map"], corners[0] + at[:, :1] * along[0] + at[:, 1:] * along[1])
        self.assertGreater(expected.mean(), 0.05)
        np.testing.assert_allclose(found.mean(axis=0), expected.mean(axis=0), rtol=most)
        print(f"\n    {found.mean() / expected.mean():.4f} of Cycles' light", end=" ")
        return found, expected

    def test_Point_IsAsInCycles(self):
        lamp("POINT", (0.3, 0.2, 1), energy=100, shadow_soft_size=0, color=(1, 0.5, 0.25))
        found, expected = self.compare()
        np.testing.assert_allclose(found, expected, rtol=0.02, atol=0.01)

    def test_SoftPoint_IsAsInCycles(self):
        lamp("POINT", (0.3, 0.2, 1), energy=100, shadow_soft_size=0.1, use_soft_falloff=False)
        self.compare(most=0.005)

    def test_SoftFalloff_IsNearlyAsInCycles(self):
        """Cycles divides by d^2 + r^2 there."""
        lamp("POINT", (0.3, 0.2, 1), energy=100, shadow_soft_size=0.1)
        self.compare()

    def test_Sun_IsAsInCycles(self):
        lamp("SUN", rotation=(0.5, 0.3, 0), energy=3)
        found, expected = self.compare()
        np.testing.assert_allclose(found, expected, rtol=0.02)

    def test_SharpSpot_IsAsInCycles(self):
        lamp("SPOT", (0.1, 0, 2), (0.1, 0.05, 0), energy=100, spot_size=math.radians(40), spot_blend=0, shadow_soft_size=0)
        self.compare()

    def test_Spot_IsAsInCycles(self):
        lamp("SPOT", (0.1, 0, 2), (0.1, 0.05, 0), energy=100, spot_size=math.radians(40), spot_blend=0.15, shadow_soft_size=0)
        self.compare()

    def test_FadingSpot_IsAsInCycles(self):
        lamp("SPOT", (0.1, 0, 2), (0.1, 0.05, 0), (2, 2, 2), energy=100, spot_size=math.radians(40), spot_blend=1, shadow_soft_size=0)
        found, expected = self.compare()
        self.assertLess(np.abs(found - expected).max(), 0.02 * expected.max())

    def test_Areas_AreAsInCycles(self):
        for shape in ("SQUARE", "RECTANGLE", "DISK", "ELLIPSE"):
            with self.subTest(shape=shape):
                item = lamp("AREA", (0.2, 0, 1), (0.3, 0.2, 0), (2, 1, 1), energy=50, shape=shape, size=0.4, size_y=0.2)
                found, expected = self.compare(samples=1024, rays=1024)
                bpy.data.objects.remove(item)
                self.assertLess(np.abs(found - expected).mean(), 0.02 * expected.mean())

    def test_NarrowedArea_IsAsInCycles(self):
        for spread in (2.0, 0.8):
            with self.subTest(spread=spread):
                item = lamp("AREA", (0.2, 0, 1), (0.3, 0.2, 0), energy=50, size=0.3, spread=spread)
                found, expected = self.compare(samples=1024)
                bpy.data.objects.remove(item)
                self.assertLess(np.abs(found - expected).mean(), 0.03 * expected.mean())

    def test_LampWithNodes_IsAsInCycles(self):
        item = lamp("POINT", (0, 0, 1), energy=100, shadow_soft_size=0)
        item.data.use_nodes = True
        emission = item.data.node_tree.nodes["Emission"]
        emission.inputs["Strength"].default_value = 0.5
        emission.inputs["Color"].default_value = (1, 0.5, 0.2, 1)
        self.compare()

    @unittest.skipUnless("normalize" in bpy.types.Light.bl_rna.properties, "this Blender's lamps have no such settings")
    def test_ExposureTemperatureAndPowerBySize_AreAsInCycles(self):
        kinds = {
            "POINT": {"shadow_soft_size": 0.1, "use_soft_falloff": False},
            "SPOT": {"shadow_soft_size": 0.0, "spot_size": 0.8},
            "SUN": {"angle": 0.2},
            "AREA": {"size": 0.4, "shape": "DISK", "scale": (2, 1, 1)},
        }
        for kind, options in kinds.items():
            with self.subTest(kind=kind):
                item = lamp(kind, (0.2, 0, 1.5), energy=100, exposure=1.5, use_temperature=True, temperature=4000, normalize=False, **options)
                self.compare(samples=512)
                bpy.data.objects.remove(item)

    def test_UnitScale_ChangesNothing(self):
        """Cycles uses lengths as they are, whatever the scene's unit."""
        self.scene.unit_settings.scale_length = 0.01
        lamp("POINT", (0.3, 0.2, 1), energy=100, shadow_soft_size=0)
        self.compare()

    def compare_around_a_block(self, samples):
        """Adds a block that casts a shadow; pixels on it and at its foot are left out."""
        block = add("cube", size=0.5, location=(0.2, 0.1, 0.25), rotation=(0, 0, 0.5), select=False)
        block.data.materials.append(lambertian())
        bpy.ops.object.select_all(action="DESELECT")
        self.plane.select_set(True)
        camera = camera_above(2)
        camera.location.z = 5
        expected = drawn_by_cycles(self.folder, SIZE, SIZE, camera, samples, 8).reshape(-1, 3) * PI / ALBEDO
        self.bake(what="LIGHT_MAP", texel_size=2 / 96, rays=1024, show=False)
        at = pixel_centres(SIZE)
        corners = uv(self.plane, "Prelight")
        along = corners[1] - corners[0], corners[3] - corners[0]
        found = looked_up(self.plane.data["Prelight Light Map"], corners[0] + at[:, :1] * along[0] + at[:, 1:] * along[1])
        ground = np.linalg.norm(2 * at - 1 - (0.2, 0.1), axis=1) > 0.42
        return found[ground], expected[ground]

    def test_Shadow_LiesWhereItIsInCycles(self):
        lamp("SUN", rotation=(0.9, 0, 0.4), energy=3)
        found, expected = self.compare_around_a_block(64)
        self.assertGreater((expected < 0.2 * expected.max()).mean(), 0.02)  # There is a shadow.
        self.assertLess(np.abs(found - expected).mean(), 0.03 * expected.mean())

    def test_SoftShadows_AreAsInCycles(self):
        kinds = {
            "POINT": {"location": (-0.9, -0.6, 1.5), "energy": 100, "shadow_soft_size": 0.15, "use_soft_falloff": False},
            "SPOT": {"location": (-0.9, -0.6, 1.5), "rotation": (0.5, -0.6, 0), "energy": 100, "spot_size": 1.2,
                     "shadow_soft_size": 0.15, "use_soft_falloff": False},
            "SUN": {"rotation": (0.9, 0, 0.4), "energy": 3, "angle": 0.3},
            "AREA": {"location": (-0.9, -0.6, 1.5), "rotation": (0.3, -0.4, 0), "energy": 100, "size": 0.4},
        }
        for kind, options in kinds.items():
            with self.subTest(kind=kind):
                item = lamp(kind, **options)
                found, expected = self.compare_around_a_block(256)
                bpy.data.objects.remove(item)
                bpy.data.objects.remove(bpy.data.objects["Cube"])
                print(f"\n    {kind}: {found.mean() / expected.mean():.4f} of Cycles' light, {np.abs(found - expected).mean() / expected.mean():.4f} apart", end=" ")
                self.assertAlmostEqual(found.mean() / expected.mean(), 1.0, delta=MOST)
                self.assertLess(np.abs(found - expected).mean(), 0.03 * expected.mean())

    def test_Areas_ThrowNoShadow(self):
        """Puts the sun behind an area lamp."""
        lamp("SUN", energy=3)
        lamp("AREA", (0, 0, 1), energy=0.01, size=1)
        found, _ = self.compare()
        self.assertGreater(found.min(), 2.9)

    def test_EvenWorld_IsAsInCycles(self):
        world((1.0, 0.8, 0.5), 1.5)
        found, expected = self.compare()
        np.testing.assert_allclose(found, expected, rtol=0.02)

    def test_PictureAsWorld_ShinesFromWhereItIsInCycles(self):
        made = world()
        sky = np.full((32, 64, 4), 0.05, np.float32)
        sky[8:12, 40:44, :3] = (60, 40, 20)  # A bright patch to one side: the block's shadow shows which.
        image = bpy.data.images.new("Sky", 64, 32, float_buffer=True)
        image.pixels.foreach_set(sky[::-1].reshape(-1))
        nodes, links = made.node_tree.nodes, made.node_tree.links
        texture = nodes.new("ShaderNodeTexEnvironment")
        texture.image = image
        links.new(texture.outputs["Color"], nodes["Background"].inputs["Color"])
        for turn in (None, (0.2, 0.1, 2.0)):
            with self.subTest(turn=turn):
                if turn:
                    mapping, coordinates = nodes.new("ShaderNodeMapping"), nodes.new("ShaderNodeTexCoord")
                    mapping.inputs["Rotation"].default_value = turn
                    links.new(coordinates.outputs["Generated"], mapping.inputs["Vector"])
                    links.new(mapping.outputs["Vector"], texture.inputs["Vector"])
                found, expected = self.compare_around_a_block(256)
                self.assertLess(expected.min(), 0.3 * expected.max())
                self.assertAlmostEqual(found.mean() / expected.mean(), 1.0, delta=0.02)
                self.assertLess(np.abs(found - expected).mean(), 0.06 * expected.mean())
                bpy.data.objects.remove(bpy.data.objects["Cube"])
