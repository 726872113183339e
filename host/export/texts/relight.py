"""Reads what Prelight exported of vertices, and brings light from afar on them (numpy).

    python relight.py {NAME}.vertices.json

says how much light a sky sends, white above the horizon, on every vertex. Exit radiance is albedo x what the functions
`relight_*` return: sums of the light's coefficients times the transfer's, with bounces where they were baked.
"""

import json
import math
import pathlib
import sys

import numpy

TYPES = {"float32": "<f4", "float16": "<f2", "uint32": "<u4", "uint16": "<u2", "uint8": "u1"}


def read(path):
    """The description, and its arrays by name."""
    path = pathlib.Path(path)
    description = json.loads(path.read_text())
    data = (path.parent / description["file"]).read_bytes()
    arrays = {name: numpy.frombuffer(data, TYPES[array["type"]], math.prod(array["shape"]), array["byteOffset"]).reshape(array["shape"])
              for name, array in description["arrays"].items()}
    return description, arrays


def bands(order):
    """The band of every function."""
    return numpy.repeat(numpy.arange(order), 2 * numpy.arange(order) + 1)


def harmonics(directions, order):
    """Real, orthonormal SH without the Condon-Shortley phase, function l(l+1)+m: [...][function]."""
    x, y, z = (directions[..., axis] for axis in range(3))
    values = numpy.zeros((*x.shape, order * order))
    sectoral, cosine, sine = numpy.ones_like(x), numpy.ones_like(x), numpy.zeros_like(x)
    for m in range(order):
        # Legendre functions without sin^m, which x and y bring along in the waves; bands upwards from m.
        before, legendre = numpy.zeros_like(x), sectoral
        for l in range(m, order):
            scale = math.sqrt((2 * l + 1) / (4 * math.pi) * math.factorial(l - m) / math.factorial(l + m))
            values[..., l * (l + 1) + m] = scale * legendre * cosine * (math.sqrt(2) if m else 1)
            if m:
                values[..., l * (l + 1) - m] = scale * legendre * sine * math.sqrt(2)
            before, legendre = legendre, ((2 * l + 1) * z * legendre - (l + m) * before) / (l - m + 1)
        sectoral = sectoral * (2 * m + 1)
        cosine, sine = x * cosine - y * sine, x * sine + y * cosine
    return values


def sh_transfer(description, arrays):
    """T [vertex][channel][function], decoded where it is compressed; None where there is none."""
    if "sh" in arrays:
        return arrays["sh"]
    if "shCompressed" not in description:
        return None
    method, order = description["shCompressed"]["method"], description["shCompressed"]["order"]
    part = {name.removeprefix("shCompressed."): array for name, array in arrays.items() if name.startswith("shCompressed.")}
    if method == "half":
        return part["halves"].astype(numpy.float32)
    if method == "band8":
        ranges = part["ranges"][:, bands(order)]
        return ranges[..., 0] + ranges[..., 1] * part["bytes"]
    if method == "rgbe":
        exponents = part["exponents"][:, None, bands(order)].astype(int)
        return numpy.where(exponents == 0, 0.0, (part["bytes"].astype(float) - 128) / 128 * 2.0 ** (exponents - 128))
    clusters = part.get("clusters", numpy.zeros(len(part["weights"]) if "weights" in part else 0, int))
    transfer = part["means"][clusters].astype(float)
    if "weights" in part:
        weights = part["weights"].astype(float)
        if "weightRanges" in part:
            ranges = part["weightRanges"][clusters]
            weights = ranges[..., 0] + ranges[..., 1] * weights
        for component in range(weights.shape[1]):
            transfer += weights[:, component, None, None] * part["basis"][clusters, component]
    return transfer


def relight_sh(transfer, light):
    """[vertex][rgb] of light in SH, [rgb][function]: pi times this is irradiance."""
    light = numpy.asarray(light)[:, : transfer.shape[2]]
    return numpy.einsum("vci,ci->vc", numpy.broadcast_to(transfer, (len(transfer), 3, transfer.shape[2])), light)


def haar_forward(texels):
    """Wavelets of cube maps, [...][face][row][column]."""
    values = numpy.array(texels, float)
    h = 1
    while h < values.shape[-1]:
        places = [(slice(row, None, 2 * h), slice(column, None, 2 * h)) for row in (0, h) for column in (0, h)]
        p, q, s, t = (values[(..., *place)].copy() for place in places)
        for place, value in zip(places, (p + q + s + t, p - q + s - t, p + q - s - t, p - q - s + t)):
            values[(..., *place)] = value / 2
        h *= 2
    return values


def relight_haar(description, arrays, texels):
    """[vertex][rgb] of the radiance of a cube map's texels, [rgb][face][row][column]: pi times this is irradiance."""
    light = haar_forward(texels).reshape(3, -1)
    channels, offsets = description["haar"]["channels"], arrays["haar.offsets"].astype(numpy.int64)
    rows = numpy.repeat(numpy.arange(len(offsets) - 1), numpy.diff(offsets))
    result = numpy.empty(((len(offsets) - 1) // channels, 3))
    for channel in range(3):
        products = arrays["haar.values"] * light[channel, arrays["haar.indices"]]
        sums = numpy.bincount(rows, products, len(offsets) - 1).reshape(-1, channels)
        result[:, channel] = sums[:, channel if channels == 3 else 0]
    return result


def open_sky(description, arrays):
    """How much of a cosine-weighted sky no occluder hides: [vertex]. What hides itself, as a fold does, is an occluder too."""
    form_factors = arrays["vo.vectors"][:, description["vo"]["stored"].index("occlusion"), 3]
    offsets = arrays["vo.offsets"].astype(numpy.int64)
    vertices = numpy.repeat(numpy.arange(len(offsets) - 1), numpy.diff(offsets))
    return 1 - numpy.bincount(vertices, form_factors, len(offsets) - 1)


def cube_directions(size):
    """Unit directions of texels' middles: [face][row][column][axis]."""
    a, b = numpy.meshgrid((numpy.arange(size) + 0.5) / size * 2 - 1, (numpy.arange(size) + 0.5) / size * 2 - 1)
    one = numpy.ones_like(a)
    faces = [(one, -b, -a), (-one, -b, a), (a, one, b), (a, -one, -b), (a, -b, one), (-a, -b, -one)]
    directions = numpy.stack([numpy.stack(face, axis=-1) for face in faces])
    return directions / numpy.linalg.norm(directions, axis=-1, keepdims=True)


def main(path):
    description, arrays = read(path)
    directions = cube_directions(64)
    across = (numpy.arange(64) + 0.5) / 64 * 2 - 1
    solid_angles = (2 / 64) ** 2 / (1 + across[:, None] ** 2 + across[None, :] ** 2) ** 1.5
    sky = (directions[..., 1] > 0).astype(float)
    transfer = sh_transfer(description, arrays)
    if transfer is not None:
        order = math.isqrt(transfer.shape[2])
        light = numpy.einsum("fyxi,fyx,yx->i", harmonics(directions, order), sky, solid_angles)
        print("SH: mean", relight_sh(transfer, [light] * 3).mean(axis=0))
    if "haar" in description:
        size = description["haar"]["faceSize"]
        texels = (cube_directions(size)[..., 1] > 0).astype(float)
        print("wavelets: mean", relight_haar(description, arrays, [texels] * 3).mean(axis=0))
    if "vo" in description:
        print("vector occluders: mean open sky", open_sky(description, arrays).mean())


if __name__ == "__main__":
    main(sys.argv[1])
