"""Baking a scene."""

import inspect
import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from . import _native
from .arguments import Progress, fill


#: What bake() is given besides a request.
_NOT_OF_REQUESTS = ("scene", "device", "progress", "checkpoint")


def _request(arguments: Mapping[str, Any]) -> Any:
    options = {name: value for name, value in arguments.items() if name not in _NOT_OF_REQUESTS}
    return fill(_native._BakeRequest(), **options)


def bake(
    scene: _native.Scene,
    *,
    ao: bool = False,
    cones: bool = False,
    horizons: int = 0,
    sh: int = 0,
    ch: int = 0,
    haar: int = 0,
    haar_error: float = 0.02,
    glossy: int = 0,
    light_groups: bool = False,
    radiosity: bool = False,
    patch_size: float = 0.0,
    light_map: bool = False,
    texel_size: float = 0.0,
    denoise: bool = False,
    caustics: bool = False,
    photons: int = 0,
    sky: _native.Sky | None = None,
    sky_rotation: float = 0.0,
    bounces: int = 0,
    specular: bool = False,
    subsurface: bool = False,
    nearest: float = 0.0,
    farthest: float = 0.0,
    rays: int = 1024,
    error: float | None = None,
    seconds: float | None = None,
    seed: int = 0,
    max_memory: int | None = None,
    device: _native.Device | None = None,
    progress: Progress | None = None,
    checkpoint: str | os.PathLike[str] = "",
) -> _native.Bake:
    """Bakes what is asked for, at every vertex; the interpreter is free for other threads meanwhile.

    What is asked for: `ao` (ambient occlusion and bent normals; `cones`: their openings), `horizons` (sectors), transfer
    in `sh`, `ch` (orders) or `haar` wavelets (size of the cube's faces; `haar_error`: relative error that leaving some
    out may make), `glossy` (order of matrices), `light_groups`, and light of the scene's own lights under a `sky`: by
    `radiosity` at vertices or as a `light_map` (`denoise`: by Open Image Denoise, which must be there).
    `rays` a vertex on average, or until the standard `error` of ambient occlusion or so many `seconds`.
    `progress` is told of stages. Ctrl-C and what it raises end the bake; with a `checkpoint` the same call goes on from
    there.
    """
    return _native._bake(scene, _request(locals()), device, progress, os.fspath(checkpoint))


@dataclass(frozen=True)
class Plan:
    """What a bake would do: (name, whether it runs, why) of every pass, and bytes."""

    passes: list[tuple[str, bool, str]]
    host_bytes: int
    device_bytes: int


def plan(scene: _native.Scene, **options: Any) -> Plan:
    """What bake() would do with these options."""
    known = inspect.signature(bake)
    known = known.replace(parameters=[p for p in known.parameters.values() if p.name not in _NOT_OF_REQUESTS])
    request = known.bind(**options)
    request.apply_defaults()
    return Plan(*_native._plan(scene, _request(request.arguments)))
