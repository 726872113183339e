"""Functions of directions: spherical harmonics (SH), "cpherical harmonics" (CH) and Haar wavelets on cube maps.

Axes, signs and indices are those of docs/conventions.md: real, orthonormal, i = l (l + 1) + m, polar axis z. Order n
means bands 0 to n - 1. Coefficients are arrays whose last axis is i; those before it are as many functions. They are
computed in double precision, whatever is given.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from .errors import UsageError

_SH, _CH = _native._HarmonicBasis.sh, _native._HarmonicBasis.ch


def order_of(coefficients: ArrayLike) -> int:
    """The order that coefficients are of."""
    count = np.shape(coefficients)[-1] if np.ndim(coefficients) > 0 else 0
    order = int(round(count**0.5))
    if order < 1 or order * order != count:
        raise UsageError("coefficients", f"got {count}, expected a square number of them: order^2")
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
    """Values of all functions in directions [..., xyz] of any length but 0: [..., i]."""
    return _values(_SH, directions, order)


def ch_values(directions: ArrayLike, order: int) -> NDArray[np.float64]:
    """The same of CH."""
    return _values(_CH, directions, order)


def sphere_rule(degree: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Unit directions [n, xyz] and weights [n] that integrate polynomials of a degree over the sphere without error."""
    return _native._sphere_rule(degree)


def sh_project(function: Callable[[NDArray[np.float64]], ArrayLike], order: int, degree: int) -> NDArray[np.float64]:
    """SH coefficients of a function of directions [n, xyz] with values [n] or [n, channel]: [i] or [channel, i]. Exact
    where the function is a polynomial of `degree`."""
    directions, weights = sphere_rule(degree + order - 1)
    values = np.asarray(function(directions), dtype=np.float64)
    if values.shape[:1] != weights.shape:
        raise UsageError("function", f"it gave shape {values.shape}, expected {weights.shape[0]} values")
    return np.tensordot(values.T, weights[:, None] * sh_values(directions, order), axes=1)


def sh_of_sky(sky: _native.Sky, order: int) -> NDArray[np.float64]:
    """SH coefficients of a sky's radiance, [rgb, i], exact for texels of constant radiance."""
    return _native._project_sky(sky, order)


def rotate_sh(coefficients: ArrayLike, rotation: ArrayLike) -> NDArray[np.float64]:
    """Coefficients of the rotated function f'(w) = f(R^-1 w)."""
    matrix = _matrix(rotation)
    return _mapped(coefficients, lambda rows, order: _native._rotate_harmonics(_SH, rows, order, matrix))


def rotate_ch(coefficients: ArrayLike, rotation: ArrayLike) -> NDArray[np.float64]:
    """The same of CH."""
    matrix = _matrix(rotation)
    return _mapped(coefficients, lambda rows, order: _native._rotate_harmonics(_CH, rows, order, matrix))


def ch_from_sh(coefficients: ArrayLike) -> NDArray[np.float64]:
    """CH coefficients a of the same function: sum a_i C_i = sum y_i Y_i."""
    return _mapped(coefficients, _native._ch_from_sh)


def sh_from_ch(coefficients: ArrayLike) -> NDArray[np.float64]:
    """And back."""
    return _mapped(coefficients, _native._sh_from_ch)


def ch_moments(coefficients: ArrayLike) -> NDArray[np.float64]:
    """Moments <f, C_i> of a function that is given in SH: what light is for transfer in CH."""
    return _mapped(coefficients, _native._ch_moments)


def _face_size(texels):
    size = int(round((texels / 6) ** 0.5))
    if 6 * size * size != texels:
        raise UsageError("maps", f"got {texels} values a map, expected 6 faces of size x size")
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
    """And back."""
    return _maps(coefficients, _native._haar_inverse)


def haar_kept(coefficients: NDArray[np.float32], error: float) -> NDArray[np.uint32]:
    """Indices of the fewest coefficients whose relative L2 error is at most `error`."""
    return _native._haar_kept(np.ascontiguousarray(coefficients, dtype=np.float32), error)


def cube_of_sky(sky: _native.Sky, size: int) -> NDArray[np.float32]:
    """A sky as mean radiance of the texels of a cube map: [rgb, texel]."""
    return np.ascontiguousarray(_native._cube_of_sky(sky, size).T)


def cube_directions(size: int) -> NDArray[np.float64]:
    """Unit directions of the texels' centres, [texel, xyz]."""
    return _native._cube_directions(size)


def rotate_cube(maps: ArrayLike, rotation: ArrayLike) -> NDArray[np.float32]:
    """Cube maps [..., texel] of the rotated function, as means over texels: keeps flux."""
    matrix = _matrix(rotation)
    return _maps(maps, lambda rows, size: _native._rotate_cube(rows, size, matrix))
