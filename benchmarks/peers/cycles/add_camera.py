#!/usr/bin/env python3
"""Writes a .glb with a camera that frames the whole scene, for scenes that have none: add_camera.py IN.glb OUT.glb [aspect]"""

import sys

from gltf_files import add_framing_camera, read_gltf, write_glb


def main():
    document, binary = read_gltf(sys.argv[1])
    add_framing_camera(document, float(sys.argv[3]) if len(sys.argv) > 3 else 1.0)
    write_glb(sys.argv[2], document, binary)


if __name__ == "__main__":
    main()
