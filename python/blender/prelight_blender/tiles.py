"""Polygons that charts cut apart, each of which gets a new tile below the light map."""

import numpy as np

_MOST_TEXELS = 256  # along a tile's side


class Tiles:
    def __init__(self, light_map):
        self._map = light_map  # [row, column, rgb]
        self._tiles = []  # (values, corner places within, where they go to)

    def add(self, points, triangles, map_places, places, corners):
        """Copies the light of one polygon with `points` [k, xyz] and `triangles` [n, 3], whose corners lie at `map_places`
        [n, 3, xy] of the map. The new places are written to the rows `corners` of `places` when the picture is made."""
        flat = _flattened(points, triangles)
        density = np.sqrt(_area(map_places).sum() / max(_area(flat[triangles]).sum(), 1e-20))
        low, extent = flat.min(axis=0), np.maximum(np.ptp(flat, axis=0), 1e-12)
        texels = np.clip(np.ceil(extent * density), 1, _MOST_TEXELS).astype(int)
        within = (flat - low) / extent * texels + 0.5  # the centres of the outer texels lie on the edge
        self._tiles.append((self._copied(within[triangles], map_places, texels + 1), within, places, corners))

    def _copied(self, corners, map_places, size):
        width, height = size
        x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
        weights = _weights(np.stack([x, y], axis=-1).reshape(-1, 1, 2), corners[None])  # [texel, triangle, 3]
        nearest = weights.min(axis=-1).argmax(axis=1)
        weights = np.maximum(weights[np.arange(len(nearest)), nearest], 0.0)
        weights /= weights.sum(axis=-1, keepdims=True)
        at = np.einsum("tc,tcx->tx", weights, map_places[nearest])
        return self._looked_up(at).reshape(height, width, 3)

    def _looked_up(self, at):
        height, width = self._map.shape[:2]
        x, y = np.clip(at[:, 0] - 0.5, 0, width - 1), np.clip(at[:, 1] - 0.5, 0, height - 1)
        left, upper = x.astype(int), y.astype(int)
        right, lower = np.minimum(left + 1, width - 1), np.minimum(upper + 1, height - 1)
        fx, fy = (x - left)[:, None], (y - upper)[:, None]
        above = (1 - fx) * self._map[upper, left] + fx * self._map[upper, right]
        below = (1 - fx) * self._map[lower, left] + fx * self._map[lower, right]
        return (1 - fy) * above + fy * below

    def picture(self):
        """Returns the map with the tiles below it, row by row, and sets all places within that picture."""
        width = max([self._map.shape[1]] + [tile.shape[1] for tile, *_ in self._tiles])
        x, y, row, offsets = 0, self._map.shape[0], 0, []
        order = sorted(range(len(self._tiles)), key=lambda k: -self._tiles[k][0].shape[0])
        for k in order:
            tile = self._tiles[k][0]
            if x + tile.shape[1] > width:
                x, y, row = 0, y + row, 0
            offsets.append((x, y))
            x, row = x + tile.shape[1], max(row, tile.shape[0])
        picture = np.zeros((y + row, width, 3), np.float32)
        picture[: self._map.shape[0], : self._map.shape[1]] = self._map
        for k, (x, y) in zip(order, offsets):
            tile, within, places, corners = self._tiles[k]
            picture[y : y + tile.shape[0], x : x + tile.shape[1]] = tile
            places[corners] = within + (x, y)
        return picture


def _flattened(points, triangles):
    """The points [k, xy] on the plane of the mean normal, with x along the first edge."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a).sum(axis=0)
    normal /= max(np.linalg.norm(normal), 1e-20)
    along = (b - a)[0] - normal * np.dot((b - a)[0], normal)
    along /= max(np.linalg.norm(along), 1e-20)
    return np.stack([points @ along, points @ np.cross(normal, along)], axis=1)


def _area(triangles):
    one, two = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    return 0.5 * np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])


def _weights(points, triangles):
    """Barycentric weights of points in triangles [..., 3, xy]."""
    a, b, c = triangles[..., 0, :], triangles[..., 1, :], triangles[..., 2, :]

    def twice(p, q, r):
        return (q[..., 0] - p[..., 0]) * (r[..., 1] - p[..., 1]) - (q[..., 1] - p[..., 1]) * (r[..., 0] - p[..., 0])

    whole = twice(a, b, c)
    whole = np.where(np.abs(whole) < 1e-12, 1e-12, whole)
    one, two = twice(points, c, a) / whole, twice(points, a, b) / whole
    return np.stack([1.0 - one - two, one, two], axis=-1)
