"""Draws a .glb by Filament, with the file's first camera: filament_client.py FILE.glb WIDTH HEIGHT OUT.npy (rows of 8 bits, sRGB)."""

import sys

import filly
import numpy


def main():
    source, width, height, output = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
    with filly.Renderer() as renderer:
        scene = renderer.create_scene()
        scene.tone_mapping = "linear"
        model = scene.load(source, strict=True)  # Reports what Filament does not support.
        target = renderer.create_render_target(width=width, height=height)
        renderer.render(scene, target, camera=model.cameras[0])
        numpy.save(output, target.read())


if __name__ == "__main__":
    main()
