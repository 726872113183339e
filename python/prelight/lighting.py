"""Relighting of a bake."""

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from . import _native, basis
from .arguments import require
from .errors import InputError, UsageError


def relight(
    bake: _native.Bake,
    light: _native.Sky | NDArray[np.floating],
    *,
    technique: Literal["sh", "ch", "haar"] | None = None,
) -> NDArray[np.float32]:
    """Irradiance [vertex, rgb] of every vertex under light from far away, bounces included, W/m2. Exit radiance is albedo
    x irradiance / pi.

    `light` is a Sky or SH coefficients of radiance, [rgb, i], as from basis.sh_of_sky(); for wavelets it is a Sky or the
    texels of a cube map, [rgb, texel]. `technique` chooses one of the baked techniques; None means the first of them.
    """
    require(_native.Bake, "bake", bake, optional=False)
    names = ("sh", "ch", "haar")
    if technique is not None and technique not in names:
        raise UsageError("technique", f"got {technique!r}, expected one of {', '.join(names)}")
    baked = [name for name in names if getattr(bake, name) is not None]
    wanted = technique or (baked[0] if baked else "sh")
    if wanted not in baked:
        raise InputError("bake", f"it has no {wanted}, only {', '.join(baked) or 'none of ' + ', '.join(names)}",
                         f"bake(scene, {wanted}=4)")
    transfer = getattr(bake, wanted)
    if wanted == "haar":
        return transfer.irradiance(basis.haar_forward(_texels(light, transfer.face_size)))
    coefficients = _coefficients(light, transfer.order)
    return transfer.irradiance(basis.ch_moments(coefficients) if wanted == "ch" else coefficients)


def _coefficients(light, order):
    if isinstance(light, _native.Sky):
        return basis.sh_of_sky(light, order)
    coefficients = np.ascontiguousarray(light, dtype=np.float64)
    if coefficients.ndim != 2 or coefficients.shape[0] != 3 or coefficients.shape[1] < order**2:
        raise UsageError("light", f"got shape {coefficients.shape}, expected (3, {order**2}): SH of order {order}")
    return np.ascontiguousarray(coefficients[:, : order**2])


def _texels(light, face_size):
    if isinstance(light, _native.Sky):
        return basis.cube_of_sky(light, face_size)
    texels = np.ascontiguousarray(light, dtype=np.float32)
    if texels.shape != (3, 6 * face_size**2):
        raise UsageError("light", f"got shape {texels.shape}, expected (3, {6 * face_size**2}): faces of {face_size}")
    return texels
