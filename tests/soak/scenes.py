"""Random scenes: built-in ones, and small glTF files with many nodes, lamps and degenerate triangles."""
import base64
import json
import pathlib
import struct

BUILT_IN = ["cornell", "shapes", "caustics", "rooms", "swing", "lake"]
FLOAT, UINT16 = 5126, 5123


def vertices_of(random, count):
    """Returns positions [vertex][axis], some of them equal or far away."""
    points = [[random.uniform(-1, 1) for _ in range(3)] for _ in range(count)]
    if random.random() < 0.3:
        points[random.randrange(count)] = list(points[0])
    if random.random() < 0.1:
        points[random.randrange(count)] = [random.choice([1e4, -1e4, 1e-30]) for _ in range(3)]
    return points


def mesh_buffer(random):
    """Returns a buffer of positions and indices, and the accessors and views that describe it."""
    points = vertices_of(random, random.randint(3, 40))
    triangles = [[random.randrange(len(points)) for _ in range(3)] for _ in range(random.randint(1, 60))]
    positions = b"".join(struct.pack("<3f", *point) for point in points)
    indices = b"".join(struct.pack("<3H", *triangle) for triangle in triangles)
    # Limits are those of the stored floats.
    stored = [struct.unpack("<3f", positions[i:i + 12]) for i in range(0, len(positions), 12)]
    views = [{"buffer": 0, "byteOffset": 0, "byteLength": len(positions)},
             {"buffer": 0, "byteOffset": len(positions), "byteLength": len(indices)}]
    accessors = [{"bufferView": 0, "componentType": FLOAT, "type": "VEC3", "count": len(points),
                  "min": [min(axis) for axis in zip(*stored)], "max": [max(axis) for axis in zip(*stored)]},
                 {"bufferView": 1, "componentType": UINT16, "type": "SCALAR", "count": 3 * len(triangles)}]
    return positions + indices, views, accessors


def random_node(random, lamps):
    node = {"translation": [random.uniform(-3, 3) for _ in range(3)],
            "scale": [random.choice([1, 1, 0.5, 2, -1, 0]) for _ in range(3)]}
    if lamps and random.random() < 0.3:
        node["extensions"] = {"KHR_lights_punctual": {"light": random.randrange(len(lamps))}}
    else:
        node["mesh"] = 0
    return node


def random_lamp(random):
    lamp = {"type": random.choice(["point", "directional", "spot"]), "intensity": random.choice([0, 1, 20, 1e6]),
            "color": [random.random() for _ in range(3)]}
    if lamp["type"] == "spot":
        lamp["spot"] = {}
    return lamp


def random_material(random):
    return {"pbrMetallicRoughness": {"baseColorFactor": [random.random() for _ in range(3)] + [1],
                                     "metallicFactor": random.choice([0, 1, 0.5]), "roughnessFactor": random.random()},
            "emissiveFactor": random.choice([[0, 0, 0], [1, 0.5, 0.2]]), "doubleSided": random.random() < 0.5}


def random_gltf(random):
    """Returns a valid glTF document, as JSON with its buffer within."""
    data, views, accessors = mesh_buffer(random)
    lamps = [random_lamp(random) for _ in range(random.randint(0, 3))]
    nodes = [random_node(random, lamps) for _ in range(random.randint(1, 12))]
    nodes[0].pop("extensions", None)
    nodes[0].update(mesh=0, scale=[1, 1, 1])
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes,
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [random_material(random)], "accessors": accessors, "bufferViews": views,
        "buffers": [{"byteLength": len(data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}
    if lamps:
        document["extensionsUsed"] = ["KHR_lights_punctual"]
        document["extensions"] = {"KHR_lights_punctual": {"lights": lamps}}
    return json.dumps(document)


def make_scene(random, run, folder):
    """Writes a scene into a folder and returns its name; `run` runs the program's commands there."""
    if random.random() < 0.5:
        run(["scene", random.choice(BUILT_IN), "-o", "scene.glb"])
        return "scene.glb"
    (pathlib.Path(folder) / "scene.gltf").write_text(random_gltf(random))
    return "scene.gltf"


def spoil(random, path):
    """Cuts a file short or changes some of its bytes."""
    data = bytearray(path.read_bytes())
    if random.random() < 0.5:
        del data[random.randrange(len(data)):]
    else:
        for _ in range(random.randint(1, 8)):
            data[random.randrange(len(data))] = random.randrange(256)
    path.write_bytes(data)
