import pathlib
import tempfile
import unittest

import numpy as np
import support

import prelight


class Files(unittest.TestCase):
    def test_BuiltinScene_IsSavedAndLoadedAgain(self):
        room = support.cornell()
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "room.glb"
            prelight.save(path, room)
            read = prelight.load(path)
            np.testing.assert_array_equal(read.positions, room.positions)
            np.testing.assert_array_equal(read.triangles, room.triangles)
            self.assertIsNone(prelight.carried_bake(room))
            self.assertIsNone(prelight.carried_bake(read))

    def test_MissingFile_IsNamed(self):
        error = support.named(self, "missing.glb", lambda: prelight.load("missing.glb"))
        self.assertIsInstance(error, prelight.InputError)

    def test_UnknownBuiltinScene_IsAUsageErrorWithTheNames(self):
        with self.assertRaises(ValueError) as caught:
            prelight.builtin("cornel")
        self.assertIsInstance(caught.exception, prelight.UsageError)
        self.assertIn("cornell", str(caught.exception))

    def test_OptionOfAWrongType_IsNamed(self):
        support.named(self, "scale", lambda: prelight.load("room.glb", scale="two"), "'two'", "str")

    def test_Primitives_CoverTheVertices(self):
        room = support.cornell()
        seen = np.zeros(room.vertex_count, dtype=int)
        for primitive in room.primitives:
            seen[primitive.vertices] += 1
        np.testing.assert_array_equal(seen, 1)


class Arrays(unittest.TestCase):
    def test_SceneOfArrays_HasThem(self):
        positions, triangles = support.square()
        moved = np.eye(4)
        moved[:3, 3] = (10, 20, 30)
        scene = prelight.make_scene(
            [prelight.Mesh(positions, triangles, material=0), prelight.Mesh(positions, triangles, to_world=moved)],
            materials=[prelight.Material("Paint", base_color=(0.5, 0.25, 0.125, 1))],
            lights=[prelight.spot_light((0, 1, 0), (0, -3, 0), (1, 2, 3), (0.1, 0.4))],
            cameras=[prelight.look_at((0, 5, 5), (0, 0, 0), y_fov=0.5)],
        )
        world = scene.positions + np.array(scene.origin)
        np.testing.assert_allclose(world, np.concatenate([positions, positions + (10, 20, 30)]), atol=1e-5)
        np.testing.assert_array_equal(scene.triangles, np.concatenate([triangles, triangles + 4]))
        np.testing.assert_allclose(scene.albedos[scene.triangle_materials[0]], (0.5, 0.25, 0.125))
        np.testing.assert_allclose(scene.normals, np.tile((0, 1, 0), (8, 1)), atol=1e-6)
        self.assertEqual(scene.lights[0].kind, prelight.LightKind.spot)
        np.testing.assert_allclose(scene.lights[0].direction, (0, -1, 0), atol=1e-6)
        self.assertAlmostEqual(scene.cameras[0].y_fov, 0.5)

    def test_ArraysOfAScene_AreReadOnlyAndOutliveIt(self):
        scene = prelight.make_scene([prelight.Mesh(*support.square())])
        positions = scene.positions
        self.assertFalse(positions.flags.owndata)
        self.assertFalse(positions.flags.writeable)
        self.assertEqual(scene.positions.ctypes.data, positions.ctypes.data)
        del scene
        np.testing.assert_allclose(np.abs(positions).max(), 1.0)

    def test_ArraysOfAWrongKind_AreNamed(self):
        positions, triangles = support.square()
        mesh = prelight.Mesh

        def refused(what, call, *parts):
            error = support.named(self, f"Mesh: {what}", call, "expected a NumPy array of", *parts)
            self.assertIsInstance(error, prelight.UsageError)
            return error

        error = refused("positions", lambda: mesh(positions.astype(np.float64), triangles), "got float64 with shape (4, 3)")
        self.assertIn("dtype=numpy.float32", error.fix)
        refused("positions", lambda: mesh(positions[:, :2].copy(), triangles), "(4, 2)", "(n, 3)")
        refused("positions", lambda: mesh(np.asfortranarray(positions), triangles), "not C-contiguous")
        refused("positions", lambda: mesh(positions[::2], triangles), "not C-contiguous")
        refused("positions", lambda: mesh(positions.tolist(), triangles), "got list")
        refused("triangles", lambda: mesh(positions, triangles.astype(np.int64)), "int64", "uint32")
        refused("triangles", lambda: mesh(positions, triangles.ravel()), "(6,)")
        refused("normals", lambda: mesh(positions, triangles, normals=np.zeros((4, 3))), "float64")
        refused("colors", lambda: mesh(positions, triangles, colors=positions), "(n, 4)")

    def test_BadValues_AreNamed(self):
        positions, triangles = support.square()
        beyond, broken = triangles.copy(), positions.copy()
        beyond[1, 2] = 4
        broken[2, 1] = np.nan

        def refused(where, *parts, paint=prelight.Material(), **arguments):
            given = {"positions": positions, "triangles": triangles, **arguments}
            support.named(self, where, lambda: prelight.make_scene([prelight.Mesh(**given)], materials=[paint]), *parts)

        refused("mesh 0: triangles", "triangle 1 has vertex 4, expected one below 4", triangles=beyond)
        refused("mesh 0: positions", "element 2 is", "nan", positions=broken)
        refused("mesh 0: normals", "got 3 elements, expected one per vertex: 4", normals=positions[:3])
        refused("Mesh: to_world", "(3, 3)", to_world=np.eye(3))
        refused("mesh 0: toWorld", "can be inverted", to_world=np.zeros((4, 4)))
        refused('mesh 0 "Box": material', "got 1", material=1, name="Box")
        refused("material 0: emission", "got -1", paint=prelight.Material(emission=(-1, 0, 0)))

    def test_SizesOfLights_AreChecked(self):
        self.assertAlmostEqual(prelight.point_light((0, 1, 0), (1, 1, 1), radius=0.25).radius, 0.25)
        sun = prelight.directional_light((0, -1, 0), (1, 1, 1), angle=0.00465)
        self.assertAlmostEqual(sun.radius, 0.00465)
        support.named(self, "radius", lambda: prelight.point_light((0, 1, 0), (1, 1, 1), radius=-1), "got -1")
        support.named(self, "angle", lambda: prelight.directional_light((0, -1, 0), (1, 1, 1), angle=2), "got 2")

    def test_PartsOfAWrongKind_AreNamed(self):
        support.named(self, "meshes[0]", lambda: prelight.make_scene([1]), "int")
        support.named(self, "lights[0]", lambda: prelight.make_scene([], lights=["sun"]), "str")


class LargeTriangles(unittest.TestCase):
    def scene(self):
        """A square of 4 m and one of 1 m that hovers over its middle."""
        square, triangles = support.square(0.5)
        return prelight.make_scene(
            [
                prelight.Mesh(square * np.float32(4), triangles),
                prelight.Mesh(square + np.float32([0, 0.25, 0]), triangles),
            ]
        )

    def test_Refined_HasVerticesWhereLightChanges(self):
        flat = self.scene()
        cut, report = prelight.refine(flat, 0.05, vertices=500)
        self.assertGreater(report.vertices, 0)
        self.assertLessEqual(report.vertices, 500)
        self.assertEqual(cut.vertex_count, flat.vertex_count + report.vertices)
        self.assertLess(report.error, report.error_before)
        self.assertLess(prelight.bake(cut, ao=True, rays=64).ao.min(), 0.3)
        support.named(self, "refine", lambda: prelight.refine(flat, -1), "got -1")

    def test_Unwrapped_CanBeBakedAtTexels(self):
        flat = self.scene()
        with self.assertRaises(prelight.InputError):
            prelight.bake(flat, sh=2, texels=16, rays=16)
        self.assertIsNotNone(prelight.bake(prelight.unwrap(flat, 16), sh=2, texels=16, rays=16))


if __name__ == "__main__":
    unittest.main()
