"""Blender's meshes as primitives of a file, and the way back from its vertices to corners."""

from dataclasses import dataclass

import numpy as np

from .problems import Problem


@dataclass
class Part:
    """The primitive that was made from the triangles of one material."""

    corners: np.ndarray  # [k], corners of the mesh that the triangles use
    vertices: np.ndarray  # [k], vertices of the primitive for these corners
    triangles: np.ndarray  # [triangle, 3], vertices of the primitive
    triangle_corners: np.ndarray  # [triangle, 3], corners of the mesh


@dataclass
class Shape:
    """The corners of a mesh, which get the results."""

    corner_count: int
    vertex_count: int
    corner_vertices: np.ndarray  # [corner]
    polygon_starts: np.ndarray  # [polygon], first corner
    positions: np.ndarray  # [vertex, xyz], object space

    def same_topology(self, other):
        return (
            self.vertex_count == other.vertex_count
            and np.array_equal(self.corner_vertices, other.corner_vertices)
            and np.array_equal(self.polygon_starts, other.polygon_starts)
        )


def shape_of(mesh):
    return Shape(
        len(mesh.loops),
        len(mesh.vertices),
        _read(mesh.loops, "vertex_index", np.int32),
        _read(mesh.polygons, "loop_start", np.int32),
        _read(mesh.vertices, "co", np.float32, 3),
    )


def _read(collection, name, kind, width=1):
    values = np.empty(len(collection) * width, kind)
    collection.foreach_get(name, values)
    return values.reshape(-1, width) if width > 1 else values


class Meshes:
    """Writes meshes into a file."""

    def __init__(self, gltf, materials):
        self._gltf, self._materials = gltf, materials

    def add(self, mesh, slots):
        """(place in the file, parts, shape) of a mesh with these materials; None for a mesh without faces."""
        mesh.calc_loop_triangles()
        if len(mesh.loop_triangles) == 0:
            return None
        triangles = _read(mesh.loop_triangles, "loops", np.int32, 3)
        used = np.minimum(_read(mesh.loop_triangles, "material_index", np.int32), max(len(slots) - 1, 0))
        source = _Source(mesh)
        parts, primitives = [], []
        for slot in np.unique(used):
            surface = self._materials.surface(slots[slot] if slots else None)
            part, primitive = self._primitive(source, triangles[used == slot], surface)
            parts.append(part)
            primitives.append(primitive)
        return self._gltf.add("meshes", {"name": mesh.name, "primitives": primitives}), parts, source.shape

    def _primitive(self, source, triangle_corners, surface):
        corners = np.unique(triangle_corners)
        vertex_of = source.vertices[corners]
        columns = {"POSITION": source.positions[vertex_of], "NORMAL": source.normals[corners]}
        if surface.mapping is not None:
            columns["TEXCOORD_0"] = source.tex_coords(surface.mapping)[corners]
        if surface.color_attribute:
            columns["COLOR_0"] = source.colors(surface.color_attribute)[corners]
        # Corners that differ in nothing are one vertex. The normals of a smooth vertex differ only by rounding.
        told_apart = [np.round(columns["NORMAL"] * 4096.0)]
        told_apart += [columns[name] for name in ("TEXCOORD_0", "COLOR_0") if name in columns]
        _, first, vertices = np.unique(_hashes(vertex_of, np.concatenate(told_apart, axis=1)), return_index=True, return_inverse=True)
        place = np.zeros(int(corners.max()) + 1, np.int64)
        place[corners] = vertices
        triangles = place[triangle_corners].astype(np.uint32)
        attributes = {
            name: self._gltf.add_array(values[first].astype(np.float32), bounds=name == "POSITION") for name, values in columns.items()
        }
        primitive = {"attributes": attributes, "indices": self._gltf.add_array(triangles.reshape(-1)), "material": surface.index}
        return Part(corners, vertices, triangles, triangle_corners), primitive


def _hashes(numbers, rows):
    """A 64-bit hash per row: among a million different rows two have the same hash with a chance of 1e-7."""
    hashes = numbers.astype(np.uint64)
    for column in np.ascontiguousarray(rows.T, np.float32) + np.float32(0.0):  # turns -0 into 0
        hashes = (hashes ^ (hashes >> np.uint64(29))) * np.uint64(0xBF58476D1CE4E5B9) + column.view(np.uint32)
    return hashes ^ (hashes >> np.uint64(32))


class _Source:
    """The arrays of a mesh. Data of vertices and of corners are both read by corner."""

    def __init__(self, mesh):
        self.mesh = mesh
        self.shape = shape_of(mesh)
        self.vertices, self.positions = self.shape.corner_vertices, self.shape.positions
        if not np.isfinite(self.positions).all():
            raise Problem(f'mesh "{mesh.name}" has vertices without a place (not a number)', "use Mesh > Clean Up, or undo the step that made them")
        self.normals = _corner_normals(mesh)

    def tex_coords(self, mapping):
        """Texture coordinates [corner, uv] for glTF, where v grows downwards."""
        layers = self.mesh.uv_layers
        layer = layers.get(mapping.uv_map) or next((layer for layer in layers if layer.active_render), None)
        if layer is None:
            return np.zeros((len(self.vertices), 2), np.float32)
        uv = _read(layer.data, "uv", np.float32, 2)
        rows = np.array(mapping.matrix, dtype=np.float64).reshape(2, 3)
        mapped = uv @ rows[:, :2].T + rows[:, 2]
        return np.stack([mapped[:, 0], 1.0 - mapped[:, 1]], axis=1).astype(np.float32)

    def colors(self, name):
        attributes = self.mesh.color_attributes
        attribute = attributes.get(name) if name else attributes.active_color
        if attribute is None:
            return np.ones((len(self.vertices), 4), np.float32)
        values = np.clip(_read(attribute.data, "color", np.float32, 4), 0.0, None)
        return values if attribute.domain == "CORNER" else values[self.vertices]


def _corner_normals(mesh):
    if hasattr(mesh, "corner_normals"):  # since Blender 4.1
        normals = _read(mesh.corner_normals, "vector", np.float32, 3)
    else:
        mesh.calc_normals_split()
        normals = _read(mesh.loops, "normal", np.float32, 3)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.where(length > 1e-6, normals / np.maximum(length, 1e-6), np.float32([0.0, 0.0, 1.0]))
