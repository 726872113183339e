"""Baking a scene."""

import inspect
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Literal

from . import _native
from .arguments import Progress, exclusive, fill, known_name, require, require_run
from .errors import UsageError


# : Arguments of bake() that are not part of a request.
_NOT_OF_REQUESTS = ("scene", "device", "progress", "checkpoint", "animation", "keys", "key_error")


def _names(argument: str, names: Any) -> list[str]:
    """A list of names. A single name is refused, because it would be taken for a list of letters."""
    if isinstance(names, str) or not all(isinstance(name, str) for name in names):
        raise UsageError(argument, f"got {names!r}, expected a list of names")
    return list(names)


def _pair(names: Any) -> tuple[list[str], list[str]]:
    if isinstance(names, str) or len(names) != 2:
        raise UsageError("shadow_sets", f"got {names!r}, expected pairs of lists: receivers and occluders")
    return _names("shadow_sets", names[0]), _names("shadow_sets", names[1])


def _keys(animation: str | int | None, keys: int | None, key_error: float | None) -> Any:
    if animation is None:
        given = "keys" if keys is not None else "key_error" if key_error is not None else None
        if given:
            raise UsageError(given, "keys need an animation, and none is named", "give animation")
        return None
    exclusive(keys=keys, key_error=key_error)
    options = {"animation": str(animation), "key_error": key_error}
    return fill(_native._AnimationKeys(), **options, **({} if keys is None else {"keys": keys}))


def _request(arguments: Mapping[str, Any]) -> Any:
    options = {name: value for name, value in arguments.items() if name not in _NOT_OF_REQUESTS}
    further = options.pop("further", {})
    known_name("bake", further, _taken())
    options.update(further)
    exclusive(**{name: options[name] for name in ("rays", "error", "seconds")})
    if options["rays"] is None:
        del options["rays"]
    require(_native.Sky, "sky", options["sky"])
    options["encode"] = _names("encode", options["encode"])
    groups = options["light_group"]
    if not isinstance(groups, Mapping):
        raise UsageError("light_group", f"got {groups!r}, expected a mapping from names to lists of patterns")
    options["light_group"] = [(name, _names("light_group", patterns)) for name, patterns in groups.items()]
    if groups:
        options["light_groups"] = True
    options["shadow_sets"] = [_pair(pair) for pair in options["shadow_sets"]]
    return fill(_native._BakeRequest(), **options)


def _taken() -> list[str]:
    """The names of all options of a request: the arguments of bake(), and further ones of the table."""
    named = [name for name in inspect.signature(bake).parameters if name not in (*_NOT_OF_REQUESTS, "further")]
    return [*named, *(row[0] for row in _native._BakeRequest._options if row[0] not in named)]


def request_of(options: Mapping[str, Any]) -> Any:
    """The native request of bake() with these options. Raises UsageError for options that bake() does not have."""
    known_name("bake", options, _taken())
    signature = inspect.signature(bake)
    own = [parameter for parameter in signature.parameters.values() if parameter.name not in _NOT_OF_REQUESTS]
    request = signature.replace(parameters=own).bind(**options)
    request.apply_defaults()
    return _request(request.arguments)


def bake(
    scene: _native.Scene,
    *,
    ao: bool = False,
    cones: bool = False,
    horizons: int = 0,
    sh: int = 0,
    ch: int = 0,
    ch_naive: bool = False,
    haar: int = 0,
    haar_error: float = 0.1,
    glossy: int = 0,
    near_lamps: int | None = None,
    vo: bool = False,
    vo_kind: Literal["node", "mesh", "material", "auto"] = "node",
    vo_records: float = 8.0,
    vo_min_form_factor: float = 0.0,
    volume: int = 0,
    texels: int = 0,
    relief: bool = False,
    light_groups: bool = False,
    light_group: Mapping[str, Sequence[str]] = MappingProxyType({}),
    radiosity: bool = False,
    patch_size: float = 0.0,
    solver: Literal["jacobi", "chebyshev", "gauss-seidel", "southwell"] = "gauss-seidel",
    tolerance: float = 1e-4,
    light_map: bool = False,
    texel_size: float = 0.0,
    texel_error: float = 0.0,
    encode: Sequence[str] = (),
    denoise: bool = False,
    caustics: bool = False,
    photons: int = 0,
    sky: _native.Sky | None = None,
    sky_rotation: float = 0.0,
    bounces: int = 0,
    specular: bool = False,
    glossy_bounces: bool = False,
    subsurface: bool = False,
    nearest: float = 0.0,
    farthest: float = 0.0,
    obscurance: float = 0.0,
    shadow_sets: Sequence[tuple[Sequence[str], Sequence[str]]] = (),
    animation: str | int | None = None,
    keys: int | None = None,
    key_error: float | None = None,
    rays: int | None = None,
    error: float | None = None,
    seconds: float | None = None,
    seed: int = 0,
    max_memory: int | None = None,
    device: _native.Device | None = None,
    progress: Progress | None = None,
    checkpoint: str | os.PathLike[str] = "",
    **further: Any,
) -> _native.Bake:
    """Bakes techniques at every vertex. Other Python threads can run meanwhile.

    Techniques: `ao` (ambient occlusion and bent normals; `cones` adds their openings), `horizons` (number of sectors),
    transfer in `sh`, `ch` (orders) or `haar` wavelets (size of the cube's faces; `haar_error` is the relative error that
    dropping wavelets may cause), `glossy` (order of the matrices), `near_lamps` (shells of distance; None: 8 where a
    lamp lies within the scene), vector occluders (`vo`; with "auto" there are `vo_records` per vertex), SH at points in
    the air (`volume`: cells along the longest side) and at `texels` of charts, `light_groups` (`light_group` maps names
    of groups to patterns of their lights), and the light of the scene's own lights and of a `sky`: by `radiosity` at
    vertices or as a `light_map`, which can `encode` the direction of the light and be cleaned by `denoise` (with Open
    Image Denoise, which must be installed).
    `further` techniques and their options are those of `prelight.options("bake")` that are not named here.

    `shadow_sets` are pairs of names or patterns of nodes: receivers, and the only nodes that cast shadows on them. SH is
    also baked at moments of an `animation`, given by its name or number: at this many `keys`, or at as many as a
    `key_error` requires. The effort is `rays` per vertex on average (1024), or ends at a standard `error` of ambient
    occlusion or after `seconds`. `progress` is told the stages. Ctrl-C and exceptions from `progress` end the bake; with
    a `checkpoint` file the same call continues it.
    """
    require_run(scene, device, progress)
    request, moments = _request(locals()), _keys(animation, keys, key_error)
    return _native._bake(scene, request, moments, device, progress, os.fspath(checkpoint))


@dataclass(frozen=True)
class Plan:
    """The plan of a bake: (name, whether it runs, why) for every pass, and the memory that it needs."""

    passes: list[tuple[str, bool, str]]
    host_bytes: int
    device_bytes: int


def plan(scene: _native.Scene, **options: Any) -> Plan:
    """The plan of bake() with these options."""
    require(_native.Scene, "scene", scene, optional=False)
    return Plan(*_native._plan(scene, request_of(options)))
