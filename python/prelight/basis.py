"""Functions of directions: spherical harmonics (SH), "cpherical harmonics" (CH) and Haar wavelets on cube maps.

Axes, signs and indices are those of docs/conventions.md: real, orthonormal, i = l (l + 1) + m, polar axis z. Order n
means bands 0 to n - 1. Coefficients are arrays whose last axis is i; the axes before it count functions. Everything is
computed in double precision, whatever the type of the arguments.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from .errors import UsageError

_SH, _CH = _native._HarmonicBasis.sh, _native._HarmonicBasis.ch


def order_of(coefficients: ArrayLike) -> int:
    """The order of coefficients."""
    count = np.shape(coefficients)[-1] if np.ndim(coefficients) > 0 else 0
    order = int(round(count**0.5))
    if order < 1 or order * order != count:
        raise UsageError("coefficients", f"got {count} of them, expected a square number, order^2")
    return order


def _mapped(coefficients, function):
    order = order_of(coefficients)
    given = np.ascontiguousarray(coefficients, dtype=np.float64)
    return function(given.reshape(-1, order * order), order).reshape(given.shape)


def _values(kind, directions, order):
    given = np.ascontiguousarray(directions, dtype=np.float64)
    if given.ndim == 0 or given.shape[-1] != 3:
        raise UsageError("directions", f"got shape {given.shape}, expected (..., 3)")
    return _native._basis_values(kind, given.reshape(-1, 3), order).reshape(*given.shape[:-1], order * order)


def _matrix(rotation):
    matrix = np.asarray(rotation, dtype=np.float64)
    if matrix.shape != (3, 3):
        raise UsageError("rotation", f"got shape {matrix.shape}, expected (3, 3)")
    return matrix.tolist()


def sh_values(directions: ArrayLike, order: int) -> NDArray[np.float64]:
    """Values [..., i] of all SH functions in directions [..., xyz] of any length but 0."""
    return _values(_SH, directions, order)


def ch_values(directions: ArrayLike, order: int) -> NDArray[np.float64]:
    """Values [..., i] of all CH functions in directions [..., xyz] of any length but 0."""
    return _values(_CH, directions, order)


def sphere_rule(degree: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Unit directions [n, xyz] and weights [n] that integrate polynomials of a degree over the sphere exactly."""
    return _native._sphere_rule(degree)


def sh_project(function: Callable[[NDArray[np.float64]], ArrayLike], order: int, degree: int) -> NDArray[np.float64]:
    """SH coefficients, [i] or [channel, i], of a function of directions [n, xyz] with values [n] or [n, channel]. They
    are exact if the function is a polynomial of `degree`."""
    directions, weights = sphere_rule(degree + order - 1)
    values = np.asarray(function(directions), dtype=np.float64)
    if values.shape[:1] != weights.shape:
        raise UsageError("function", f"it returned shape {values.shape}, expected {weights.shape[0]} values")
    return np.tensordot(values.T, weights[:, None] * sh_values(directions, order), axes=1)


def sh_of_sky(sky: _native.Sky, order: int) -> NDArray[np.float64]:
    """SH coefficients [rgb, i] of a sky's radiance, exact for texels of constant radiance."""
    return _native._project_sky(sky, order)


def rotate_sh(coefficients: ArrayLike, rotation: ArrayLike) -> NDArray[np.float64]:
    """SH coefficients of the rotated function f'(w) = f(R^-1 w)."""
    matrix = _matrix(rotation)
    return _mapped(coefficients, lambda rows, order: _native._rotate_harmonics(_SH, rows, order, matrix))


def rotate_ch(coefficients: ArrayLike, rotation: ArrayLike) -> NDArray[np.float64]:
    """CH coefficients of the rotated function f'(w) = f(R^-1 w)."""
    matrix = _matrix(rotation)
    return _mapped(coefficients, lambda rows, order: _native._rotate_harmonics(_CH, rows, order, matrix))


def ch_from_sh(coefficients: ArrayLike) -> NDArray[np.float64]:
    """CH coefficients a of a function with SH coefficients y: sum a_i C_i = sum y_i Y_i."""
    return _mapped(coefficients, _native._ch_from_sh)


def sh_from_ch(coefficients: ArrayLike) -> NDArray[np.float64]:
    """SH coefficients of a function with these CH coefficients."""
    return _mapped(coefficients, _native._sh_from_ch)


def ch_moments(coefficients: ArrayLike) -> NDArray[np.float64]:
    """Moments <f, C_i> of a function given in SH. Light has this form for transfer in CH."""
    return _mapped(coefficients, _native._ch_moments)


def sh_product(f: ArrayLike, g: ArrayLike, order: int | None = None) -> NDArray[np.float64]:
    """The first `order` bands [i] of the product of two functions [i] in SH, exactly. None means all that
    it has, f + g - 1 for functions of f and g bands, but at most 32."""
    f_order, g_order = order_of(f), order_of(g)
    if order is None:
        order = min(f_order + g_order - 1, 32)
    return _native._multiply_sh(_list(f), f_order, _list(g), g_order, order)


def sh_product_matrix(f: ArrayLike, order: int) -> NDArray[np.float64]:
    """The symmetric matrix [i, j] that multiplies functions of `order` bands by a function [i], cut to these bands."""
    return _native._product_matrix(_list(f), order_of(f), order)


def triple_products(order: int, k_order: int) -> tuple[NDArray[np.uint32], NDArray[np.float64]]:
    """Indices [n, ijk] and values [n] of all integrals of Y_i Y_j Y_k that are not 0, with i <= j < order^2 and
    k < k_order^2."""
    return _native._triple_products(order, k_order)


def zonal_clamped_cosine(order: int) -> NDArray[np.float64]:
    """Zonal coefficients [l] of max(cos, 0) / pi, the transfer of an open receiver. A zonal function depends on the angle
    to an axis alone; z_l is the integral of the function about z times Y_l0."""
    return _native._zonal_clamped_cosine(order)


def zonal_cap(half_angle: float, order: int) -> NDArray[np.float64]:
    """Zonal coefficients [l] of the function that is 1 within `half_angle` radians of the axis and 0 elsewhere."""
    return _native._zonal_cap(half_angle, order)


def zonal_cosine_power(exponent: float, order: int) -> NDArray[np.float64]:
    """Zonal coefficients [l] of the lobe (exponent + 1) / (2 pi) max(cos, 0)^exponent, whose integral is 1."""
    return _native._zonal_cosine_power(exponent, order)


def rotate_zonal(zonal: ArrayLike, axis: ArrayLike) -> NDArray[np.float64]:
    """SH coefficients [i] of a zonal function [l] about an axis [xyz] of any length but 0."""
    return _native._rotate_zonal(_list(zonal), _vector(axis, "axis"))


def convolve_sh(coefficients: ArrayLike, zonal: ArrayLike) -> NDArray[np.float64]:
    """Functions [..., i] in SH convolved with a zonal function [l] of as many bands. Radiance with
    zonal_clamped_cosine() is irradiance over pi by the normal."""
    bands = _list(zonal)
    given = np.ascontiguousarray(coefficients, dtype=np.float64)
    if order_of(given) != len(bands):
        raise UsageError("zonal", f"got {len(bands)} bands, expected those of the coefficients: {order_of(given)}")
    return _native._convolve_sh(given.reshape(-1), bands).reshape(given.shape)


def sh_of_direction(towards: ArrayLike, order: int) -> NDArray[np.float64]:
    """SH coefficients [i] of radiance from one direction [xyz], of 1 W/m2 on a surface that faces it."""
    return _native._sh_of_direction(_vector(towards, "towards"), order)


def sh_of_point(position: ArrayLike, order: int) -> NDArray[np.float64]:
    """SH coefficients [i] of a point light of 1 W/sr at a position [xyz], m, relative to where its light arrives."""
    return _native._sh_of_point(_vector(position, "position"), order)


def sh_of_cap(towards: ArrayLike, half_angle: float, order: int) -> NDArray[np.float64]:
    """SH coefficients [i] of radiance 1 within `half_angle` radians of a direction [xyz]."""
    return _native._sh_of_cap(_vector(towards, "towards"), half_angle, order)


def sh_of_sphere(centre: ArrayLike, radius: float, order: int) -> NDArray[np.float64]:
    """SH coefficients [i] of a sphere of radiance 1; `centre` [xyz] and `radius` in m, relative to where its light
    arrives."""
    return _native._sh_of_sphere(_vector(centre, "centre"), radius, order)


def sh_of_disk(centre: ArrayLike, normal: ArrayLike, radius: float, order: int) -> NDArray[np.float64]:
    """SH coefficients [i] of a flat round disk of radiance 1 on both sides; `centre` [xyz] and `radius` in m, relative to
    where its light arrives."""
    return _native._sh_of_disk(_vector(centre, "centre"), _vector(normal, "normal"), radius, order)


def sh_of_polygon(vertices: ArrayLike, order: int) -> NDArray[np.float64]:
    """SH coefficients [i] of a polygon of radiance 1 on both sides, of less than 2 pi sr; `vertices` [vertex, xyz] in m,
    in order, relative to where its light arrives."""
    return _native._sh_of_polygon(np.ascontiguousarray(vertices, dtype=np.float64), order)


def dominant_lights(
    radiance: ArrayLike, most: int = 1
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """At most `most` directional lights that stand for radiance [rgb, i] in SH: unit directions [light, xyz], irradiance
    on surfaces that face them [light, rgb], W/m2, the brightest first, and the radiance that they leave [rgb, i]."""
    return _native._dominant_lights(np.ascontiguousarray(radiance, dtype=np.float64), order_of(radiance), most)


def _list(values):
    return np.ascontiguousarray(values, dtype=np.float64).reshape(-1)


def _vector(vector, name):
    given = np.asarray(vector, dtype=np.float64)
    if given.shape != (3,):
        raise UsageError(name, f"got shape {given.shape}, expected (3,)")
    return given.tolist()


def _face_size(texels):
    size = int(round((texels / 6) ** 0.5))
    if 6 * size * size != texels:
        raise UsageError("maps", f"got {texels} values per map, expected 6 faces of size x size")
    return size


def _maps(maps, function):
    given = np.ascontiguousarray(maps, dtype=np.float32)
    if given.ndim == 0:
        raise UsageError("maps", "got a number, expected (..., 6 size^2) values")
    size = _face_size(given.shape[-1])
    return function(given.reshape(-1, given.shape[-1]), size).reshape(given.shape)


def haar_forward(maps: ArrayLike) -> NDArray[np.float32]:
    """Wavelet coefficients of cube maps [..., texel], in float32."""
    return _maps(maps, _native._haar_forward)


def haar_inverse(coefficients: ArrayLike) -> NDArray[np.float32]:
    """Cube maps [..., texel] from their wavelet coefficients, in float32."""
    return _maps(coefficients, _native._haar_inverse)


def haar_kept(coefficients: NDArray[np.float32], error: float) -> NDArray[np.uint32]:
    """Indices of the fewest coefficients whose relative L2 error is at most `error`."""
    return _native._haar_kept(np.ascontiguousarray(coefficients, dtype=np.float32), error)


def cube_of_sky(sky: _native.Sky, size: int) -> NDArray[np.float32]:
    """A sky as a cube map [rgb, texel] of mean radiance."""
    return np.ascontiguousarray(_native._cube_of_sky(sky, size).T)


def cube_directions(size: int) -> NDArray[np.float64]:
    """Unit directions [texel, xyz] of the texels' centres."""
    return _native._cube_directions(size)


def rotate_cube(maps: ArrayLike, rotation: ArrayLike) -> NDArray[np.float32]:
    """Cube maps [..., texel] of the rotated functions, as means over texels, which preserves flux."""
    matrix = _matrix(rotation)
    return _maps(maps, lambda rows, size: _native._rotate_cube(rows, size, matrix))
