"""Binary glTF files as JSON and bytes, and a camera for those that have none."""

import json
import struct

import numpy

JSON_CHUNK = 0x4E4F534A


def read(path):
    """The file's JSON, and the chunks behind it unchanged."""
    data = path.read_bytes()
    length, kind = struct.unpack_from("<II", data, 12)
    if kind != JSON_CHUNK:
        raise ValueError(f"{path}: expected JSON as the first chunk")
    return json.loads(data[20:20 + length]), data[20 + length:]


def write(path, document, chunks):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    path.write_bytes(struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(chunks), len(text), JSON_CHUNK) + text + chunks)


def matrix_of(node):
    """The matrix that transforms column vectors by the node."""
    if "matrix" in node:
        return numpy.array(node["matrix"], float).reshape(4, 4).T
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    matrix = numpy.eye(4)
    matrix[:3, :3] = numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                                  [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                                  [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]) * node.get("scale", (1, 1, 1))
    matrix[:3, 3] = node.get("translation", (0, 0, 0))
    return matrix


def corners_of(document):
    """Corners of the boxes of everything that is drawn, in world space."""
    found = []

    def visit(index, parent):
        node = document["nodes"][index]
        world = parent @ matrix_of(node)
        if "mesh" in node:
            for primitive in document["meshes"][node["mesh"]]["primitives"]:
                accessor = document["accessors"][primitive["attributes"]["POSITION"]]
                box = numpy.array([accessor["min"], accessor["max"]])
                for i in range(8):
                    corner = [box[i >> axis & 1][axis] for axis in range(3)]
                    found.append((world @ numpy.array([*corner, 1.0]))[:3])
        for child in node.get("children", ()):
            visit(child, world)

    for root in document["scenes"][document.get("scene", 0)]["nodes"]:
        visit(root, numpy.eye(4))
    return numpy.array(found)


def add_camera(path, aspect):
    """Gives a file without a camera one that sees everything from in front, above and beside."""
    document, chunks = read(path)
    if document.get("cameras"):
        return
    corners = corners_of(document)
    middle, radius = (corners.min(axis=0) + corners.max(axis=0)) / 2, numpy.linalg.norm(numpy.ptp(corners, axis=0)) / 2
    back = numpy.array([0.6, 0.45, 0.8])
    back /= numpy.linalg.norm(back)
    right = numpy.cross([0.0, 1.0, 0.0], back)
    right /= numpy.linalg.norm(right)
    place, angle = numpy.eye(4), 0.6
    place[:3, :3] = numpy.stack([right, numpy.cross(back, right), back], axis=1)
    place[:3, 3] = middle + back * radius / numpy.sin(angle / 2)
    document["cameras"] = [{"type": "perspective", "perspective": {
        "yfov": angle, "znear": 0.01 * radius, "zfar": 10 * radius, "aspectRatio": aspect}}]
    document["nodes"].append({"name": "camera", "camera": 0, "matrix": place.T.ravel().tolist()})
    document["scenes"][document.get("scene", 0)]["nodes"].append(len(document["nodes"]) - 1)
    write(path, document, chunks)
