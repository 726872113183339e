"""Files that hold bakes."""

import os
import warnings
from dataclasses import dataclass
from typing import Literal

from . import _native
from .arguments import fill, require
from .errors import StaleBakeWarning


def save(
    path: str | os.PathLike[str],
    scene: _native.Scene,
    bake: _native.Bake | None = None,
    *,
    compress: str = "",
    compress_occluders: bool = False,
) -> list[str]:
    """Writes a scene's file as .glb with a bake, which replaces an earlier one; without a bake it is plain glTF.

    `compress` makes the file small: "auto", or SH transfer alone: "half", "band8", "rgbe", "pca:K", "vq:N" or "cpca:N:K";
    "auto:cpca:64:8" does both. `compress_occluders` stores vector occluders as whole numbers, as "auto" does. Returns the changes by compression as text for people.
    """
    require(_native.Scene, "scene", scene, optional=False)
    require(_native.Bake, "bake", bake)
    return _native._save(os.fspath(path), scene, bake, compress, compress_occluders)


def carried_bake(scene: _native.Scene) -> _native.Bake | None:
    """The bake in a scene's file, or None. Warns (StaleBakeWarning) if the scene has changed since and parts of the bake
    no longer fit it."""
    require(_native.Scene, "scene", scene, optional=False)
    found = _native._carried_bake(scene)
    if found is None:
        return None
    bake, stale = found
    if stale:
        warnings.warn(f"{scene.path}: {stale}; bake it again", StaleBakeWarning, stacklevel=2)
    return bake


@dataclass(frozen=True)
class ExportedFile:
    """A file of an export: its name, its contents as text for people, and its size."""

    name: str
    contents: str
    bytes: int


def export(
    path: str | os.PathLike[str],
    scene: _native.Scene,
    bake: _native.Bake,
    *,
    target: Literal["gltf", "three", "blender", "raw", "godot", "unity"] = "gltf",
    form: Literal["lightmap", "occlusion", "vertex-light", "vertex-occlusion", "volume", "transfer"] | None = None,
    lights: Literal["remove", "mark", "keep"] = "remove",
    name: str = "",
    dry_run: bool = False,
) -> list[ExportedFile]:
    """Exports a bake as ordinary glTF for other programs, as `prelight export` does. `path` is a .glb, which holds
    everything, or a folder. Without a `form` the export is a light map if the bake holds one, else occlusion; for "three"
    it is transfer first, if prelight.js relights some of the bake's. The form "transfer" needs the target "three" or,
    for numbers, "raw".

    `name` begins the names of files in a folder; by default it is that of the scene's file. With `dry_run` nothing is
    written.
    """
    require(_native.Scene, "scene", scene, optional=False)
    require(_native.Bake, "bake", bake, optional=False)
    options = fill(
        _native._ExportOptions(), target=target, form=form or "", lights=lights, name=name, dry_run=dry_run
    )
    return [ExportedFile(*file) for file in _native._export(os.fspath(path), scene, bake, options)]
