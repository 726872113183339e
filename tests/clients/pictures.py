"""Pictures of linear radiance as arrays, [row][column][channel], and how far two of them are apart."""

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


def display(radiance):
    """sRGB of 0..1, without tone mapping."""
    x = numpy.clip(radiance, 0.0, 1.0)
    return numpy.where(x <= 0.0031308, 12.92 * x, 1.055 * numpy.power(x, 1.0 / 2.4) - 0.055)


def flip(reference, test):
    """Mean and map of FLIP (LDR) of two pictures as they are displayed."""
    import flip_evaluator

    error_map, mean, _ = flip_evaluator.evaluate(
        display(reference).astype(numpy.float32), display(test).astype(numpy.float32), "LDR")
    return mean, error_map


def without_lamps(reference, test):
    """Pixels away from what is much brighter than anything lit: edges of lamps are averaged by each program in its way."""
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


def write_png(path, radiance):
    from PIL import Image

    Image.fromarray((255.0 * display(radiance) + 0.5).astype(numpy.uint8)).save(path)
