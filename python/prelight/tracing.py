"""Ray tracing in a scene."""

import numpy as np
from numpy.typing import NDArray

from . import _native
from .arguments import require_run


def trace(
    scene: _native.Scene,
    origins: NDArray[np.float32],
    directions: NDArray[np.float32],
    farthest: NDArray[np.float32] | None = None,
    *,
    device: _native.Device | None = None,
) -> _native.Hits:
    """The closest hits of rays with `origins` and `directions` [ray, xyz] of float32, world space, m. Each call builds
    the scene's hierarchy, so use a RayTracer to trace in a scene more than once."""
    require_run(scene, device)
    return _native.RayTracer(scene, device).trace(origins, directions, farthest)
