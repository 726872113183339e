"""What must hold of the files that a command leaves."""
import array
import json
import math
import struct

TEMPORARY = ".prelight-"
FLOAT = 5126


class Fault(Exception):
    """Something that the program promises does not hold."""


def read_glb(data, name):
    """Returns the JSON and the bytes of a .glb."""
    if len(data) < 20 or data[:4] != b"glTF" or struct.unpack_from("<I", data, 8)[0] != len(data):
        raise Fault(f"{name}: no whole .glb")
    length = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20:20 + length]), data[28 + length:]


def check_finite(document, binary, name):
    for index, accessor in enumerate(document.get("accessors", [])):
        view = document["bufferViews"][accessor["bufferView"]] if "bufferView" in accessor else None
        if accessor["componentType"] != FLOAT or view is None or view.get("extensions") or "byteStride" in view:
            continue
        start, length = view.get("byteOffset", 0), view["byteLength"] // 4 * 4
        if not all(map(math.isfinite, array.array("f", binary[start:start + length]))):
            raise Fault(f"{name}: accessor {index} has a number that is not finite")


def content_of(path):
    """Returns what two equal runs write alike, after checks that the file is whole."""
    data, name = path.read_bytes(), path.name
    if name.endswith(".glb"):
        document, binary = read_glb(data, name)
        check_finite(document, binary, name)
        document.get("extensions", {}).get("PRELIGHT_transfer", {}).pop("seconds", None)
        return json.dumps(document).encode() + binary
    if name.endswith((".json", ".gltf")):
        json.loads(data)
        return b"a report" if name == "report.json" else data
    if name.endswith(".png") and not (data.startswith(b"\x89PNG") and data.endswith(b"IEND\xaeB\x60\x82")):
        raise Fault(f"{name}: no whole picture")
    if name.endswith(".exr") and not data.startswith(b"\x76\x2f\x31\x01"):
        raise Fault(f"{name}: no whole picture")
    return data


def contents_of(folder, inputs):
    """Returns what lies in a folder beside the inputs, [path below the folder]."""
    return {str(path.relative_to(folder)): content_of(path) for path in sorted(folder.rglob("*"))
            if path.is_file() and path.name not in inputs and not is_left_of_a_kill(path)
            and not path.name.endswith(".state")}


def is_left_of_a_kill(path):
    return path.name.startswith(TEMPORARY)


def check_leftovers(place, killed):
    """Only a killed process leaves temporary files."""
    left = [path for root in (place.folder, place.spill) for path in root.rglob("*") if is_left_of_a_kill(path)]
    left += [path for path in place.spill.iterdir() if path not in left]
    if left and not killed:
        raise Fault("temporary files are left: " + ", ".join(path.name for path in left))


def check_part(got, whole, what):
    """Some of a command's outputs may be there when it fails, each of them whole."""
    for name, content in got.items():
        if content != whole.get(name):
            raise Fault(f"{what}: {name} is another, or not expected")


def check_same(got, expected, what):
    if set(got) != set(expected):
        raise Fault(f"{what}: files {sorted(got)}, expected {sorted(expected)}")
    for name, content in got.items():
        if content != expected[name]:
            raise Fault(f"{what}: {name} is another")
