"""The places of meshes' corners in a light map, and the map as a picture for Blender."""

import numpy as np

from .tiles import Tiles

_NO_CHART = 0xFFFFFFFF
_SAME_PLACE = 1e-3  # texels


class LightMapLayout:
    """Gathers places, in texels from the upper left, until the picture's size is known."""

    def __init__(self, light_map, scene):
        self._corners, self._charts = light_map.corners, light_map.charts
        self._triangles = scene.triangles
        self._ranges = {(p.node, p.primitive): p for p in scene.primitives}
        self._tiles = Tiles(np.ascontiguousarray(light_map.values[..., 0]))

    def places(self, target, back):
        """Places [corner, xy] of the fronts of a target's faces, or of their backs; None if none is lit."""
        faces, corners = self._faces(target)
        faces = faces + back * len(self._triangles)
        lit = self._charts[faces] != _NO_CHART
        if not lit.any():
            return None
        faces, corners = faces[lit], corners[lit]
        places = np.zeros((target.shape.corner_count, 2), np.float32)
        places[corners] = self._corners[faces]
        self._part_polygons(target, faces, corners, places)
        return places

    def picture(self):
        """[row, column, rgb], the upper row first."""
        return self._tiles.picture()

    def _faces(self, target):
        """(triangles of the scene, their corners in the mesh) for the triangles that the scene kept."""
        found, corners = [np.zeros(0, np.int64)], [np.zeros((0, 3), np.int64)]
        for index, part in enumerate(target.parts):
            placed = self._ranges.get((target.node, index))
            if placed is None:
                continue
            faces = np.arange(placed.first_triangle, placed.first_triangle + placed.triangle_count)
            kept = kept_rows(part.triangles, self._triangles[faces] - placed.first_vertex)
            found.append(faces)
            corners.append(part.triangle_corners[kept])
        return np.concatenate(found), np.concatenate(corners)

    def _part_polygons(self, target, faces, corners, places):
        """Gives polygons whose triangles lie in several charts a tile of their own, since a corner has one place in Blender."""
        apart = (np.abs(places[corners] - self._corners[faces]) > _SAME_PLACE).any(axis=(1, 2))
        if not apart.any():
            return
        polygons = np.searchsorted(target.shape.polygon_starts, corners[:, 0], side="right") - 1
        cut = np.unique(polygons[apart])
        order = np.argsort(polygons, kind="stable")
        begins = np.searchsorted(polygons[order], cut, side="left")
        ends = np.searchsorted(polygons[order], cut, side="right")
        for begin, end in zip(begins, ends):
            mine = order[begin:end]
            used, triangles = np.unique(corners[mine], return_inverse=True)
            points = target.scale * target.shape.positions[target.shape.corner_vertices[used]]
            self._tiles.add(points, triangles.reshape(-1, 3), self._corners[faces[mine]], places, used)


def kept_rows(given, kept):
    """Indices of the given triangles that are left. Their order is the same, but triangles without area were dropped."""
    if len(given) == len(kept):
        return np.arange(len(given))
    found, at = np.empty(len(kept), np.int64), 0
    for row, triangle in enumerate(kept):
        while not np.array_equal(given[at], triangle):
            at += 1
        found[row] = at
        at += 1
    return found
