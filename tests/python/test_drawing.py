"""Pictures by OpenGL, if the package was built with the viewer."""

import importlib.util
import subprocess
import sys
import unittest

import numpy as np
import support

import prelight

HAS_VIEWER = importlib.util.find_spec("prelight._viewer") is not None


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

    def test_BadRequests_AreNamed(self):
        support.named(self, "shading glosy", lambda: self.draw(shading="glosy"), "did you mean glossy?")
        support.named(self, "shading vo", lambda: self.draw(shading="vo"), "does not hold", "--vo")
        support.named(self, "shading full", lambda: self.draw(shading="full"), "global_illumination")
        support.named(self, "height", lambda: self.draw(height="tall"), "'tall'")
        with self.assertRaises(prelight.UsageError):
            self.draw(height=-1)


class WithoutIt(unittest.TestCase):
    @unittest.skipIf(HAS_VIEWER, "the package was built with the viewer")
    def test_Draw_SaysWhatToDo(self):
        support.named(self, "draw", lambda: prelight.draw(support.cornell()), "PRELIGHT_VIEWER")


if __name__ == "__main__":
    unittest.main()
