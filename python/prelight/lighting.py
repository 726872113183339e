"""Relighting of a bake."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native, basis
from .arguments import require
from .errors import InputError, UsageError, in_python


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


@dataclass(frozen=True)
class DistantLight:
    """A round light far away with the same radiance everywhere, such as the sun: `towards` [xyz], the direction of its
    centre, of any length but 0; `irradiance` [rgb] on a surface that faces it, W/m2; `half_angle` in radians, 0 for one
    direction (the sun has 0.00465). Vector occluders take all lights as points. SH
    and CH know a light by its bands alone: an open receiver that faces it gets 0.75 of its irradiance at order 2, 1.06 at
    orders 3 and 4, 0.97 at 5 and 6. A Relighter that has the scene gives vertices in the open exactly what it is."""

    towards: Sequence[float]
    irradiance: Sequence[float] = (1.0, 1.0, 1.0)
    half_angle: float = 0.0


class Relighter:
    """Relights a bake on an OpenCL device, where its transfer stays, as often as lights change.

    `technique` is one of "animation" (its keys), "sh", "ch", "haar", "vector_occluders", "texels", "volume",
    "light_groups"; None means the preferred one that was baked. Receivers are vertices, texels of charts
    [map, row, column] or cells of the volume [z, y, x].
    `wavelets` is the number of coefficients that a light keeps with "haar"; 0 means all. Vector occluders need the `scene`,
    and represent a sky by `sky_lights` directional lights; with "sh" and "ch" the scene makes distant lights exact in the
    open, and light() reads the transfer once per light.
    """

    def __init__(
        self,
        bake: _native.Bake,
        *,
        technique: str | None = None,
        wavelets: int = 0,
        sky_lights: int = 32,
        scene: _native.Scene | None = None,
        device: _native.Device | None = None,
    ) -> None:
        require(_native.Bake, "bake", bake, optional=False)
        require(_native.Scene, "scene", scene)
        require(_native.Device, "device", device)
        self._native = _native._Relighter(bake, device or _native.Device(), technique or "", wavelets, sky_lights, scene)

    def __len__(self) -> int:
        """Number of receivers."""
        return self._native.count

    @property
    def technique(self) -> str:
        """The technique whose transfer was chosen."""
        return self._native.technique

    @property
    def reason(self) -> str:
        """Which technique was chosen and why, the form of its transfer on the device, and what else was baked."""
        return in_python(self._native.reason)

    @property
    def bytes_moved(self) -> int:
        """Bytes that one relighting under the present light reads and writes."""
        return self._native.bytes_moved

    def light(
        self,
        sky: _native.Sky | None = None,
        *,
        lights: Sequence[DistantLight] = (),
        coefficients: ArrayLike | None = None,
        rotation: ArrayLike | None = None,
        groups: ArrayLike | None = None,
    ) -> None:
        """Sets the light: the sum of a sky, distant lights and further radiance in SH, `coefficients` [rgb, i] of any
        order, all turned by `rotation`, a 3 x 3 matrix R: f'(w) = f(R^-1 w). `groups` [group, rgb] are colours of the
        scene's own lights, where these were baked (bake.light_groups); None turns them off."""
        require(_native.Sky, "sky", sky)
        distant = (
            _rows(light.towards for light in lights),
            _rows(light.irradiance for light in lights),
            np.array([light.half_angle for light in lights], dtype=np.float64),
        )
        further = None if coefficients is None else np.ascontiguousarray(coefficients, dtype=np.float64)
        colors = None if groups is None else np.ascontiguousarray(groups, dtype=np.float32)
        self._native.light(sky, distant, further, _turn(rotation), colors)

    def set_time(self, seconds: float) -> None:
        """Sets the moment, s, of the animation whose keys are relit."""
        self._native.set_time(seconds)

    def radiance(self, out: NDArray[np.float32] | None = None) -> NDArray[np.float32]:
        """Radiance before albedo of every receiver [receiver, rgb], W/(m2 sr), under the present light: exit radiance is
        albedo x this, and irradiance, which relight() returns, is pi x this. `out`, C-contiguous, receives it where
        given, which saves memory per frame."""
        if out is None:
            return self._native.radiance()
        expected = (len(self), 3)
        if not isinstance(out, np.ndarray) or out.dtype != np.float32 or out.shape != expected:
            got = f"{out.dtype} of shape {out.shape}" if isinstance(out, np.ndarray) else repr(out)
            raise UsageError("out", f"got {got}, expected float32 of shape {expected}")
        if not (out.flags.c_contiguous and out.flags.writeable):
            raise UsageError("out", "got an array that is not C-contiguous or not writeable")
        self._native.radiance_into(out)
        return out


class SkyProjector:
    """Projects skies of one size on an OpenCL device, for skies that change every frame. `sky` is the first one; `order`
    is the number of bands, 1 to 32."""

    def __init__(self, sky: _native.Sky, order: int, *, device: _native.Device | None = None) -> None:
        require(_native.Sky, "sky", sky, optional=False)
        require(_native.Device, "device", device)
        self._native = _native._SkyProjector(device or _native.Device(), sky, order)

    def set_sky(self, sky: _native.Sky) -> None:
        """Replaces the sky by another one of the same size."""
        require(_native.Sky, "sky", sky, optional=False)
        self._native.set_sky(sky)

    def sh(self, rotation: ArrayLike | None = None) -> NDArray[np.float64]:
        """SH coefficients [rgb, i] of the sky's radiance, turned by a 3 x 3 matrix, as basis.sh_of_sky() gives them."""
        return self._native.sh(_turn(rotation))

    def haar(self, size: int, *, samples: int = 8, rotation: ArrayLike | None = None) -> NDArray[np.float32]:
        """Wavelet coefficients [rgb, i] of the turned sky on a cube map with faces of `size` texels, from samples x
        samples points per texel, 1 to 64 each."""
        return self._native.wavelets(size, samples, _turn(rotation))


def _rows(vectors):
    return np.array([basis._vector(vector, "lights") for vector in vectors], dtype=np.float64).reshape(-1, 3)


def _turn(rotation):
    return basis._matrix(np.eye(3) if rotation is None else rotation)
