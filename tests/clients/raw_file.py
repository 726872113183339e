"""Reads arrays that Prelight exported as numbers with a description."""

import json
import math

import numpy


def read(description_path):
    """Returns the description and its arrays by name."""
    description = json.loads(description_path.read_text())
    data = (description_path.parent / description["file"]).read_bytes()
    arrays = {}
    for name, array in description["arrays"].items():
        kind = {"float32": numpy.dtype("<f4"), "uint8": numpy.dtype("u1")}[array["type"]]
        count = math.prod(array["shape"])
        arrays[name] = numpy.frombuffer(data, kind, count, array["byteOffset"]).reshape(array["shape"])
    return description, arrays


def harmonics(directions):
    """Values [...][i] of the first nine SH functions."""
    x, y, z = (directions[..., a] for a in range(3))
    return numpy.stack([numpy.full_like(x, 0.28209479), 0.48860251 * y, 0.48860251 * z, 0.48860251 * x,
                        1.09254843 * x * y, 1.09254843 * y * z, 0.31539157 * (3 * z * z - 1), 1.09254843 * z * x,
                        0.54627422 * (x * x - y * y)], axis=-1)


def irradiance(coefficients, normals):
    """Irradiance from SH coefficients [i][channel] of radiance, of order 3."""
    bands = numpy.array([math.pi] + 3 * [2 * math.pi / 3] + 5 * [math.pi / 4])
    return harmonics(normals) @ (bands[:, None] * coefficients)
