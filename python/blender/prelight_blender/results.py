"""The results of a bake, which are written into the scene completely or not at all."""

from dataclasses import dataclass

import bpy
import numpy as np

from .meshes import shape_of
from .problems import Problem

AO, LIGHT, LIGHT_MAP = "Prelight AO", "Prelight Light", "Prelight Light Map"
UV, UV_BACK = "Prelight", "Prelight Back"
_MOST_UV_MAPS = 8


@dataclass
class VertexColors:
    """A colour attribute of several meshes."""

    name: str
    domain: str  # POINT or CORNER
    values: dict  # name of a target: [corner, rgba]


@dataclass
class LightMap:
    """A picture and the places of meshes' corners in it."""

    picture: np.ndarray  # [row, column, rgb], the upper row first, W/m2
    fronts: dict  # name of a target: [corner, uv]
    backs: dict  # name of a target: [corner, uv], if backs are lit


def check_room(item):
    """Refuses a mesh without room for the UV maps of a light map."""
    others = [layer.name for layer in item.data.uv_layers if layer.name not in (UV, UV_BACK)]
    if len(others) > _MOST_UV_MAPS - 2:
        raise Problem(f'"{item.name}" has {len(others)} UV maps and needs room for two more', "remove one")


def apply(result, targets):
    """Writes a result into the scene; returns the objects."""
    items = [_unchanged(target) for target in targets]
    if isinstance(result, VertexColors):
        for item, target in zip(items, targets):
            _set_colors(item.data, result, result.values[target.name])
    else:
        image = _image(result.picture)
        for item, target in zip(items, targets):
            item.data[LIGHT_MAP] = image
            for name, places in ((UV, result.fronts), (UV_BACK, result.backs)):
                _set_uv(item.data, name, places.get(target.name))
    return items


def light_map_of(mesh):
    """The picture of a mesh's light map, or None."""
    return mesh.get(LIGHT_MAP)


def remove_unused():
    """Removes light maps that no mesh has any more. If one is left, it gets the name without a number."""
    kept = []
    for image in [image for image in bpy.data.images if image.get(LIGHT_MAP)]:
        if image.users == 0:
            bpy.data.images.remove(image)
        else:
            kept.append(image)
    if len(kept) == 1:
        kept[0].name = LIGHT_MAP


def _unchanged(target):
    item = bpy.data.objects.get((target.name, None))
    if item is None or item.type != "MESH":
        raise Problem(f'"{target.name}" was removed during the bake', "bake again")
    if not target.shape.same_topology(shape_of(item.data)):
        raise Problem(f'The faces of "{target.name}" were changed during the bake', "bake again")
    return item


def _set_colors(mesh, result, values):
    old = mesh.attributes.get(result.name)
    if old is not None:
        mesh.attributes.remove(old)
    if result.domain == "POINT":
        values = _means_of_vertices(mesh, values)
    attribute = mesh.color_attributes.new(result.name, "FLOAT_COLOR", result.domain)
    attribute.data.foreach_set("color", np.ascontiguousarray(values, np.float32).reshape(-1))
    mesh.attributes.active_color = attribute
    mesh.update()


def _means_of_vertices(mesh, values):
    vertices = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", vertices)
    counts = np.maximum(np.bincount(vertices, minlength=len(mesh.vertices)), 1)
    return np.stack([np.bincount(vertices, v, len(mesh.vertices)) / counts for v in values.T], axis=1)


def _set_uv(mesh, name, places):
    """Sets or removes a UV map. The active UV maps stay active."""
    if places is None:
        if name in mesh.uv_layers:
            mesh.uv_layers.remove(mesh.uv_layers[name])
        return
    layer = mesh.uv_layers.get(name)
    if layer is None:
        first = len(mesh.uv_layers) == 0
        layer = mesh.uv_layers.new(name=name, do_init=False)
        layer.active = layer.active or first
    mesh.uv_layers[name].data.foreach_set("uv", np.ascontiguousarray(places, np.float32).reshape(-1))
    mesh.update()


def _image(picture):
    """A new picture that replaces the former one. It is packed, so that it is saved and survives an undo."""
    height, width, _ = picture.shape
    rgba = np.ones((height, width, 4), np.float32)
    rgba[..., :3] = picture
    image = bpy.data.images.new(LIGHT_MAP, width, height, alpha=False, float_buffer=True, is_data=True)
    image.pixels.foreach_set(np.ascontiguousarray(rgba[::-1]).reshape(-1))
    image.update()
    image.pack()
    image[LIGHT_MAP] = True
    return image
