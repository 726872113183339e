import os
import pathlib
import signal
import tempfile
import threading
import time
import unittest

import numpy as np
import support

import prelight
from prelight import basis


class Bakes(unittest.TestCase):
    def test_WhatIsAskedFor_IsThereAndTheRestIsNot(self):
        room, baked = support.cornell(), support.baked()
        self.assertEqual(baked.ao.shape, (room.vertex_count,))
        self.assertEqual(baked.bent_normals.shape, (room.vertex_count, 3))
        self.assertEqual(baked.sh.coefficients.shape, (room.vertex_count, 3, 9))
        self.assertEqual(baked.ch.order, 3)
        self.assertEqual(baked.horizons.shape, (room.vertex_count, 8))
        self.assertEqual(baked.haar.offsets.shape, (3 * room.vertex_count + 1,))
        self.assertEqual(baked.haar.indices.shape, baked.haar.values.shape)
        self.assertEqual(baked.light_groups.coefficients.shape, (room.vertex_count, 3, 1))
        for name in ("glossy", "light_map", "irradiance", "apertures"):
            self.assertIsNone(getattr(baked, name), name)
        self.assertGreater(baked.rays, 0)
        self.assertTrue(0 < baked.error < 0.1)
        self.assertTrue(any(name == "bounces" and runs for name, runs, _ in baked.passes))

    def test_Arrays_AreViewsThatOutliveTheBake(self):
        scene = prelight.make_scene([prelight.Mesh(*support.square())])
        baked = prelight.bake(scene, ao=True, sh=2, rays=16, device=support.device())
        ao, coefficients = baked.ao, baked.sh.coefficients
        for array in (ao, coefficients):
            self.assertFalse(array.flags.owndata)
            self.assertFalse(array.flags.writeable)
        self.assertEqual(baked.ao.ctypes.data, ao.ctypes.data)
        del baked, scene
        np.testing.assert_allclose(ao, 1.0, atol=1e-6)  # Nothing stands on the square.
        np.testing.assert_allclose(coefficients[:, 0, 0], basis.sh_values((0, 1, 0), 1)[0], atol=1e-5)

    def test_SameSeed_GivesTheSameBytes(self):
        first, second, other = (
            prelight.bake(support.cornell(), ao=True, rays=16, seed=seed, device=support.device()).ao for seed in (1, 1, 2)
        )
        self.assertEqual(first.tobytes(), second.tobytes())
        self.assertNotEqual(first.tobytes(), other.tobytes())

    def test_SavedBake_IsCarried(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "room.glb"
            prelight.save(path, support.cornell(), support.baked())
            carried = prelight.carried_bake(prelight.load(path))
            np.testing.assert_array_equal(carried.ao, support.baked().ao)
            np.testing.assert_array_equal(carried.sh.coefficients, support.baked().sh.coefficients)
            support.named(self, "room.gltf", lambda: prelight.save(path.with_suffix(".gltf"), support.cornell()), ".glb")

    def test_LightMap_HasTheLightOfTheRoom(self):
        map = prelight.bake(
            support.cornell(), light_map=True, texel_size=0.25, photons=20_000, rays=16, device=support.device()
        ).light_map
        self.assertEqual(map.values.shape, (map.height, map.width, 3, 1))
        self.assertEqual(map.corners.shape[1:], (3, 2))
        self.assertTrue((map.corners >= 0).all())
        lit = map.values[..., 0]
        self.assertTrue(np.isfinite(lit).all())
        self.assertGreater(lit[..., 0].sum(), lit[..., 2].sum())  # The lamp is yellow.

    def test_Denoise_SmoothsTheLightMap_OrSaysThatTheDenoiserIsMissing(self):
        options = {"light_map": True, "texel_size": 0.1, "rays": 16, "device": support.device()}
        plain = prelight.bake(support.cornell(), **options).light_map.values
        try:
            denoised = prelight.bake(support.cornell(), denoise=True, **options).light_map.values
        except prelight.Error as error:
            self.assertIn("Open Image Denoise", str(error))
            return
        self.assertLess(np.abs(np.diff(denoised, axis=1)).mean(), 0.8 * np.abs(np.diff(plain, axis=1)).mean())

    def test_BadRequests_AreNamedAsArguments(self):
        room, device = support.cornell(), support.device()

        def refused(where, *parts, **options):
            error = support.named(self, where, lambda: prelight.bake(room, device=device, **options), *parts)
            self.assertNotIn("Request", str(error))

        refused("bake", "nothing is asked for")
        refused("sh", "'two'", sh="two")
        refused("rays", "-1", ao=True, rays=-1)
        refused("sky", "str", radiosity=True, sky="sky.hdr")
        refused("max_memory", ao=True, max_memory=1)

    def test_Plan_SaysWhatRuns(self):
        passes = {name: runs for name, runs, _ in prelight.plan(support.cornell(), ao=True).passes}
        self.assertTrue(passes["ambient occlusion"])
        self.assertFalse(passes["sh transfer"])


class Progress(unittest.TestCase):
    """An endless bake is stopped in several ways."""

    endless = {"sh": 3, "rays": 1 << 20}

    def test_Stages_AreToldInOrder(self):
        told = []
        prelight.bake(support.cornell(), sh=2, rays=256, device=support.device(), progress=lambda *at: told.append(at))
        self.assertTrue(told)
        fractions = [fraction for stage, fraction in told if stage == "cast"]
        self.assertTrue(fractions)
        self.assertEqual(fractions, sorted(fractions))
        self.assertTrue(all(0 <= fraction <= 1 for fraction in fractions))

    def test_False_EndsTheBake(self):
        with self.assertRaises(prelight.Interrupted):
            prelight.bake(support.cornell(), **self.endless, device=support.device(), progress=lambda *_: False)

    def test_WhatTheFunctionRaises_EndsTheBake(self):
        def fail(stage, fraction):
            raise LookupError(stage)

        with self.assertRaises(LookupError):
            prelight.bake(support.cornell(), **self.endless, device=support.device(), progress=fail)

    def test_Signal_EndsTheBakeSoon(self):
        sent = []

        def press():
            sent.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

        timer = threading.Timer(1.0, press)
        timer.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                prelight.bake(support.cornell(), **self.endless, device=support.device())
        finally:
            timer.cancel()
        self.assertLess(time.monotonic() - sent[0], 20)

    def test_OtherThreads_RunMeanwhile(self):
        stop, counted = threading.Event(), []

        def count():
            while not stop.is_set():
                counted.append(time.monotonic())
                time.sleep(0.002)

        thread = threading.Thread(target=count)
        thread.start()
        begin = time.monotonic()
        prelight.bake(support.cornell(), sh=2, seconds=1.0, device=support.device())
        end = time.monotonic()
        stop.set()
        thread.join()
        during = [at for at in counted if begin < at < end]
        self.assertGreater(len(during), 20)

    def test_StoppedBake_GoesOnFromItsCheckpoint(self):
        options = {"sh": 2, "rays": 512, "seed": 3, "device": support.device()}
        whole = prelight.bake(support.cornell(), **options)
        with tempfile.TemporaryDirectory() as folder:
            state = pathlib.Path(folder) / "state"
            with self.assertRaises(prelight.Interrupted):
                prelight.bake(support.cornell(), **options, checkpoint=state, progress=lambda _, done: done < 0.3)
            self.assertTrue(state.exists())
            resumed = prelight.bake(support.cornell(), **options, checkpoint=state)
            self.assertFalse(state.exists())
        np.testing.assert_array_equal(resumed.sh.coefficients, whole.sh.coefficients)


class Relighting(unittest.TestCase):
    def test_OpenSquareUnderAnEvenSky_GetsPiTimesItsRadiance(self):
        scene = prelight.make_scene([prelight.Mesh(*support.square())])
        baked = prelight.bake(scene, sh=3, ch=3, haar=4, rays=64, device=support.device())
        for technique in ("sh", "ch", "haar"):
            lit = prelight.relight(baked, prelight.constant_sky((1, 2, 3)), technique=technique)
            np.testing.assert_allclose(lit, np.pi * np.tile((1, 2, 3), (4, 1)), rtol=2e-3, err_msg=technique)

    def test_ShAndCh_GiveTheSame(self):
        light = basis.sh_of_sky(prelight.studio_sky(), 3)
        sh = prelight.relight(support.baked(), light, technique="sh")
        ch = prelight.relight(support.baked(), light, technique="ch")
        np.testing.assert_allclose(ch, sh, atol=1e-4 * np.abs(sh).max())
        coefficients = support.baked().sh.coefficients
        np.testing.assert_allclose(sh, np.pi * np.einsum("vci,ci->vc", coefficients, light), atol=1e-4)

    def test_LightGroups_AreLinear(self):
        groups = support.baked().light_groups
        once, twice = (groups.irradiance((k * groups.colors).astype(np.float32)) for k in (1, 2))
        np.testing.assert_allclose(twice, 2 * once, rtol=1e-5)
        self.assertGreater(once.max(), 0)

    def test_LightThatDoesNotFit_IsNamed(self):
        support.named(self, "light", lambda: prelight.relight(support.baked(), np.zeros((3, 4))), "(3, 9)")
        support.named(self, "bake", lambda: prelight.relight(_without_transfer(), np.zeros((3, 9))), "sh")
        support.named(self, "technique", lambda: prelight.relight(support.baked(), np.zeros((3, 9)), technique="zh"))


def _without_transfer():
    scene = prelight.make_scene([prelight.Mesh(*support.square())])
    return prelight.bake(scene, ao=True, rays=16, device=support.device())


if __name__ == "__main__":
    unittest.main()
