"""Lights a bake by the library and by the example beside its numbers: raw_client.py BAKED.glb FOLDER (needs Prelight's Python package)."""

import pathlib
import sys

import numpy
import prelight


def main(baked, folder):
    sys.path.insert(0, str(folder))
    import relight

    description, arrays = relight.read(next(folder.glob("*.vertices.json")))
    bake = prelight.carried_bake(prelight.load(baked))
    generator = numpy.random.default_rng(1)
    transfer = relight.sh_transfer(description, arrays)
    light = generator.random((3, transfer.shape[2]))
    pairs = {"SH": (prelight.relight(bake, light, technique="sh"), numpy.pi * relight.relight_sh(transfer, light))}
    if "haar" in description:
        size = description["haar"]["faceSize"]
        texels = generator.random((3, 6 * size * size)).astype(numpy.float32)
        pairs["wavelets"] = (prelight.relight(bake, texels, technique="haar"),
                             numpy.pi * relight.relight_haar(description, arrays, texels.reshape(3, 6, size, size)))
    if "vo" in description:
        pairs["vector occluders"] = (arrays["ao"], relight.open_sky(description, arrays))
    for name, (true, found) in pairs.items():
        print(f"{name}\t{numpy.abs(true - found).max() / numpy.abs(true).max():.3g}")


if __name__ == "__main__":
    main(sys.argv[1], pathlib.Path(sys.argv[2]))
