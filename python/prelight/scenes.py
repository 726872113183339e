"""Scenes from files and from arrays."""

import os
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from . import _native
from .arguments import Progress, fill, require_run
from .errors import UsageError


def load(
    path: str | os.PathLike[str],
    *,
    scene: str = "",
    variant: str = "",
    at: float | None = None,
    animation: str = "",
    scale: float = 1.0,
    allow_outside: bool = False,
) -> _native.Scene:
    """Reads a .gltf or .glb with all files that it names.

    `scene` and `variant` are names in the file (or a scene's number); empty: the file's own choice. `at` poses the scene
    at a moment, s, of an `animation`. `scale` enlarges the scene by this factor. `allow_outside` permits files outside of
    the scene's folder; a scene from a stranger could name any file of the machine.
    """
    options = fill(
        _native._LoadOptions(),
        scene=scene,
        variant=variant,
        at=at,
        animation=animation,
        scale=scale,
        allow_outside=allow_outside,
    )
    return _native._load(os.fspath(path), options)


class Mesh:
    """A mesh from C-contiguous arrays: `positions` [vertex, xyz] of float32, m; `triangles` [triangle, corner] of uint32,
    whose fronts are counter-clockwise; `normals` [vertex, xyz], `tex_coords` and `tex_coords1` [vertex, uv] and `colors`
    [vertex, rgba] of float32, or None. `material` is an index into the materials of make_scene(), -1 a white Lambertian
    surface; `to_world` is a 4 x 4 matrix.
    """

    def __init__(
        self,
        positions: NDArray[np.float32],
        triangles: NDArray[np.uint32],
        *,
        normals: NDArray[np.float32] | None = None,
        tex_coords: NDArray[np.float32] | None = None,
        tex_coords1: NDArray[np.float32] | None = None,
        colors: NDArray[np.float32] | None = None,
        material: int = -1,
        to_world: Sequence[Sequence[float]] | NDArray[np.floating] | None = None,
        name: str = "",
    ) -> None:
        for array, what in ((positions, "positions"), (triangles, "triangles")):
            if array is None:
                raise UsageError(f"Mesh: {what}", "got None, expected a NumPy array")
        self._native = _native._Mesh(positions, triangles)
        self._native.set_attributes(normals, tex_coords, tex_coords1, colors)
        fill(self._native, name=name, material=material)
        if to_world is not None:
            matrix = np.asarray(to_world, dtype=np.float64)
            if matrix.shape != (4, 4):
                raise UsageError("Mesh: to_world", f"got shape {matrix.shape}, expected (4, 4)")
            self._native.to_world = matrix.tolist()


def make_scene(
    meshes: Sequence[Mesh],
    *,
    materials: Sequence[_native.Material] = (),
    lights: Sequence[_native.Light] = (),
    cameras: Sequence[_native.Camera] = (),
    name: str = "scene",
) -> _native.Scene:
    """A scene from arrays, which save() can write like any other. Vertices keep their order: those of the first mesh come
    first. Arrays are copied."""
    for index, mesh in enumerate(meshes):
        if not isinstance(mesh, Mesh):
            raise UsageError(f"meshes[{index}]", f"got {type(mesh).__name__}, expected a prelight.Mesh")
    for kind, values, what in (
        (_native.Material, materials, "materials"),
        (_native.Light, lights, "lights"),
        (_native.Camera, cameras, "cameras"),
    ):
        for index, value in enumerate(values):
            if not isinstance(value, kind):
                raise UsageError(f"{what}[{index}]", f"got {type(value).__name__}, expected a prelight.{kind.__name__}")
    return _native._make_scene([mesh._native for mesh in meshes], list(materials), list(lights), list(cameras), name)


def refine(
    scene: _native.Scene,
    error: float = 0.01,
    *,
    vertices: int = 65536,
    device: _native.Device | None = None,
    progress: Progress | None = None,
) -> tuple[_native.Scene, _native.RefineReport]:
    """Cuts triangles between whose vertices the light of the sky or of lamps changes by more than `error`, a share of an
    open sky's, so that what is baked at vertices shows it. At most `vertices` are added. The refined scene is baked and
    saved in place of the first."""
    require_run(scene, device, progress)
    request = fill(_native._RefineRequest(), refine=error, refine_vertices=vertices)
    return _native._refine(scene, request, device, progress)


def unwrap(scene: _native.Scene, size: int, *, progress: Progress | None = None) -> _native.Scene:
    """Gives every primitive without coordinates that serve for bake(texels=size) those of charts. The unwrapped scene is
    baked and saved in place of the first."""
    require_run(scene, None, progress)
    return _native._unwrap(scene, size, progress)
