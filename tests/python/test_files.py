"""Files with bakes, and exports of bakes."""

import json
import pathlib
import struct
import tempfile
import unittest
import warnings

import numpy as np
import support

import prelight


def document_of(path):
    data = path.read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20 : 20 + length]), data[20 + length :]


def changed(path, edit):
    """Changes the document of a file."""
    document, rest = document_of(path)
    edit(document)
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    path.write_bytes(struct.pack("<4sIII4s", b"glTF", 2, 20 + len(text) + len(rest), len(text), b"JSON") + text + rest)


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def saved(self, **options):
        path = self.folder / "room.glb"
        prelight.save(path, support.cornell(), support.baked(), **options)
        return path

    def test_SceneWithoutABake_IsPlain(self):
        path = self.saved()
        baked = prelight.load(path)
        prelight.save(path, baked)
        self.assertNotIn("PRELIGHT_transfer", path.read_bytes().decode("latin1"))
        self.assertIsNone(prelight.carried_bake(prelight.load(path)))
        np.testing.assert_array_equal(prelight.load(path).positions, support.cornell().positions)

    def test_Compression_MakesTheFileSmaller(self):
        whole = self.saved().stat().st_size
        notes = self.saved(compress="half")
        self.assertLess(notes.stat().st_size, whole)
        carried = prelight.carried_bake(prelight.load(notes))
        np.testing.assert_allclose(carried.sh.coefficients, support.baked().sh.coefficients, atol=2e-3)
        changes = prelight.save(self.folder / "again.glb", support.cornell(), support.baked(), compress="pca:2")
        self.assertTrue(changes and "bytes per vertex" in changes[0])

    def test_CompressionOfEverything_IsReadBackWithinAStep(self):
        room = support.cornell()
        baked = prelight.bake(room, ao=True, horizons=4, haar=8, rays=16, device=support.device())
        changes = prelight.save(self.folder / "small.glb", room, baked, compress="auto")
        for column in ("ao", "bent normals", "horizons", "Haar"):
            self.assertTrue(any(f"compression of {column}:" in change for change in changes), column)
        carried = prelight.carried_bake(prelight.load(self.folder / "small.glb"))
        np.testing.assert_allclose(carried.ao, baked.ao, atol=1 / 255 + 1e-6)
        prelight.save(self.folder / "plain.glb", room, baked)
        self.assertLess((self.folder / "small.glb").stat().st_size, (self.folder / "plain.glb").stat().st_size)

    def test_CompressionOfNothing_IsNamed(self):
        scene = prelight.make_scene([prelight.Mesh(*support.square())])
        baked = prelight.bake(scene, ao=True, rays=16, device=support.device())
        path = self.folder / "square.glb"
        support.named(self, "compress", lambda: prelight.save(path, scene, baked, compress="half"), "SH")
        support.named(self, "compress_occluders", lambda: prelight.save(path, scene, baked, compress_occluders=True))
        support.named(self, "compress", lambda: self.saved(compress="zip"), "zip", "half")
        self.assertFalse(path.exists())

    def test_SceneThatChanged_IsAWarningThatSaysWhatDoesNotFit(self):
        path = self.saved()
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            prelight.carried_bake(prelight.load(path))
        changed(path, lambda document: document["nodes"][0].update(name="Another"))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            prelight.carried_bake(prelight.load(path))

        def dim(document):
            for material in document["materials"]:
                if "emissiveFactor" in material:
                    material["emissiveFactor"] = [0.1, 0.1, 0.1]

        changed(path, dim)
        with self.assertWarnsRegex(prelight.StaleBakeWarning, "materials changed after it was baked"):
            prelight.carried_bake(prelight.load(path))

    def test_Export_IsPlainGltf(self):
        files = prelight.export(self.folder / "plain.glb", support.cornell(), support.baked(), form="vertex-occlusion")
        self.assertEqual([file.name for file in files], ["plain.glb"])
        self.assertEqual(files[0].bytes, (self.folder / "plain.glb").stat().st_size)
        document, _ = document_of(self.folder / "plain.glb")
        self.assertNotIn("PRELIGHT_transfer", document.get("extensionsUsed", []))
        primitives = [primitive for mesh in document["meshes"] for primitive in mesh["primitives"]]
        self.assertTrue(all("COLOR_0" in primitive["attributes"] for primitive in primitives))

    def test_DryRun_WritesNothing(self):
        out = self.folder / "out"
        planned = prelight.export(out, support.cornell(), support.baked(), target="unity", name="room", dry_run=True)
        self.assertFalse(out.exists())
        written = prelight.export(out, support.cornell(), support.baked(), target="unity", name="room")
        self.assertEqual(planned, written)
        self.assertEqual({file.name for file in written}, {path.name for path in out.iterdir()})

    def test_BadExports_AreNamed(self):
        def refused(where, *parts, path="out", **options):
            support.named(
                self, where, lambda: prelight.export(self.folder / path, support.cornell(), support.baked(), **options), *parts
            )

        refused("target", "did you mean three?", target="thre")
        refused("form", "expected one of", form="texture")
        refused("form", "no light map", form="lightmap")
        refused("lights", "remove", lights="all")
        refused("room.gltf", ".glb", path="room.gltf")
        refused("nowhere", "folder", path="nowhere/out")
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
