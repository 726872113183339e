"""Pictures of linear radiance as arrays, [row][column][channel], and differences of two of them."""

import numpy
import OpenEXR


def read_exr(path):
    with OpenEXR.File(str(path)) as file:
        channels = file.channels()
        if "RGB" in channels:
            return numpy.asarray(channels["RGB"].pixels, dtype=numpy.float32)
        if "RGBA" in channels:
            return numpy.asarray(channels["RGBA"].pixels, dtype=numpy.float32)[..., :3]
        return numpy.stack([channels[c].pixels for c in "RGB"], axis=-1).astype(numpy.float32)


def write_exr(path, radiance):
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    with OpenEXR.File(header, {"RGB": radiance.astype(numpy.float32)}) as file:
        file.write(str(path))


def write_sky_with_sun(path, width):
    """Writes an equirectangular sky and returns its path. Pages keep one that is 128 texels wide as it is."""
    y, x = numpy.mgrid[0:width // 2, 0:width] * (128 / width)
    sun = 0.5 * numpy.exp(-((y - 24.0) ** 2 + (x - 40.0) ** 2) / 40.0)
    write_exr(path, numpy.stack([0.2 + sun * k + 0.2 * (y < 32) for k in (9.0, 8.0, 6.0)], axis=-1))
    return path


def averaged(radiance, times):
    """A picture that is this many times smaller, by averages of pixels."""
    height, width = radiance.shape[0] // times, radiance.shape[1] // times
    return radiance.reshape(height, times, width, times, 3).mean(axis=(1, 3))


def display(radiance):
    """sRGB of 0..1, without tone mapping."""
    x = numpy.clip(radiance, 0.0, 1.0)
    return numpy.where(x <= 0.0031308, 12.92 * x, 1.055 * numpy.power(x, 1.0 / 2.4) - 0.055)


def flip(reference, test):
    """Mean and map of FLIP (LDR) of two pictures as they are displayed."""
    import flip_evaluator

    error_map, mean, _ = flip_evaluator.evaluate(
        display(reference).astype(numpy.float32), display(test).astype(numpy.float32), "LDR", applyMagma=False)
    return mean, error_map


def without_lamps(reference, test):
    """Pixels that are not near anything much brighter than a lit surface, because every program averages edges of lamps in its own way."""
    bright = (reference.max(axis=-1) > 4.0) | (test.max(axis=-1) > 4.0)
    wide = bright.copy()
    for shift in (1, -1):
        for axis in (0, 1):
            wide |= numpy.roll(bright, shift, axis)
    return ~wide


def difference(reference, test):
    mean, error_map = flip(reference, test)
    lit = without_lamps(reference, test)
    return {
        "meanRatio": float(test[lit].mean() / reference[lit].mean()),
        "rms": float(numpy.sqrt(numpy.mean((test[lit] - reference[lit]) ** 2))),
        "flip": float(mean),
        "flipMax": float(error_map.max()),
    }


def seams(places, map_size):
    """Pixels beside which the surface continues but the light map does not, at borders of charts. places: u, v, distance."""
    found = numpy.zeros(places.shape[:2], bool)
    uv, far = places[..., :2] * numpy.array(map_size), places[..., 2]
    for axis in (0, 1):
        a, b = (slice(None, -1), slice(1, None))
        one, two = ((a, slice(None)), (b, slice(None))) if axis == 0 else ((slice(None), a), (slice(None), b))
        jump = numpy.abs(uv[two] - uv[one]).max(axis=-1) > 8.0
        near = (far[one] > 0) & (far[two] > 0) & (numpy.abs(far[two] - far[one]) < 0.03 * far[one])
        found[one] |= jump & near
        found[two] |= jump & near
    return found


def seam_difference(reference, test, places, map_size):
    """FLIP at borders of charts and elsewhere, lamps left out: means, and the shares of pixels above 0.1; the light at borders."""
    _, error_map = flip(reference, test)
    errors = numpy.asarray(error_map).reshape(reference.shape[:2])
    lit, at = without_lamps(reference, test), seams(places, map_size)
    borders = at & lit
    result = {"pixels": int(borders.sum()), "meanRatio": float(test[borders].mean() / reference[borders].mean()) if borders.any() else 1.0}
    for name, mask in (("seam", borders), ("elsewhere", ~at & lit)):
        values = errors[mask] if mask.any() else numpy.zeros(1)
        result[name] = float(values.mean())
        result[name + "Above"] = float((values > 0.1).mean())
        result[name + "Most"] = float(values.max())
    return result


def write_png(path, radiance):
    from PIL import Image

    Image.fromarray((255.0 * display(radiance) + 0.5).astype(numpy.uint8)).save(path)
