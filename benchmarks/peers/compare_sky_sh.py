#!/usr/bin/env python3
"""Compares the spherical-harmonic coefficients of skies with those of independent programs.

    build/bin/prelight_basis_report is asked for the coefficients, then
    - pyshtools (PyPI) for the Legendre functions, summed here over texel centres,
    - cmgen (Debian package libfilament-tools), given a cube map that is resampled here.
    What is not installed is left out.

Needs numpy and OpenEXR (PyPI). Prints the largest difference of a coefficient, as a part of the first one, for each
channel; exits with 1 when one is above --tolerance.
"""

import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile

import numpy
import OpenEXR

FACE_SIZE = 128  # cmgen adds up in float: larger faces lose dark texels
SAMPLES = 4  # along each side of a texel of the sky


def read_sky(path):
    pixels = OpenEXR.File(str(path)).channels()["RGB"].pixels.astype(numpy.float64)
    return numpy.maximum(pixels, 0.0)


def prelight(report, path, order):
    text = subprocess.run([report, path, str(order)], check=True, capture_output=True, text=True).stdout
    return numpy.array([[float(v) for v in line.split()[1:]] for line in text.splitlines()])


def with_pyshtools(sky, order):
    """Sum over texel centres, weighted by solid angles. World (x, y, z) is (sin t sin a, cos t, -sin t cos a), t from
    +Y and a from -Z towards +X; the polar axis of the functions is z, so they are evaluated direction by direction."""
    try:
        import pyshtools
    except ImportError:
        return None
    height, width, _ = sky.shape
    polar = numpy.pi * (numpy.arange(height) + 0.5) / height
    azimuth = 2.0 * numpy.pi * ((numpy.arange(width) + 0.5) / width - 0.5)
    edges = numpy.cos(numpy.pi * numpy.arange(height + 1) / height)
    weight = (edges[:-1] - edges[1:]) * 2.0 * numpy.pi / width
    x = numpy.sin(polar)[:, None] * numpy.sin(azimuth)
    y = numpy.cos(polar)[:, None] * numpy.ones(width)
    z = -numpy.sin(polar)[:, None] * numpy.cos(azimuth)
    phi = numpy.arctan2(y, x).ravel()
    flat = (sky * weight[:, None, None]).reshape(-1, 3)
    # csphase 1: without the Condon-Shortley phase; orthonormal functions, cnorm 0: real.
    legendre = numpy.array([pyshtools.legendre.PlmON(order - 1, v, csphase=1, cnorm=0) for v in z.ravel()])
    out = numpy.zeros((order * order, 3))
    for l in range(order):
        for m in range(l + 1):
            p = legendre[:, l * (l + 1) // 2 + m]
            out[l * (l + 1) + m] = (p * numpy.cos(m * phi)) @ flat
            if m > 0:
                out[l * (l + 1) - m] = (p * numpy.sin(m * phi)) @ flat
    return out


def solid_angles(size):
    edge = numpy.arange(size + 1) / size * 2.0 - 1.0
    a, b = numpy.meshgrid(edge, edge)
    corner = numpy.arctan2(a * b, numpy.sqrt(a * a + b * b + 1.0))
    return corner[1:, 1:] - corner[:-1, 1:] - corner[1:, :-1] + corner[:-1, :-1]


def cube_cross(sky):
    """A horizontal cross of faces in OpenGL's orientation. The sky's texels are dealt out in SAMPLES^2 pieces to the
    cube's, so that no energy is lost."""
    height, width, _ = sky.shape
    rows, columns = height * SAMPLES, width * SAMPLES
    energy = numpy.zeros((3 * FACE_SIZE * 4 * FACE_SIZE, 3))
    azimuth = 2.0 * numpy.pi * ((numpy.arange(columns) + 0.5) / columns - 0.5)
    for row in range(rows):
        top, middle, bottom = numpy.pi * (row + numpy.array([0.0, 0.5, 1.0])) / rows
        piece = (numpy.cos(top) - numpy.cos(bottom)) * 2.0 * numpy.pi / columns
        x, z = numpy.sin(middle) * numpy.sin(azimuth), -numpy.sin(middle) * numpy.cos(azimuth)
        y = numpy.full(columns, numpy.cos(middle))
        axis = numpy.abs([x, y, z]).argmax(0)
        along = numpy.choose(axis, [x, y, z])
        sign = numpy.sign(along)
        a = numpy.choose(axis, [-z * sign, x, x * sign]) / numpy.abs(along)
        b = numpy.choose(axis, [-y, z * sign, -y]) / numpy.abs(along)
        block_column = numpy.choose(axis, [1 + sign, 1, 2 - sign]).astype(int)
        block_row = numpy.choose(axis, [1, 1 - sign, 1]).astype(int)
        column = block_column * FACE_SIZE + numpy.minimum(((a + 1.0) / 2.0 * FACE_SIZE).astype(int), FACE_SIZE - 1)
        line = block_row * FACE_SIZE + numpy.minimum(((b + 1.0) / 2.0 * FACE_SIZE).astype(int), FACE_SIZE - 1)
        colour = numpy.repeat(sky[row // SAMPLES], SAMPLES, axis=0) * piece
        for c in range(3):
            energy[:, c] += numpy.bincount(line * 4 * FACE_SIZE + column, colour[:, c], len(energy))
    area = numpy.tile(solid_angles(FACE_SIZE), (3, 4))
    return (energy.reshape(3 * FACE_SIZE, 4 * FACE_SIZE, 3) / area[..., None]).astype(numpy.float32)


def with_cmgen(sky, order):
    """cmgen's coefficients are those of radiance without --sh-irradiance, carry the Condon-Shortley phase (-1)^m, and
    are of the mirrored map without --no-mirror. The axes are ours. Its own resampling of equirectangular maps is
    random and off by some per cent where a sky has small bright spots; hence the cube map."""
    program = shutil.which("cmgen")
    if program is None:
        return None
    with tempfile.TemporaryDirectory() as folder:
        cube = pathlib.Path(folder) / "cross.exr"
        result = pathlib.Path(folder) / "sh.txt"
        header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
        OpenEXR.File(header, {"RGB": cube_cross(sky)}).write(str(cube))
        subprocess.run([program, "--quiet", "--no-mirror", f"--size={FACE_SIZE}", f"--sh={order}", "--sh-window=no",
                        f"--sh-output={result}", cube], check=True, capture_output=True)
        lines = [line for line in result.read_text().splitlines() if line.strip()]
    out = numpy.array([[float(v) for v in line.split("(")[1].split(")")[0].split(",")] for line in lines])
    for l in range(order):
        for m in range(-l, l + 1):
            out[l * (l + 1) + m] *= (-1.0) ** m
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("report", help="build/bin/prelight_basis_report")
    parser.add_argument("skies", nargs="+", type=pathlib.Path, help="equirectangular .exr")
    parser.add_argument("--order", type=int, default=6)
    parser.add_argument("--tolerance", type=float, default=1e-3)
    parser.add_argument("--verbose", action="store_true", help="print all coefficients of the red channel")
    options = parser.parse_args()
    failed = False
    for path in options.skies:
        sky = read_sky(path)
        ours = prelight(options.report, path, options.order)
        for name, peer in (("pyshtools", with_pyshtools), ("cmgen", with_cmgen)):
            theirs = peer(sky, options.order)
            if theirs is None:
                print(f"{path.name} {name}: not installed")
                continue
            worst = numpy.abs(theirs - ours).max(0) / ours[0]
            failed |= bool((worst > options.tolerance).any())
            print(f"{path.name} {name} order {options.order}: {worst[0]:.1e} {worst[1]:.1e} {worst[2]:.1e}")
            if options.verbose:
                print(numpy.c_[ours[:, 0], theirs[:, 0]])
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
