"""Pictures by OpenGL, which is loaded when the first one is drawn."""

import logging
import os
import warnings
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, TypedDict, overload

import numpy as np
from numpy.typing import NDArray

from . import _native
from .arguments import Progress, fill, known_name, require, require_run
from .baking import request_of
from .errors import Error, UsageError, in_python

if TYPE_CHECKING:
    from typing_extensions import Unpack

# : Shadings by name; a technique may have a further one, and `prelight render --shading` names all.
Shading: TypeAlias = Literal[
    "phong",
    "ao",
    "cones",
    "horizons",
    "sh",
    "ch",
    "haar",
    "glossy",
    "lights",
    "vo",
    "radiosity",
    "lightmap",
    "screen",
    "full",
    "instant",
]
Vector: TypeAlias = Sequence[float]
# : A file, the place of its origin (m), and after these its yaw (degrees) and scale.
Object: TypeAlias = (
    tuple[str | os.PathLike[str], Vector]
    | tuple[str | os.PathLike[str], Vector, float]
    | tuple[str | os.PathLike[str], Vector, float, float]
)
# : A name or pattern of nodes, their displacement (m), and after these their yaw (degrees).
Move: TypeAlias = tuple[str, Vector] | tuple[str, Vector, float]

# : Arguments of draw() that are named in it.
_ARGUMENTS = (
    "shading",
    "width",
    "height",
    "samples_per_axis",
    "camera",
    "lights",
    "sky",
    "sky_rotation",
    "encoding",
    "group",
    "objects",
    "at",
    "animation",
    "moves",
    "rasterised",
    "denoise",
    "layers",
    "baking",
    "seed",
    "device",
    "progress",
)

_log = logging.getLogger("prelight")


class ShadingOptions(TypedDict, total=False):
    """Options of shadings, named as on the command line of `prelight render`; docs/command-line.md explains them."""

    # ao, screen
    ao_correction: Literal["none", "interreflection", "cubic"]
    ao_filter: Literal["cone", "cosine"]
    # haar, glossy and phong, horizons (degrees)
    haar_terms: int
    lobe: Literal["ggx", "phong"]
    horizon_softness: float
    # vo
    shadow_formula: Literal["soft", "thesis"]
    mirror_formula: Literal["lobe", "thesis"]
    receiver: Literal["lambert", "oren-nayar"]
    highlights: Literal["metals", "all"]
    shadow_strength: float
    caustic_strength: float
    bleeding: float
    diffuse_from_specular: float
    specular_from_specular: float
    specular_exponent: float
    sky_lights: int
    waves: float
    normal_waves: float
    wave_length: float
    fire: float
    effect_time: float
    # screen
    occlusion: Literal["ssao", "hbao", "gtao", "ssdo", "disks", "fields"]
    occlusion_filter: Literal["none", "bilateral"]
    occlusion_radius: float
    occlusion_slices: int
    occlusion_steps: int
    occlusion_samples: int
    occlusion_layers: int
    occlusion_thickness: float
    occlusion_element: float
    occlusion_opening: float
    occlusion_passes: int
    occlusion_bounces: int
    occlusion_stride: int
    occlusion_frames: int
    occlusion_cells: int
    occlusion_rays: int
    # full
    samples: int
    photons: int
    photons_by: Literal["power", "importance"]
    caustic_photons: int
    map_texels: int
    gather: Literal["all", "cache", "guided"]
    gather_rays: int
    # instant
    virtual_lights: int
    virtual_renewals: int
    virtual_nearest: float
    # every shading but full
    caustics: int
    # objects
    probes: bool
    object_light: Literal["auto", "volume", "cube"]
    object_shadow: Literal["rays", "vo", "neighbourhood"]


def renderer() -> Any:
    """The native module that draws."""
    try:
        from . import _viewer
    except ImportError as error:
        raise Error(
            "draw",
            f"there is no OpenGL renderer: {error}",
            "build the package with PRELIGHT_VIEWER=ON and install libEGL, or use render(), which traces",
        ) from None
    return _viewer


def _completed(argument: str, given: Sequence[Any], usual: Sequence[Any], least: int) -> list[tuple[Any, ...]]:
    """Tuples with `usual` values where they end early."""
    completed = []
    for one in given:
        if isinstance(one, str) or not least <= len(one) <= len(usual):
            raise UsageError(argument, f"got {one!r}, expected tuples of {least} to {len(usual)} members")
        completed.append((*one, *usual[len(one) :]))
    return completed


def _factors(group: Mapping[str, Any]) -> list[tuple[str, Any]]:
    if not isinstance(group, Mapping):
        raise UsageError("group", f"got {group!r}, expected a mapping from names to factors")
    return [(name, (factor,) * 3 if np.isscalar(factor) else factor) for name, factor in group.items()]


def _request(native: Any, given: Mapping[str, Any], options: Mapping[str, Any]) -> Any:
    """The native request. `given` are arguments that have members of their own, `options` those of shadings."""
    request = native.DrawRequest()
    known_name("draw", options, [*(row[0] for row in request._options), *_ARGUMENTS])
    return fill(request, **given, **options)


@overload
def draw(
    scene: _native.Scene,
    bake: _native.Bake | None = None,
    *,
    layers: Literal[False] = False,
    **options: Any,
) -> NDArray[np.float32]: ...
@overload
def draw(
    scene: _native.Scene,
    bake: _native.Bake | None = None,
    *,
    layers: Literal[True],
    **options: Any,
) -> dict[str, NDArray[np.float32]]: ...
def draw(
    scene: _native.Scene,
    bake: _native.Bake | None = None,
    *,
    shading: Shading | str | None = None,
    width: int = 0,
    height: int = 360,
    samples_per_axis: int = 2,
    camera: _native.Camera | int | None = None,
    lights: Sequence[_native.Light] | None = None,
    sky: _native.Sky | str | os.PathLike[str] | None = None,
    sky_rotation: float = 0.0,
    encoding: str = "",
    group: Mapping[str, float | Vector] = MappingProxyType({}),
    objects: Sequence[Object] = (),
    at: float | None = None,
    animation: str | int = "",
    moves: Sequence[Move] = (),
    rasterised: bool = False,
    denoise: bool = False,
    layers: bool = False,
    baking: Mapping[str, Any] = MappingProxyType({}),
    seed: int = 0,
    device: _native.Device | None = None,
    progress: Progress | None = None,
    **options: "Unpack[ShadingOptions]",
) -> NDArray[np.float32] | dict[str, NDArray[np.float32]]:
    """A picture drawn without a display, as `prelight render` draws it: [row, column, rgb] of linear radiance, W/(m2 sr).

    `shading`: how light reaches surfaces; without one, the best for which the bake holds data. "full" traces all light,
    or draws it by OpenGL if `rasterised`; it can `denoise` (with Open Image Denoise, which must be installed). All others
    are drawn by OpenGL. Options of shadings have the names of the command line with underscores (`ShadingOptions`):
    `draw(scene, shading="horizons", horizon_softness=5)`.

    `bake`: of the scene; without one, that of the scene's file. Data that the shading needs and that are missing are
    baked first, with options of bake() in `baking`: `{"rays": 256, "bounces": 2}`. `seed` is that of rays and photons.

    With a `width` of 0 the camera's aspect ratio gives the width (pixels). OpenGL draws `samples_per_axis` squared samples
    per pixel (1 to 8). `camera`: a camera, or the index of one of the file; without one, the first, or one that frames the
    scene. `lights` replace the scene's (world space). `sky`: a sky, the name of a built-in one ("studio", "neutral",
    "preetham:3:35") or a file; without one, that of the bake or of the file, or the studio where nothing gives light.
    `sky_rotation`: radians, counter-clockwise seen from above. `encoding`: the encoding of light that lightmap and
    radiosity shading draw. `group`: factors for the colours of light groups, `{"lamps": 0.5, "sign": (1, 0, 0)}`.

    `objects`: further files to put into the scene, (file, (x, y, z)[, yaw[, scale]]) in metres and degrees (`probes`
    adds balls that show a volume). `at`: seconds of an `animation` (name or index); `moves`: displacements of nodes,
    (name, (x, y, z)[, yaw]) in metres and degrees.

    With `layers` the result is a dictionary: "picture", the parts of light that sum up to it ("direct", "indirect", ...),
    and how open surfaces are ("ao", [row, column]) where the shading knows.

    `device` bakes, traces and relights; `progress` is told the stages, and stops the work where it returns False. Python
    warnings tell of likely mistakes and of what the picture approximates; the logger "prelight" has what was decided
    without being asked for, such as what is baked.
    """
    require_run(scene, device, progress)
    require(_native.Bake, "bake", bake)
    require(_native.Sky, "sky", None if isinstance(sky, (str, os.PathLike)) else sky)
    index = isinstance(camera, int) and not isinstance(camera, bool)
    require(_native.Camera, "camera", None if index else camera)
    named_sky = isinstance(sky, (str, os.PathLike))
    native = renderer()
    request = _request(
        native,
        {
            "shading": shading,
            "width": width or None,
            "height": height,
            "samples_per_axis": samples_per_axis,
            "camera": None if index else camera,
            "camera_index": camera if index else None,
            "lights": None if lights is None else list(lights),
            "sky": None if named_sky else sky,
            "sky_name": os.fspath(sky) if named_sky else "",
            "sky_rotation": sky_rotation,
            "encoding": encoding,
            "group": _factors(group),
            "objects": _completed("objects", objects, ("", (0.0, 0.0, 0.0), 0.0, 1.0), 2),
            "at": at,
            "animation": str(animation),
            "moves": _completed("moves", moves, ("", (0.0, 0.0, 0.0), 0.0), 2),
            "rasterised": rasterised,
            "denoise": denoise,
            "layers": layers,
            "baking": request_of({**baking, "seed": seed}),
        },
        options,
    )
    picture, parts, notes, approximations, mistakes = native.draw(scene, bake, request, device, progress)
    for note in notes:
        _log.info(in_python(note))
    for warning in [*approximations, *mistakes]:
        warnings.warn(in_python(warning), stacklevel=2)
    return {"picture": picture, **parts} if layers else picture
