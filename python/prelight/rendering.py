"""Pictures and photons, which need neither a display nor OpenGL."""

from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from . import _native
from .arguments import Progress, exclusive, fill, require, require_run


def _options(arguments: Mapping[str, Any]) -> Any:
    """The options of a picture among the arguments of a call."""
    require_run(arguments["scene"], arguments["device"], arguments["progress"])
    require(_native.Camera, "camera", arguments["camera"])
    require(_native.Sky, "sky", arguments["sky"])
    names = ("method", "width", "height", "samples", "depth", "seed", "camera", "sky", "sky_rotation")
    lights = arguments["lights"]
    return fill(
        _native._RenderOptions(),
        lights=None if lights is None else list(lights),
        **{name: arguments[name] for name in names},
    )


def render(
    scene: _native.Scene,
    *,
    method: Literal["path", "distributed", "whitted", "global_illumination"] = "path",
    width: int = 0,
    height: int = 360,
    samples: int = 64,
    depth: int = 16,
    seed: int = 0,
    camera: _native.Camera | None = None,
    lights: Sequence[_native.Light] | None = None,
    sky: _native.Sky | None = None,
    sky_rotation: float = 0.0,
    device: _native.Device | None = None,
    progress: Progress | None = None,
) -> NDArray[np.float32]:
    """A picture: [row, column, rgb] of linear radiance, W/(m2 sr).

    `method`: "path" (all light, with noise), "distributed" (one diffuse bounce), "whitted" (none) or
    "global_illumination" (photons and final gathering: little noise, small bias). With a `width` of 0 the camera's aspect
    ratio gives the width. Without a `camera` the scene's first one is used, or one that frames the scene. `lights`
    replace the scene's.
    """
    return _native._render(scene, _options(locals()), device, progress)


def reference(
    scene: _native.Scene,
    *,
    error: float | None = None,
    seconds: float | None = None,
    method: Literal["path", "distributed", "whitted"] = "path",
    width: int = 0,
    height: int = 360,
    samples: int = 256,
    depth: int = 16,
    seed: int = 0,
    camera: _native.Camera | None = None,
    lights: Sequence[_native.Light] | None = None,
    sky: _native.Sky | None = None,
    sky_rotation: float = 0.0,
    device: _native.Device | None = None,
    progress: Progress | None = None,
) -> _native.Reference:
    """A picture by path tracing with statistics of its noise. Tracing ends when the RMS standard `error` of a pixel is
    below this share of the picture's mean, or after `seconds`, else with this many `samples` per pixel."""
    options = _options(locals())
    exclusive(error=error, seconds=seconds)
    goal = fill(_native._ReferenceGoal(), error=error, seconds=seconds)
    return _native._reference(scene, options, goal, device, progress)


def photons(
    scene: _native.Scene,
    *,
    kind: Literal["all", "indirect", "caustic"] = "all",
    photons: int = 100_000,
    seed: int = 0,
    sky: _native.Sky | None = None,
    sky_rotation: float = 0.0,
    device: _native.Device | None = None,
    progress: Progress | None = None,
) -> _native.Photons:
    """Sends photons from the scene's lights and returns where they land."""
    require_run(scene, device, progress)
    require(_native.Sky, "sky", sky)
    options = fill(
        _native._PhotonOptions(),
        kind=kind,
        photons=photons,
        seed=seed,
        sky_rotation=sky_rotation,
    )
    return _native._photons(scene, options, sky, device, progress)
