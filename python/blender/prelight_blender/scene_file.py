"""A Blender scene as a file that Prelight reads, and the places in it of the objects that get results."""

from dataclasses import dataclass, field

import numpy as np

from . import show
from .axes import node_matrix
from .gltf_file import GltfFile
from .lamps import Lamps
from .materials import Materials
from .meshes import Meshes, Shape, shape_of
from .problems import Problem

_WITH_FACES = ("MESH", "CURVE", "SURFACE", "FONT", "META")


@dataclass
class Target:
    """An object that gets results."""

    name: str
    node: int  # index in the file
    parts: list
    shape: Shape
    scale: float  # metres per unit of its mesh, for texels


@dataclass
class Written:
    targets: list = field(default_factory=list)
    notes: list = field(default_factory=list)  # differences from Blender's own pictures
    shines: bool = False  # whether anything in it shines


def write(context, path, chosen, *, lamps=True, only_chosen=False):
    """Writes the visible and rendered objects, with modifiers and instances, as a .glb."""
    writer = _Writer(chosen, only_chosen)
    depsgraph = context.evaluated_depsgraph_get()
    for instance in depsgraph.object_instances:
        item = instance.object
        if not instance.show_self or item.original.hide_render or not _is_visible(instance, context):
            continue
        if item.type in _WITH_FACES:
            writer.add_surface(instance, item)
        elif item.type == "LIGHT" and lamps:
            writer.lamps.add(item.name, item.data, instance.matrix_world)
    writer.check()
    writer.written.shines = writer.lamps.shine or writer.materials.glow
    writer.gltf.write(path)
    return writer.written


def _is_visible(instance, context):
    top = (instance.parent if instance.is_instance else instance.object).original
    return top.visible_get(view_layer=context.view_layer)


class _Writer:
    def __init__(self, chosen, only_chosen):
        self.gltf, self.written = GltfFile(), Written()
        self.materials = Materials(self.gltf, self.written.notes)
        self.meshes = Meshes(self.gltf, self.materials)
        self.lamps = Lamps(self.gltf, self.written.notes)
        self._chosen = set(chosen)
        self._only_chosen = only_chosen
        self._added = {}

    def add_surface(self, instance, item):
        original = item.original if not instance.is_instance and item.original in self._chosen else None
        if self._only_chosen and original is None:
            return
        slots = tuple(show.original_of(slot.material) for slot in item.material_slots)
        data = item.data
        key = (data.as_pointer() if item.type == "MESH" else item.as_pointer(), tuple(m.name_full if m else None for m in slots))
        if key not in self._added:
            self._added[key] = self._add_mesh(item, slots)
        added = self._added[key]
        if added is None:
            return
        mesh, parts, shape = added
        node = self.gltf.add_node({"name": item.name, "matrix": node_matrix(instance.matrix_world), "mesh": mesh})
        if original is not None:
            self._add_target(original, node, parts, shape, instance.matrix_world)

    def _add_mesh(self, item, slots):
        mesh = item.to_mesh()
        try:
            return self.meshes.add(mesh, slots) if mesh is not None else None
        finally:
            item.to_mesh_clear()

    def _add_target(self, original, node, parts, shape, matrix_world):
        if not shape.same_topology(shape_of(original.data)):
            names = ", ".join(modifier.name for modifier in original.modifiers if modifier.show_viewport)
            raise Problem(
                f'modifiers of "{original.name}" ({names}) change its faces, so that its mesh cannot hold the result',
                "Object > Apply > Visual Geometry to Mesh",
            )
        scale = float(abs(np.linalg.det(np.array(matrix_world)[:3, :3])) ** (1.0 / 3.0))
        self.written.targets.append(Target(original.name, node, parts, shape, scale))

    def check(self):
        found = {target.name for target in self.written.targets}
        missing = [item.name for item in self._chosen if item.name not in found]
        if missing:
            raise Problem(f'"{missing[0]}" is hidden or not rendered', "show it in the outliner (eye and camera), or deselect it")
