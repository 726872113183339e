import unittest

import numpy as np
import support

import prelight
from prelight import basis

# The golden vector of docs/conventions.md.
GOLDEN = [
    0.282094791774,
    0.261169028265,
    0.391753542398,
    0.130584514133,
    0.156078347227,
    0.468235041682,
    0.292863596306,
    0.234117520841,
    -0.117058760421,
]


def quarter_turn():
    """A rotation about z by which x becomes y."""
    return np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])


class Harmonics(unittest.TestCase):
    def test_GoldenDirection_HasTheValuesOfTheConventions(self):
        np.testing.assert_allclose(basis.sh_values((1, 2, 3), 3), GOLDEN, atol=1e-11)
        self.assertEqual(basis.sh_values(np.ones((2, 5, 3)), 4).shape, (2, 5, 16))

    def test_Projection_GivesAFunctionsCoefficientsBack(self):
        coefficients = np.sin(np.arange(16.0))
        found = basis.sh_project(lambda w: basis.sh_values(w, 4) @ coefficients, 4, degree=3)
        np.testing.assert_allclose(found, coefficients, atol=1e-12)
        two = basis.sh_project(lambda w: np.stack([w[:, 0], w[:, 2]], axis=1), 2, degree=1)
        np.testing.assert_allclose(two, np.sqrt(4 * np.pi / 3) * np.array([[0, 0, 0, 1], [0, 0, 1, 0]]), atol=1e-12)

    def test_RotatedFunction_HasAtTheRotatedDirectionWhatItHad(self):
        functions = np.cos(np.arange(18.0)).reshape(2, 9)
        at = np.array((0.3, -0.5, 0.7))
        for values, rotate in ((basis.sh_values, basis.rotate_sh), (basis.ch_values, basis.rotate_ch)):
            rotated = rotate(functions, quarter_turn())
            np.testing.assert_allclose(rotated @ values(quarter_turn() @ at, 3), functions @ values(at, 3), atol=1e-12)

    def test_Ch_IsTheSameFunctionAsSh(self):
        sh = np.sin(np.arange(25.0))
        ch = basis.ch_from_sh(sh)
        np.testing.assert_allclose(basis.sh_from_ch(ch), sh, atol=1e-12)
        at = (0.1, 0.9, -0.3)
        np.testing.assert_allclose(basis.ch_values(at, 5) @ ch, basis.sh_values(at, 5) @ sh, atol=1e-12)
        np.testing.assert_allclose(ch @ basis.ch_moments(sh), sh @ sh, atol=1e-11)

    def test_EvenSky_IsItsMean(self):
        light = basis.sh_of_sky(prelight.constant_sky((1, 2, 3)), 3)
        np.testing.assert_allclose(light[:, 0], np.sqrt(4 * np.pi) * np.array((1, 2, 3)), rtol=1e-9)
        np.testing.assert_allclose(light[:, 1:], 0, atol=1e-9)

    def test_Products_AreProductsOfValues(self):
        f, g = np.sin(np.arange(9.0)), np.cos(np.arange(4.0))
        at = np.array([(0.6, 0.0, 0.8), (0.0, -1.0, 0.0), (0.3, 0.4, -0.5)])
        right = (basis.sh_values(at, 3) @ f) * (basis.sh_values(at, 2) @ g)
        np.testing.assert_allclose(basis.sh_values(at, 4) @ basis.sh_product(f, g), right, atol=1e-12)
        high = np.cos(np.arange(20.0**2))
        np.testing.assert_array_equal(basis.sh_product(high, f), basis.sh_product(high, f, order=22))
        self.assertEqual(basis.sh_product(np.cos(np.arange(31.0**2)), f).shape, (32**2,))
        support.named(self, "product", lambda: basis.sh_product(f, g, order=0))
        cut = basis.sh_product(f, g, order=2)
        np.testing.assert_allclose(basis.sh_product_matrix(f, 2) @ g, cut, atol=1e-12)
        indices, values = basis.triple_products(2, 3)
        dense = np.zeros((4, 4, 9))
        for (i, j, k), value in zip(indices, values):
            dense[i, j, k] = dense[j, i, k] = value
        np.testing.assert_allclose(np.einsum("ijk,j,k->i", dense, g, f), cut, atol=1e-12)

    def test_ZonalFunctions_AreProjectionsAboutTheirAxis(self):
        axis = np.array((0.0, 0.6, 0.8))
        lobe = basis.sh_project(lambda w: 5 / (2 * np.pi) * np.maximum(w @ axis, 0) ** 4, 4, degree=400)
        np.testing.assert_allclose(basis.rotate_zonal(basis.zonal_cosine_power(4, 4), 3 * axis), lobe, atol=1e-5)
        cap = basis.rotate_zonal(basis.zonal_cap(0.5, 4), axis)
        np.testing.assert_allclose(cap, basis.sh_of_cap(axis, 0.5, 4), atol=1e-12)
        even = basis.sh_of_sky(prelight.constant_sky((1, 2, 3)), 3)
        np.testing.assert_allclose(basis.convolve_sh(even, basis.zonal_clamped_cosine(3)), even, atol=1e-12)

    def test_LightsWithASize_HaveTheirSolidAngle(self):
        solid = np.sqrt(4 * np.pi)  # the first coefficient x this is the solid angle
        for light, angle in (
            (basis.sh_of_sphere((0, 0, 4), 2, 3), 2 * np.pi * (1 - np.cos(np.pi / 6))),
            (basis.sh_of_disk((0, 0, 1), (0, 0, 1), 1, 3), 2 * np.pi * (1 - np.sqrt(0.5))),
            (basis.sh_of_polygon([(1, -1, 1), (1, 1, 1), (-1, 1, 1), (-1, -1, 1)], 3), 4 * np.pi / 6),
            (basis.sh_of_point((0, 2, 0), 3), 0.25),
            (basis.sh_of_direction((0, 2, 0), 3), 1.0),
        ):
            self.assertAlmostEqual(light[0] * solid, angle, places=9)

    def test_DominantLights_OfOneSun_AreThatSun(self):
        towards = np.array((0.6, 0.0, -0.8))
        radiance = np.outer((3.0, 2.0, 1.0), basis.sh_of_direction(towards, 4))
        found, irradiance, rest = basis.dominant_lights(radiance, most=2)
        np.testing.assert_allclose(found[0], towards, atol=1e-6)
        np.testing.assert_allclose(irradiance[0], (3, 2, 1), atol=1e-5)
        np.testing.assert_allclose(rest, 0, atol=1e-5)

    def test_BadArguments_AreNamed(self):
        support.named(self, "coefficients", lambda: basis.rotate_sh(np.zeros(8), np.eye(3)), "got 8")
        support.named(self, "rotation", lambda: basis.rotate_sh(np.zeros(9), np.eye(4)), "(4, 4)")
        support.named(self, "", lambda: basis.rotate_sh(np.full(9, np.nan), np.eye(3)), "finite")
        support.named(self, "", lambda: basis.rotate_sh(np.zeros(9), 2 * np.eye(3)))
        support.named(self, "directions", lambda: basis.sh_values(np.ones((3, 2)), 3), "(3, 2)")
        support.named(self, "", lambda: basis.sh_values((0, 0, 0), 3), "direction 0")
        support.named(self, "", lambda: basis.sh_values((0, 0, 1), 33))


class Wavelets(unittest.TestCase):
    def test_ForwardAndInverse_GiveTheMapBack(self):
        maps = np.random.default_rng(5).random((2, 6 * 8 * 8), dtype=np.float32)
        coefficients = basis.haar_forward(maps)
        np.testing.assert_allclose((coefficients**2).sum(), (maps**2).sum(), rtol=1e-5)
        np.testing.assert_allclose(basis.haar_inverse(coefficients), maps, atol=1e-5)

    def test_KeptCoefficients_MakeNoMoreThanTheError(self):
        coefficients = basis.haar_forward(np.linspace(0, 1, 6 * 16 * 16))
        kept = basis.haar_kept(coefficients, 0.05)
        few = np.zeros_like(coefficients)
        few[kept] = coefficients[kept]
        left = np.linalg.norm(few - coefficients) / np.linalg.norm(coefficients)
        self.assertLessEqual(left, 0.05)
        self.assertLess(len(kept), len(coefficients) / 2)

    def test_QuarterTurn_MovesAFace(self):
        map = np.zeros(24)
        map[:4] = 1  # Face +X.
        turned = basis.rotate_cube(map, quarter_turn())
        np.testing.assert_allclose(turned[8:12], 1, atol=1e-6)  # Face +Y.
        np.testing.assert_allclose(turned.sum(), 4, atol=1e-5)

    def test_CubeOfASky_KeepsItsMean(self):
        cube = basis.cube_of_sky(prelight.constant_sky((1, 2, 3)), 4)
        np.testing.assert_allclose(cube, np.tile([[1], [2], [3]], 96), rtol=1e-5)
        directions = basis.cube_directions(4)
        np.testing.assert_allclose(np.linalg.norm(directions, axis=1), 1)
        self.assertTrue((directions[:16, 0] > 0.5).all())

    def test_BadMaps_AreNamed(self):
        support.named(self, "maps", lambda: basis.haar_forward(np.zeros(23)), "got 23")
        support.named(self, "", lambda: basis.haar_forward(np.zeros(6 * 9)), "3")
        support.named(self, "", lambda: basis.haar_kept(np.zeros(24), 2.0), "2")


if __name__ == "__main__":
    unittest.main()
