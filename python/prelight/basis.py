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
