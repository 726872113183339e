import pathlib
import pickle
import tempfile
import unittest

import numpy as np
import support

import prelight


class Pictures(unittest.TestCase):
    def test_Picture_HasItsShapeAndTheLampsColour(self):
        picture = prelight.render(support.cornell(), width=48, height=32, samples=8, device=support.device())
        self.assertEqual(picture.shape, (32, 48, 3))
        self.assertEqual(picture.dtype, np.float32)
        self.assertTrue(np.isfinite(picture).all())
        self.assertGreater(picture[..., 0].mean(), picture[..., 2].mean())

    def test_Reference_ReachesTheErrorThatIsAskedFor(self):
        options = {"width": 24, "height": 24, "device": support.device()}
        rough = prelight.reference(support.cornell(), error=0.5, **options)
        fine = prelight.reference(support.cornell(), error=0.03, **options)
        self.assertLess(fine.error, 0.03)
        self.assertGreater(fine.samples, rough.samples)
        self.assertEqual(fine.picture.shape, (24, 24, 3))
        self.assertEqual(fine.variance.shape, (24, 24))

    def test_Camera_DecidesWhatIsSeen(self):
        camera = prelight.look_at((0, 1, 0.5), (0, 1, -1), y_fov=0.3)
        seen = prelight.render(
            support.cornell(), camera=camera, width=16, height=16, samples=4, depth=1, device=support.device()
        )
        np.testing.assert_array_equal(seen, 0)  # Paths of one segment show lamps alone, and no lamp is in view.

    def test_Sky_LightsAnOpenScene(self):
        scene = prelight.make_scene([prelight.Mesh(*support.square(50.0))], cameras=[prelight.look_at((0, 2, 2), (0, 0, 0))])
        picture = prelight.render(scene, sky=prelight.constant_sky((1, 2, 3)), width=8, height=8, samples=256, device=support.device())
        np.testing.assert_allclose(picture.mean(axis=(0, 1)), (1, 2, 3), rtol=1e-2)  # White under an even sky.

    def test_Photons_KeepTheirPower(self):
        sent = prelight.photons(support.cornell(), photons=20_000, device=support.device())
        self.assertEqual(sent.positions.shape, (len(sent), 3))
        self.assertEqual(sent.positions.dtype, np.float64)
        np.testing.assert_allclose(np.add(sent.absorbed, sent.escaped), sent.emitted, rtol=1e-4)
        np.testing.assert_allclose(np.linalg.norm(sent.directions, axis=1), 1, atol=1e-4)
        self.assertTrue((sent.triangles < support.cornell().triangle_count).all())

    def test_WrittenPicture_IsReadAgain(self):
        picture = np.random.default_rng(1).random((6, 9, 3), dtype=np.float32)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "picture.exr"
            prelight.write_picture(path, picture)
            np.testing.assert_array_equal(prelight.read_picture(path), picture)
            np.testing.assert_array_equal(prelight.read_sky(path).radiance, picture)
        self.assertTrue(((0 <= prelight.tone_map(100 * picture)) & (prelight.tone_map(100 * picture) <= 1)).all())

    def test_BadArguments_AreNamed(self):
        room, device = support.cornell(), support.device()
        support.named(self, "height", lambda: prelight.render(room, height=0, device=device), "got 0")
        support.named(self, "method", lambda: prelight.render(room, method="magic"), "global-illumination")
        support.named(self, "error", lambda: prelight.reference(room, error=0.0, device=device), "got 0")
        support.named(self, "picture", lambda: prelight.write_picture("a.exr", np.zeros((4, 4))), "(4, 4)")
        support.named(self, "Sky: radiance", lambda: prelight.Sky(np.full((2, 4, 3), -1, dtype=np.float32)), "texel (0, 0)")
        support.named(self, "sky.hdr", lambda: prelight.read_sky("sky.hdr"))
        support.named(self, "selector abacus", lambda: prelight.Device("abacus"))


class Errors(unittest.TestCase):
    def test_Error_IsTheSameAfterPickling(self):
        error = pickle.loads(pickle.dumps(prelight.UsageError("rays", "got 0", "give some")))
        self.assertEqual((error.where, error.what, error.fix), ("rays", "got 0", "give some"))
        self.assertEqual(str(error), "rays: got 0 (give some)")


if __name__ == "__main__":
    unittest.main()
