"""Parts of a bake that test_bakes.py does not test."""

import unittest

import numpy as np
import support

import prelight


class Parts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.room = support.cornell()
        cls.baked = prelight.bake(
            cls.room, sh=2, vo=True, volume=4, near_lamps=4, bounces=1, rays=64, device=support.device()
        )

    def test_Occluders_AreSparseRows(self):
        seen, vertices = self.baked.occluders, self.room.vertex_count
        self.assertEqual(seen.offsets.shape, (vertices + 1,))
        self.assertTrue((np.diff(seen.offsets.astype(np.int64)) >= 0).all())
        self.assertEqual(seen.offsets[-1], len(seen.occluders))
        self.assertEqual(seen.vectors.shape, (len(seen.occluders), len(seen.stored), 4))
        self.assertTrue((seen.occluders < len(seen.names)).all())
        form_factors = seen.vectors[:, seen.stored.index("occlusion"), 3]
        self.assertTrue(((0 < form_factors) & (form_factors <= 1)).all())

    def test_Volume_IsAGrid(self):
        volume = self.baked.volume
        low, high = np.array(volume.bounds)
        cells = np.array(volume.coefficients.shape[:3])[::-1]
        self.assertEqual(cells.max(), 4)
        np.testing.assert_allclose((high - low) / cells, ((high - low) / cells)[0], rtol=1e-6)
        self.assertEqual(volume.coefficients.shape[3:], (3, 4))
        self.assertTrue(np.isfinite(volume.coefficients).all())

    def test_NearLamps_AreHalvesOfShells(self):
        halves = self.baked.near_lamps.view(np.float16)
        self.assertEqual(halves.shape, (self.room.vertex_count, 4, 4))
        self.assertTrue(np.isfinite(halves).all())

    def test_Arrays_OutliveTheBake(self):
        baked = prelight.bake(self.room, sh=2, vo=True, rays=16, device=support.device())
        vectors = baked.occluders.vectors
        self.assertFalse(vectors.flags.owndata)
        self.assertFalse(vectors.flags.writeable)
        kept = vectors.copy()
        del baked
        np.testing.assert_array_equal(vectors, kept)

    def test_EncodedLight_IsOfTexelsAndVertices(self):
        baked = prelight.bake(
            self.room, light_map=True, encode=["sh-2"], texel_size=0.5, photons=5_000, rays=16, device=support.device()
        )
        map = baked.light_map
        self.assertEqual(map.encoded["sh-2"].shape[:2], (map.height, map.width))
        self.assertEqual(baked.encoded_light["sh-2"].shape, (self.room.vertex_count, map.encoded["sh-2"].shape[2]))

    def test_LightGroups_GoTogetherByPatterns(self):
        groups = prelight.bake(self.room, light_group={"all": ["*"]}, rays=16, device=support.device()).light_groups
        self.assertEqual(groups.names, ["all"])

    def test_ShadowSet_LeavesReceiversWithoutShadows(self):
        baked = prelight.bake(self.room, ao=True, shadow_sets=[(["*"], [])], rays=16, device=support.device())
        np.testing.assert_allclose(baked.ao, 1, atol=1e-6)

    def test_Keys_AreOfAnAnimation(self):
        swing = prelight.builtin("swing")
        moving = prelight.bake(swing, sh=2, rays=16, animation=0, keys=3, device=support.device()).animation
        self.assertEqual(len(moving.times), 3)
        self.assertEqual(moving.times, sorted(moving.times))
        first, last = moving.keys[0].coefficients, moving.keys[-1].coefficients
        self.assertEqual(first.shape, (swing.vertex_count, 1, 4))
        self.assertGreater(np.abs(last - first).max(), 0.01)

    def test_BadRequests_AreNamedAsArguments(self):
        swing = prelight.builtin("swing")

        def refused(where, *parts, scene=self.room, **options):
            error = support.named(self, where, lambda: prelight.bake(scene, device=support.device(), **options), *parts)
            self.assertNotRegex(str(error), "Request|Keys::|Kind::")

        refused("vo_kind", "'nodes'", "material", vo=True, vo_kind="nodes")
        refused("near_lamps", "'many'", near_lamps="many")
        refused("encode", "expected a list", light_map=True, encode="sh-2")
        refused("light_group", "expected a mapping", light_group=["lamps"])
        refused("light_group", "expected a list", light_group={"lamps": "Lamp*"})
        refused("shadow_sets", "pairs", shadow_sets=["Room"], ao=True)
        refused("keys", "need an animation", sh=2, keys=3)
        refused("keys", "key_error", sh=2, animation=0, keys=3, key_error=0.1)
        refused("keys", "got 0", scene=swing, sh=2, rays=16, animation=0, keys=0)
        refused("animation", "SH", scene=swing, ao=True, rays=16, animation=0)
        refused("key_error", "got 5", scene=swing, sh=2, rays=16, animation=0, key_error=5)


if __name__ == "__main__":
    unittest.main()
