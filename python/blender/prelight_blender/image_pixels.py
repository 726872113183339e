"""Pictures of Blender as arrays and as bytes of PNG or JPEG files."""

import pathlib
import struct
import zlib

import bpy
import numpy as np

from .problems import Problem

_SIGNATURES = {b"\x89PNG\r\n\x1a\n": "image/png", b"\xff\xd8\xff": "image/jpeg"}
_LINEAR = ("Linear", "Linear Rec.709", "Non-Color", "Raw", "Generic Data")


def check(image, user):
    """Refuses a picture that is not there; `user` names the material or world that uses it."""
    if image.source == "TILED":
        raise Problem(f'"{image.name}" of {user} has UDIM tiles', "use one picture, or bake tile by tile")
    if not image.has_data and not (image.size[0] and image.size[1]):
        path = bpy.path.abspath(image.filepath, library=image.library)
        raise Problem(
            f'"{image.name}" of {user} is missing: there is no picture at {path or "its (empty) path"}',
            "File > External Data > Find Missing Files",
        )


def pixels(image):
    """Pixels [row, column, rgba] of float32 as they are stored, the upper row first."""
    width, height = image.size
    values = np.empty(width * height * 4, np.float32)
    image.pixels.foreach_get(values)
    return values.reshape(height, width, 4)[::-1]


def is_linear(image):
    return image.colorspace_settings.name in _LINEAR


def linear_pixels(image):
    """Pixels [row, column, rgba] in linear RGB, the upper row first."""
    values = pixels(image).copy()
    if not image.is_float and not is_linear(image):
        values[..., :3] = from_srgb(values[..., :3])
    return values


def from_srgb(values):
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def to_srgb(values):
    values = np.clip(values, 0.0, 1.0)
    return np.where(values <= 0.0031308, 12.92 * values, 1.055 * values ** (1.0 / 2.4) - 0.055)


def color_file(image):
    """(bytes, MIME type) of a picture whose colours are sRGB, as glTF requires."""
    stored = _stored_file(image) if not is_linear(image) else None
    if stored is not None:
        return stored
    values = linear_pixels(image)
    values[..., :3] = to_srgb(values[..., :3])
    return png((255.0 * np.clip(values, 0.0, 1.0) + 0.5).astype(np.uint8)), "image/png"


def _stored_file(image):
    """(bytes, MIME type) of the file that a picture was read from, or None if glTF cannot hold that file."""
    if image.is_dirty or image.source != "FILE":
        return None
    if image.packed_file is not None:
        data = bytes(image.packed_file.data)
    else:
        path = pathlib.Path(bpy.path.abspath(image.filepath, library=image.library))
        data = path.read_bytes() if path.is_file() else b""
    kind = next((kind for signature, kind in _SIGNATURES.items() if data.startswith(signature)), None)
    return None if kind is None else (data, kind)


def png(rgba):
    """A PNG file of [row, column, rgba] of uint8."""
    height, width, _ = rgba.shape
    rows = np.zeros((height, 1 + 4 * width), np.uint8)  # each row begins with its filter, none
    rows[:, 1:] = rgba.reshape(height, 4 * width)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows.tobytes(), 1)) + chunk(b"IEND", b"")
