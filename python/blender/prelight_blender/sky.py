"""The world's light as an equirectangular map, whose upper row is at Blender's +Z and whose middle column looks towards +Y."""

import numpy as np

from . import image_pixels
from .nodes import Input, has_nodes, source_of
from .problems import Problem

_ROWS = 512  # least number of rows in resampled maps


def radiance_of(world):
    """The radiance [row, column, rgb] of a world in float32, or None if it is black."""
    if world is None:
        return None
    if not has_nodes(world):
        return _even(world.color)
    output = next((node for node in world.node_tree.nodes if node.type == "OUTPUT_WORLD" and node.is_active_output), None)
    background = source_of(output.inputs["Surface"]) if output is not None else None
    if background is None:
        return None
    if background.type != "BACKGROUND":
        raise _unknown(world, background)
    strength = Input(background, "Strength").constant()
    color = Input(background, "Color")
    if strength is None:
        raise _unknown(world, source_of(background.inputs["Strength"]))
    if strength <= 0.0:
        return None
    if color.constant() is not None:
        return _even([strength * c for c in color.constant()[:3]])
    return (strength * _environment(world, color.source())).astype(np.float32)


def _unknown(world, node):
    return Problem(
        f'"{node.name}" of world "{world.name}" is not read',
        "give its Background a colour or an Environment Texture and a number as strength, or turn World off",
    )


def _even(color):
    if max(color[:3]) <= 0.0:
        return None
    return np.tile(np.float32(color[:3]), (2, 4, 1))


def _environment(world, node):
    if node.type != "TEX_ENVIRONMENT" or node.projection != "EQUIRECTANGULAR":
        raise _unknown(world, node)
    if node.image is None:
        raise Problem(f'"{node.name}" of world "{world.name}" has no picture', "open one, or turn World off")
    image_pixels.check(node.image, f'world "{world.name}"')
    turn = _turn(world, node)
    pixels = np.maximum(image_pixels.linear_pixels(node.image)[..., :3], 0.0)
    return _turned(pixels, turn)


def _turn(world, node):
    """The matrix that directions are multiplied by before the look-up."""
    source = source_of(node.inputs["Vector"])
    if source is None or _is_direction(source, node):
        return np.eye(3)
    if source.type != "MAPPING" or any(s.is_linked for s in source.inputs if s.name != "Vector"):
        raise _unknown(world, source)
    behind = source_of(source.inputs["Vector"])
    if behind is None or not _is_direction(behind, source):
        raise _unknown(world, behind or source)
    turn, scale = source.inputs["Rotation"].default_value, source.inputs["Scale"].default_value
    return np.array(turn.to_matrix()) @ np.diag(scale[:])


def _is_direction(source, reader):
    return source.type == "TEX_COORD" and reader.inputs["Vector"].links[0].from_socket.name == "Generated"


def _turned(pixels, turn):
    """Prelight's map for one of Cycles, whose middle column looks along +X. It is interpolated where texels do not coincide."""
    height, width = pixels.shape[:2]
    if np.array_equal(turn, np.eye(3)) and width % 4 == 0:
        return np.roll(pixels, width // 4, axis=1)
    rows = max(height, _ROWS) if height > 8 else height
    v, u = np.meshgrid((np.arange(rows) + 0.5) / rows, (np.arange(2 * rows) + 0.5) / (2 * rows), indexing="ij")
    polar, azimuth = np.pi * v, 2.0 * np.pi * (u - 0.5)  # azimuth from +Y towards +X
    directions = np.stack([np.sin(polar) * np.sin(azimuth), np.sin(polar) * np.cos(azimuth), np.cos(polar)], axis=-1) @ turn.T
    directions /= np.maximum(np.linalg.norm(directions, axis=-1, keepdims=True), 1e-12)
    x = (0.5 - np.arctan2(directions[..., 1], directions[..., 0]) / (2.0 * np.pi)) * width - 0.5
    y = np.arccos(np.clip(directions[..., 2], -1.0, 1.0)) / np.pi * height - 0.5
    return _bilinear(pixels, x, y)


def _bilinear(pixels, x, y):
    """Bilinear values at columns `x` and rows `y`. Columns wrap around, and rows end at the poles."""
    height, width = pixels.shape[:2]
    left, upper = np.floor(x).astype(int), np.floor(y).astype(int)
    fx, fy = (x - left)[..., None], (y - upper)[..., None]
    columns, rows = (left % width, (left + 1) % width), (np.clip(upper, 0, height - 1), np.clip(upper + 1, 0, height - 1))
    above = (1.0 - fx) * pixels[rows[0], columns[0]] + fx * pixels[rows[0], columns[1]]
    below = (1.0 - fx) * pixels[rows[1], columns[0]] + fx * pixels[rows[1], columns[1]]
    return (1.0 - fy) * above + fy * below
