"""Pictures by OpenGL, which is loaded when the first one is drawn."""

import warnings
from collections.abc import Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from . import _native
from .arguments import fill, require, require_run
from .errors import Error

Shading = Literal[
    "phong", "ao", "cones", "horizons", "sh", "ch", "haar", "glossy", "lights", "vo", "radiosity", "lightmap", "screen"
]


def _renderer() -> Any:
    try:
        from . import _viewer
    except ImportError as error:
        raise Error(
            "draw",
            f"there is no OpenGL renderer: {error}",
            "build the package with PRELIGHT_VIEWER=ON and install libEGL, or use render(), which traces",
        ) from None
    return _viewer


def draw(
    scene: _native.Scene,
    bake: _native.Bake | None = None,
    *,
    shading: Shading = "phong",
    width: int = 0,
    height: int = 360,
    camera: _native.Camera | None = None,
    lights: Sequence[_native.Light] | None = None,
    sky: _native.Sky | None = None,
    sky_rotation: float = 0.0,
    device: _native.Device | None = None,
) -> NDArray[np.float32]:
    """A picture drawn by OpenGL without a display, as `prelight render --shading` draws it: [row, column, rgb] of linear
    radiance, W/(m2 sr).

    With a `width` of 0 the camera's aspect ratio gives the width. Without a `camera` the scene's first one is used, or
    one that frames the scene. `lights` replace the scene's. A `device` relights wavelets and glossy transfer, else the
    host does. Warnings tell which effects the picture approximates.
    """
    require_run(scene, device)
    require(_native.Bake, "bake", bake)
    require(_native.Camera, "camera", camera)
    require(_native.Sky, "sky", sky)
    renderer = _renderer()
    options = fill(
        renderer.DrawOptions(),
        shading=shading,
        width=width,
        height=height,
        camera=camera,
        lights=None if lights is None else list(lights),
        sky=sky,
        sky_rotation=sky_rotation,
    )
    picture, notes = renderer.draw(scene, bake, options, device)
    for note in notes:
        warnings.warn(note, stacklevel=2)
    return picture
