"""Reading and writing glTF as JSON and one buffer: what the scripts here need, no more."""

import base64
import json
import math
import pathlib
import struct
import urllib.parse

import numpy

JSON_CHUNK = 0x4E4F534A
BINARY_CHUNK = 0x004E4942
DEFAULT_YFOV = math.radians(40.0)
FRAME = 0.95  # the share of a framing picture that the box fills


def read_gltf(path):
    """(document, binary chunk or b"") of a .glb or .gltf."""
    data = pathlib.Path(path).read_bytes()
    if data[:4] != b"glTF":
        return json.loads(data), b""
    document, binary, at = None, b"", 12
    while at < len(data):
        length, kind = struct.unpack_from("<II", data, at)
        chunk = data[at + 8 : at + 8 + length]
        if kind == JSON_CHUNK:
            document = json.loads(chunk)
        elif kind == BINARY_CHUNK:
            binary = chunk
        at += 8 + length
    return document, binary


def write_glb(path, document, binary):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    chunks = struct.pack("<II", len(text), JSON_CHUNK) + text
    if binary:
        chunks += struct.pack("<II", len(binary), BINARY_CHUNK) + binary
    pathlib.Path(path).write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)


def local_matrix(node):
    if "matrix" in node:
        return numpy.array(node["matrix"], float).reshape(4, 4).T
    x, y, z, w = node.get("rotation", [0, 0, 0, 1])
    out = numpy.eye(4)
    out[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    out[:3, :3] *= numpy.array(node.get("scale", [1, 1, 1]), float)
    out[:3, 3] = node.get("translation", [0, 0, 0])
    return out


def world_matrices(document):
    """{node index: 4x4 matrix} of the nodes of the default scene."""
    nodes = document.get("nodes", [])
    roots = document["scenes"][document.get("scene", 0)].get("nodes", [])
    found, waiting = {}, [(root, numpy.eye(4)) for root in roots]
    while waiting:
        index, parent = waiting.pop()
        found[index] = parent @ local_matrix(nodes[index])
        waiting += [(child, found[index]) for child in nodes[index].get("children", [])]
    return found


def bounds(document):
    """Lower and upper corner of the default scene's meshes, from the bounds that accessors state."""
    corners = []
    for index, matrix in world_matrices(document).items():
        mesh = document["nodes"][index].get("mesh")
        if mesh is None:
            continue
        for primitive in document["meshes"][mesh]["primitives"]:
            accessor = document["accessors"][primitive["attributes"]["POSITION"]]
            low, high = accessor["min"], accessor["max"]
            for corner in range(8):
                point = [high[a] if corner >> a & 1 else low[a] for a in range(3)]
                corners.append((matrix @ numpy.array(point + [1.0]))[:3])
    return numpy.min(corners, axis=0), numpy.max(corners, axis=0)


def looking_at(eye, target):
    """Matrix of a camera at `eye` that looks at `target`, +Y up."""
    back = (eye - target) / numpy.linalg.norm(eye - target)
    right = numpy.cross([0.0, 1.0, 0.0], back)
    right /= numpy.linalg.norm(right)
    out = numpy.eye(4)
    out[:3, 0], out[:3, 1], out[:3, 2], out[:3, 3] = right, numpy.cross(back, right), back, eye
    return out


def add_camera(document, matrix, yfov=DEFAULT_YFOV, aspect=1.0, near=0.01):
    lens = {"type": "perspective", "perspective": {"yfov": yfov, "aspectRatio": aspect, "znear": near}}
    document.setdefault("cameras", []).append(lens)
    document["nodes"].append(
        {"name": "camera", "camera": len(document["cameras"]) - 1, "matrix": matrix.T.ravel().tolist()}
    )
    document["scenes"][document.get("scene", 0)].setdefault("nodes", []).append(len(document["nodes"]) - 1)


def add_framing_camera(document, aspect=1.0):
    """A camera that sees the bounding box of everything and little more, from the front, the right and a little above."""
    low, high = bounds(document)
    centre, away = (low + high) / 2, numpy.array([0.5, 0.35, 1.0])
    axes = looking_at(centre + away, centre)[:3, :3]
    x, y, z = axes.T @ numpy.array([(high - low) / 2 * [i & 1 or -1, (i >> 1) & 1 or -1, i >> 2 or -1] for i in range(8)]).T
    slope = math.tan(DEFAULT_YFOV / 2) * FRAME
    distance = float(numpy.max(z + numpy.maximum(numpy.abs(x) / aspect, numpy.abs(y)) / slope))
    add_camera(document, looking_at(centre + distance * axes[:, 2], centre), aspect=aspect, near=distance / 100)


def packed(path):
    """(document, binary) of a scene with all that its buffers and images name outside of it moved into one buffer."""
    path = pathlib.Path(path)
    document, chunk = read_gltf(path)

    def contents(uri):
        if uri.startswith("data:"):
            return base64.b64decode(uri.split(",", 1)[1])
        return (path.parent / urllib.parse.unquote(uri)).read_bytes()

    binary, starts = b"", []
    for buffer in document.get("buffers", []):
        starts.append(len(binary))
        data = contents(buffer["uri"]) if "uri" in buffer else chunk
        binary += data + b"\0" * (-len(data) % 4)
    for view in document.get("bufferViews", []):
        view["byteOffset"] = view.get("byteOffset", 0) + starts[view["buffer"]]
        view["buffer"] = 0
    for image in document.get("images", []):
        if "uri" not in image:
            continue
        data = contents(image["uri"])
        image.setdefault("mimeType", "image/png" if data[:4] == b"\x89PNG" else "image/jpeg")
        document.setdefault("bufferViews", []).append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data)})
        image["bufferView"] = len(document["bufferViews"]) - 1
        del image["uri"]
        binary += data + b"\0" * (-len(data) % 4)
    document["buffers"] = [{"byteLength": len(binary)}]
    return document, binary
