"""A .glb file that is put together piece by piece."""

import json
import struct

import numpy as np

_COMPONENTS = {np.dtype(np.float32): 5126, np.dtype(np.uint32): 5125}
_TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}


class GltfFile:
    def __init__(self):
        self.document = {"asset": {"version": "2.0", "generator": "Prelight for Blender"}, "scene": 0, "scenes": [{"nodes": []}]}
        self._bytes = bytearray()

    def add(self, kind, item):
        """Appends to an array of the document and returns the index."""
        items = self.document.setdefault(kind, [])
        items.append(item)
        return len(items) - 1

    def add_node(self, node):
        index = self.add("nodes", node)
        self.document["scenes"][0]["nodes"].append(index)
        return index

    def use(self, extension):
        used = self.document.setdefault("extensionsUsed", [])
        if extension not in used:
            used.append(extension)

    def add_bytes(self, data):
        self._bytes += b"\0" * (-len(self._bytes) % 4)
        view = {"buffer": 0, "byteOffset": len(self._bytes), "byteLength": len(data)}
        self._bytes += data
        return self.add("bufferViews", view)

    def add_array(self, values, bounds=False):
        """Adds an accessor for values [element] or [element, component] and returns its index."""
        values = np.ascontiguousarray(values)
        rows = values.reshape(len(values), -1)
        accessor = {
            "bufferView": self.add_bytes(values.tobytes()),
            "componentType": _COMPONENTS[values.dtype],
            "count": len(rows),
            "type": _TYPES[rows.shape[1]],
        }
        if bounds:
            accessor["min"], accessor["max"] = rows.min(axis=0).tolist(), rows.max(axis=0).tolist()
        return self.add("accessors", accessor)

    def add_image(self, data, mime_type):
        return self.add("images", {"bufferView": self.add_bytes(data), "mimeType": mime_type})

    def write(self, path):
        self._bytes += b"\0" * (-len(self._bytes) % 4)
        if self._bytes:
            self.document["buffers"] = [{"byteLength": len(self._bytes)}]
        text = json.dumps(self.document).encode()
        text += b" " * (-len(text) % 4)
        length = 12 + 8 + len(text) + 8 + len(self._bytes)
        with open(path, "wb") as file:
            file.write(struct.pack("<4sII", b"glTF", 2, length))
            file.write(struct.pack("<I4s", len(text), b"JSON") + text)
            file.write(struct.pack("<I4s", len(self._bytes), b"BIN\0") + self._bytes)
