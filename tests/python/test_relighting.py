import unittest

import numpy as np
import support

import prelight
from prelight import basis

TURN = np.array([[0.0, 1.0, 0.0], [0.6, 0.0, 0.8], [0.8, 0.0, -0.6]])


def noisy_sky():
    return prelight.Sky(np.random.default_rng(1).random((12, 24, 3), dtype=np.float32))


class Relighting(unittest.TestCase):
    def test_EveryKindOfLight_AddsUpAndTurns(self):
        baked, sky = support.baked(), noisy_sky()
        further = np.cos(np.arange(48.0)).reshape(3, 16)
        sun = prelight.DistantLight((1, 2, 3), (2.0, 1.0, 0.5))
        moon = prelight.DistantLight((0, -5, 0), (0.1, 0.2, 0.3), half_angle=0.5)
        light = basis.sh_of_sky(sky, 3) + further[:, :9]
        light += np.outer(sun.irradiance, basis.sh_of_direction(sun.towards, 3))
        light += np.outer(moon.irradiance, basis.sh_of_cap(moon.towards, 0.5, 3)) / (np.pi * np.sin(0.5) ** 2)
        right = prelight.relight(baked, basis.rotate_sh(light, TURN)) / np.pi
        relighter = prelight.Relighter(baked, device=support.device())
        relighter.light(sky, lights=[sun, moon], coefficients=further, rotation=TURN)
        np.testing.assert_allclose(relighter.radiance(), right, atol=2e-5 * np.abs(right).max())

    def test_DistantLight_IsExactInTheOpen_ByTheScene(self):
        scene = prelight.make_scene([prelight.Mesh(*support.square())])
        open_bake = prelight.bake(scene, sh=2, rays=256, device=support.device())
        sun = prelight.DistantLight((3, 4, 0), (5.0, 10.0, 15.0), half_angle=0.00465)
        relighter = prelight.Relighter(open_bake, scene=scene, device=support.device())
        relighter.light(lights=[sun])
        right = np.tile(0.8 * np.array(sun.irradiance) / np.pi, (4, 1))
        np.testing.assert_allclose(relighter.radiance(), right, rtol=0.03)

    def test_Ch_Haar_AndGroups_AgreeWithTheProcessor(self):
        baked, sky = support.baked(), noisy_sky()
        for technique in ("ch", "haar"):
            relighter = prelight.Relighter(baked, technique=technique, device=support.device())
            relighter.light(sky)
            right = prelight.relight(baked, sky, technique=technique) / np.pi
            np.testing.assert_allclose(relighter.radiance(), right, atol=2e-5 * np.abs(right).max(), err_msg=technique)
        lamps = baked.light_groups
        relighter = prelight.Relighter(baked, technique="light_groups", device=support.device())
        relighter.light(groups=lamps.colors)
        right = lamps.irradiance(np.ascontiguousarray(lamps.colors)) / np.pi
        np.testing.assert_allclose(relighter.radiance(), right, rtol=1e-4, atol=1e-6)

    def test_Result_GoesIntoAGivenArray(self):
        relighter = prelight.Relighter(support.baked(), device=support.device())
        relighter.light(noisy_sky())
        out = np.empty((len(relighter), 3), dtype=np.float32)
        self.assertIs(relighter.radiance(out), out)
        np.testing.assert_array_equal(out, relighter.radiance())
        for wrong in (out[:-1], out.astype(np.float64), np.asfortranarray(out), [0.0]):
            support.named(self, "out", lambda given=wrong: relighter.radiance(given))

    def test_Reason_NamesTheTechnique(self):
        relighter = prelight.Relighter(support.baked(), device=support.device())
        self.assertEqual(relighter.technique, "sh")
        self.assertEqual(len(relighter), support.cornell().vertex_count)
        self.assertIn("sh: order 3, 3 channels", relighter.reason)
        chosen = prelight.Relighter(support.baked(), technique="ch", device=support.device())
        self.assertIn("chosen by technique", chosen.reason)
        self.assertGreater(relighter.bytes_moved, len(relighter) * 27 * 4)

    def test_Keys_AreRelitAtAMoment(self):
        moving = prelight.bake(
            prelight.builtin("swing"), sh=2, rays=16, animation=0, keys=2, device=support.device()
        )
        relighter = prelight.Relighter(moving, device=support.device())
        self.assertEqual(relighter.technique, "animation")
        light = basis.sh_of_sky(noisy_sky(), 2)
        relighter.light(coefficients=light)
        relighter.set_time(float(np.mean(moving.animation.times)))
        right = sum(key.irradiance(light) for key in moving.animation.keys) / (2 * np.pi)
        np.testing.assert_allclose(relighter.radiance(), right, atol=2e-5 * np.abs(right).max())

    def test_WrongArguments_AreNamed(self):
        baked, device = support.baked(), support.device()
        relighter = prelight.Relighter(baked, device=device)
        support.named(self, "bake", lambda: prelight.Relighter(None), "prelight.Bake")
        support.named(self, "technique", lambda: prelight.Relighter(baked, technique="sun", device=device), "sh, animation")
        support.named(self, "bake", lambda: prelight.Relighter(baked, technique="volume", device=device), "only sh, ch")
        support.named(self, "set_time", lambda: relighter.set_time(0.0))
        support.named(self, "coefficients", lambda: relighter.light(coefficients=np.ones((3, 7))), "order^2")
        support.named(self, "rotation", lambda: relighter.light(rotation=np.eye(2)))
        support.named(self, "groups", lambda: relighter.light(groups=np.ones((9, 3))), "one per group")
        dark = prelight.DistantLight((0, 0, 0))
        support.named(self, "lights", lambda: relighter.light(lights=[dark]), "direction")
        single, long = prelight.DistantLight((0, 1, 0), irradiance=1.0), prelight.DistantLight((0, 1, 0, 1, 0, 0))
        for wrong in ([single] * 3, [long], [dark, long]):
            support.named(self, "lights", lambda given=wrong: relighter.light(lights=given), "(3,)")


class Skies(unittest.TestCase):
    def test_ProjectedSky_IsThatOfTheProcessor(self):
        sky = noisy_sky()
        projector = prelight.SkyProjector(sky, 5, device=support.device())
        right = basis.sh_of_sky(sky, 5)
        np.testing.assert_allclose(projector.sh(), right, atol=1e-5)
        np.testing.assert_allclose(projector.sh(rotation=TURN), basis.rotate_sh(right, TURN), atol=1e-5)
        projector.set_sky(prelight.Sky(np.full((12, 24, 3), 2.0, dtype=np.float32)))
        self.assertEqual(projector.haar(4).shape, (3, 96))
        np.testing.assert_allclose(projector.haar(4)[0, ::16], 8.0, rtol=1e-5)
        support.named(self, "sky", lambda: projector.set_sky(prelight.constant_sky()), "24 x 12")
        support.named(self, "samples", lambda: projector.haar(4, samples=65536), "64")


if __name__ == "__main__":
    unittest.main()
