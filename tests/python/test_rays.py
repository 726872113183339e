import unittest

import numpy as np
import support

import prelight


def rays(count, seed=1):
    random = np.random.default_rng(seed)
    directions = random.normal(size=(count, 3)).astype(np.float32)
    origins = (0.1 * random.normal(size=(count, 3)) + (0, 1, 0)).astype(np.float32)
    return origins, directions


class Rays(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.tracer = prelight.RayTracer(support.cornell(), support.device())

    def test_Hits_LieOnTheirTriangles(self):
        room = support.cornell()
        origins, directions = rays(20_000)
        hits = self.tracer.trace(origins, directions)
        self.assertEqual(len(hits), 20_000)
        found = hits.triangle >= 0
        self.assertTrue(0.5 < found.mean() < 1)  # The room is open at the front.
        self.assertTrue(np.isinf(hits.distance[~found]).all())
        units = directions / np.linalg.norm(directions, axis=1, keepdims=True)
        along = origins[found] + hits.distance[found, None] * units[found]
        weights = hits.weights[found]
        corners = (room.positions + np.array(room.origin, dtype=np.float32))[room.triangles[hits.triangle[found]]]
        inside = corners[:, 0] + np.einsum("rk,rkx->rx", weights, corners[:, 1:] - corners[:, :1])
        np.testing.assert_allclose(along, inside, atol=1e-4)

    def test_Members_ShareMemoryThatOutlivesTheHits(self):
        hits = self.tracer.trace(*rays(100))
        distance, triangle = hits.distance, hits.triangle
        self.assertFalse(distance.flags.owndata)
        self.assertEqual(triangle.ctypes.data - distance.ctypes.data, 4)
        kept = distance.copy()
        del hits, triangle
        np.testing.assert_array_equal(distance, kept)

    def test_Blocked_AgreesWithTheClosestHit(self):
        origins, directions = rays(5_000, 2)
        farthest = np.full(5_000, 0.8, dtype=np.float32)
        blocked = self.tracer.blocked(origins, directions, farthest)
        self.assertEqual(blocked.dtype, bool)
        np.testing.assert_array_equal(blocked, self.tracer.trace(origins, directions).distance <= 0.8)

    def test_TraceOfAScene_IsThatOfATracer(self):
        origins, directions = rays(1_000, 3)
        once = prelight.trace(support.cornell(), origins, directions, device=support.device())
        np.testing.assert_array_equal(once.triangle, self.tracer.trace(origins, directions).triangle)

    def test_NoRays_HaveNoHits(self):
        none = np.zeros((0, 3), dtype=np.float32)
        self.assertEqual(len(self.tracer.trace(none, none)), 0)
        self.assertEqual(self.tracer.trace(none, none).weights.shape, (0, 2))

    def test_BadRays_AreNamed(self):
        origins, directions = rays(10)
        trace = self.tracer.trace
        support.named(self, "origins", lambda: trace(origins.astype(np.float64), directions), "got float64", "float32")
        support.named(self, "directions", lambda: trace(origins, directions[:, ::-1]), "not C-contiguous")
        support.named(self, "directions", lambda: trace(origins, directions[:5]), "got 5", "10")
        support.named(self, "farthest", lambda: trace(origins, directions, np.ones(9, dtype=np.float32)), "got 9")
        support.named(self, "origins", lambda: trace(origins[0], directions), "(3,)", "(n, 3)")
        support.named(self, "directions", lambda: trace(origins[:0], directions), "got 10", "0")
        support.named(self, "origins", lambda: trace("origins", directions), "got str")
        directions[4] = 0
        support.named(self, "Ray 4", lambda: trace(origins, directions), "direction")
        origins[3, 1] = np.nan
        support.named(self, "Ray 3", lambda: trace(origins, directions), "finite")


if __name__ == "__main__":
    unittest.main()
