"""Pictures of all shadings, if the package was built with the viewer."""

import importlib.util
import logging
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import typing
import unittest
import warnings

import numpy as np
import support

import prelight
from prelight import drawing

HAS_VIEWER = importlib.util.find_spec("prelight._viewer") is not None
BUILT = pathlib.Path(__file__).resolve().parents[2] / "build/bin/prelight"
PROGRAM = os.environ.get("PRELIGHT_PROGRAM") or (str(BUILT) if BUILT.exists() else shutil.which("prelight"))
SHADINGS = drawing.renderer().shadings() if HAS_VIEWER else []
SIZE = {"width": 32, "height": 24}


@unittest.skipUnless(HAS_VIEWER, "the package was built without the viewer")
class Drawing(unittest.TestCase):
    def draw(self, **options):
        return prelight.draw(support.cornell(), support.baked(), **{"width": 48, "height": 32, **options})

    def test_Picture_HasItsShapeAndIsLit(self):
        for shading in ("phong", "ao", "sh", "ch", "haar", "lights", "horizons", "screen"):
            with self.subTest(shading=shading):
                picture = self.draw(shading=shading, sky=prelight.constant_sky((1, 1, 1)))
                self.assertEqual(picture.shape, (32, 48, 3))
                self.assertTrue(np.isfinite(picture).all())
                self.assertGreater(picture.mean(), 0)

    def test_EvenSky_ShowsWhatIsBaked(self):
        scene = prelight.make_scene([prelight.Mesh(*support.square(50.0))])
        baked = prelight.bake(scene, sh=2, rays=16, device=support.device())
        camera = prelight.look_at((0, 2, 2), (0, 0, 0))
        picture = prelight.draw(
            scene, baked, shading="sh", camera=camera, sky=prelight.constant_sky((1, 2, 3)), width=8, height=8
        )
        np.testing.assert_allclose(picture.mean(axis=(0, 1)), (1, 2, 3), rtol=1e-2)

    def test_Import_LoadsOpenGlWhenItDrawsAlone(self):
        code = (
            "import prelight, os\n"
            "maps = lambda: open(f'/proc/{os.getpid()}/maps').read()\n"
            "assert 'libepoxy' not in maps()\n"
            "prelight.draw(prelight.builtin('cornell'), width=8, height=8)\n"
            "assert 'libepoxy' in maps()\n"
        )
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_MissingBake_IsMadeAndLogged(self):
        stages = []
        with self.assertLogs("prelight", logging.INFO) as logged:
            self.draw(
                shading="glossy",
                baking={"rays": 16},
                device=support.device(),
                progress=lambda stage, done: stages.append(stage),
            )
        self.assertIn("baking", logged.output[0])
        self.assertNotIn("--", logged.output[0])
        self.assertTrue(stages)
        self.assertRaises(prelight.Interrupted, lambda: self.draw(shading="full", progress=lambda stage, done: False))

    def test_Layers_AddUpToThePicture(self):
        layers = self.draw(shading="sh", layers=True)
        picture = layers.pop("picture")
        self.assertEqual(picture.shape, (32, 48, 3))
        parts = [layer for layer in layers.values() if layer.ndim == 3]
        self.assertGreater(len(parts), 1)
        np.testing.assert_allclose(sum(parts), picture, rtol=1e-3, atol=1e-3)
        self.assertEqual(self.draw(shading="ao", layers=True)["ao"].shape, (32, 48))

    def test_Layers_AreWrittenToFiles(self):
        layers = self.draw(shading="ao", layers=True)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.exr"
            prelight.write_picture(path, layers["picture"], layers={"ao": layers["ao"]})
            np.testing.assert_array_equal(prelight.read_picture(path), layers["picture"])
            prelight.write_picture(path, layers["picture"], exposure=2.0)
            np.testing.assert_array_equal(prelight.read_picture(path), 2 * layers["picture"])
        bright = prelight.tone_map(layers["picture"], exposure="auto")
        self.assertEqual(bright.shape, layers["picture"].shape)
        support.named(self, "exposure", lambda: prelight.tone_map(layers["picture"], exposure="some"), "auto")

    def test_Groups_DimLights(self):
        lit = self.draw(shading="lights", sky=prelight.constant_sky(0.0))
        groups = support.baked().light_groups.names
        dark = self.draw(shading="lights", sky=prelight.constant_sky(0.0), group=dict.fromkeys(groups, 0.5))
        self.assertLess(dark.mean(), lit.mean())

    def test_Options_AreThoseOfTheTypes(self):
        described = {option.name: option for option in prelight.options("draw")}
        self.assertEqual(set(described), set(drawing.ShadingOptions.__annotations__))
        self.assertEqual(described["gather"].choices, ("all", "cache", "guided"))
        self.assertEqual(described["samples"].default, 8)

    def test_BadRequests_AreNamed(self):
        support.named(self, "shading glosy", lambda: self.draw(shading="glosy"), "did you mean glossy?")
        support.named(self, "height", lambda: self.draw(height="tall"), "'tall'")
        support.named(self, "height", lambda: self.draw(height=-1), "-1")
        support.named(self, "shadow_strenght", lambda: self.draw(shadow_strenght=1), "did you mean shadow_strength?")
        support.named(self, "waves", lambda: self.draw(waves=11.0), "got 11")
        support.named(self, "gather", lambda: self.draw(gather="some"), "all, cache, guided")
        support.named(self, "ray", lambda: self.draw(baking={"ray": 5}), "did you mean rays?")
        support.named(self, "objects", lambda: self.draw(objects=["a.glb"]), "'a.glb'")
        support.named(self, "group", lambda: self.draw(group=3), "mapping")
        support.named(self, "camera", lambda: self.draw(camera="front"), "look_at")
        support.named(self, "encoding", lambda: self.draw(encoding="none"))


# Arguments of draw(), and of `prelight render` for the same picture.
CASES = (
    *(({"shading": shading}, ["--shading", shading]) for shading in SHADINGS),
    ({}, []),
    ({"shading": "ao", "ao_correction": "cubic"}, ["--shading", "ao", "--ao-correction", "cubic"]),
    (
        {"shading": "vo", "shadow_formula": "thesis", "waves": 0.3, "sky_lights": 8},
        ["--shading", "vo", "--shadow-formula", "thesis", "--waves", "0.3", "--sky-lights", "8"],
    ),
    ({"shading": "screen", "occlusion": "disks"}, ["--shading", "screen", "--occlusion", "disks"]),
    (
        {"shading": "full", "samples": 2, "photons": 4000, "gather": "cache"},
        ["--shading", "full", "--spp", "2", "--photons", "4000", "--gather", "cache"],
    ),
    ({"shading": "full", "rasterised": True}, ["--shading", "full", "--rasterised"]),
    ({"shading": "instant", "virtual_lights": 16}, ["--shading", "instant", "--virtual-lights", "16"]),
    ({"shading": "horizons", "horizon_softness": 5}, ["--shading", "horizons", "--horizon-softness", "5"]),
    ({"shading": "haar", "haar_terms": 4}, ["--shading", "haar", "--haar-terms", "4"]),
    (
        {"shading": "sh", "sky": "preetham:3:35", "sky_rotation": np.radians(180), "caustics": 5000},
        ["--shading", "sh", "--env", "preetham:3:35", "--rotate-env", "180", "--caustics", "5000"],
    ),
    ({"shading": "lightmap", "encoding": "ahd"}, ["--shading", "lightmap", "--encoding", "ahd"]),
    (
        {"shading": "phong", "objects": [("shapes.glb", (0.5, 0, 0), 30, 0.3)], "lights": [], "sky": "neutral"},
        ["--shading", "phong", "--object", "shapes.glb:0.5,0,0:30:0.3", "--light", "none", "--env", "neutral"],
    ),
    ({"shading": "phong", "camera": 0, "seed": 3}, ["--shading", "phong", "--camera", "0", "--seed", "3"]),
)


@unittest.skipUnless(HAS_VIEWER and PROGRAM, "the package was built without the viewer, or there is no program")
class Program(unittest.TestCase):
    """Pictures have the pixels of `prelight render` (PRELIGHT_PROGRAM, build/bin/prelight or the one that is installed)."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)

    def run_program(self, *arguments):
        subprocess.run([PROGRAM, *arguments], check=True, capture_output=True)

    def assert_same(self, scene, options, arguments):
        with self.subTest(options=options), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            self.run_program("render", scene, "-o", "a.exr", "--size", "32x24", "--rays", "16", *arguments)
            picture = prelight.draw(prelight.load(scene), **SIZE, baking={"rays": 16}, device=support.device(), **options)
            np.testing.assert_array_equal(picture, prelight.read_picture("a.exr"))

    def test_EveryShadingAndManyOptions_HaveItsPixels(self):
        self.run_program("scene", "shapes", "-o", "shapes.glb")
        self.assertEqual(set(typing.get_args(drawing.Shading)) - set(SHADINGS), set())
        self.assertGreaterEqual(len(SHADINGS), 15)
        for options, arguments in CASES:
            self.assert_same("shapes.glb", options, arguments)

    def test_CarriedBakeAndMoves_HaveItsPixels(self):
        self.run_program("scene", "shapes", "-o", "shapes.glb")
        self.run_program("bake", "shapes.glb", "-o", "baked.glb", "--sh", "2", "--vo", "--rays", "16")
        self.assert_same("baked.glb", {}, [])
        self.assert_same(
            "baked.glb",
            {"shading": "vo", "moves": [("*", (0.1, 0, 0), 10)]},
            ["--shading", "vo", "--move", "*:0.1,0,0:10"],
        )


class WithoutIt(unittest.TestCase):
    @unittest.skipIf(HAS_VIEWER, "the package was built with the viewer")
    def test_Draw_SaysWhatToDo(self):
        support.named(self, "draw", lambda: prelight.draw(support.cornell()), "PRELIGHT_VIEWER")


if __name__ == "__main__":
    unittest.main()
