"""Reads material nodes, as far as Prelight follows them."""

import math

import bpy

from . import image_pixels

_SURFACES = ("BSDF_PRINCIPLED", "BSDF_DIFFUSE", "EMISSION")


def has_nodes(block):
    """Whether a material or a world is made of nodes, as all are since Blender 5."""
    return block.node_tree is not None and (bpy.app.version >= (5, 0, 0) or block.use_nodes)


class Input:
    """An input of a node, found by the first of several names that the node has."""

    def __init__(self, node, *names):
        self.socket = next((node.inputs[name] for name in names if name in node.inputs), None)
        self.names = names

    def label(self):
        return self.names[0]

    def source(self):
        """The node that feeds the input, or None if it has a value of its own."""
        return None if self.socket is None else source_of(self.socket)

    def value(self):
        """The value of the input itself."""
        value = getattr(self.socket, "default_value", 0.0)
        return tuple(value) if hasattr(value, "__len__") else float(value)

    def constant(self):
        """The input's value if it does not come from a texture or a calculation, else None."""
        node = self.source()
        if node is None:
            return self.value()
        if node.type in ("RGB", "VALUE"):
            value = node.outputs[0].default_value
            return tuple(value) if hasattr(value, "__len__") else float(value)
        return None

    def color_attribute(self):
        node = self.source()
        if node is not None and node.type == "VERTEX_COLOR":
            return node.layer_name
        if node is not None and node.type == "ATTRIBUTE" and node.attribute_type == "GEOMETRY":
            return node.attribute_name
        return None


def source_of(socket):
    while socket.is_linked:
        node = socket.links[0].from_node
        if node.type != "REROUTE":
            return node
        socket = node.inputs[0]
    return None


def _upstream(first, follows):
    """A node and those that feed it through inputs that `follows` accepts, the nearest first."""
    waiting, seen = [first], set()
    while waiting:
        node = waiting.pop(0)
        if node is None or node in seen:
            continue
        seen.add(node)
        yield node
        waiting.extend(source_of(socket) for socket in node.inputs if follows(socket))


def nearest_image(node):
    """The nearest image texture that feeds a node, which may be the node itself."""
    nodes = _upstream(node, lambda socket: socket.type != "VECTOR")
    return next((node for node in nodes if node.type == "TEX_IMAGE" and node.image is not None), None)


def mean_of(socket):
    """The mean of the number that a picture gives, as one of its channels or as grey; None if no picture gives it."""
    node, channel = socket.source(), None
    if node is not None and node.type in ("SEPARATE_COLOR", "SEPRGB"):
        channel = "RGB".find(socket.socket.links[0].from_socket.name[0])
        node = source_of(node.inputs[0])
    if node is None or node.type != "TEX_IMAGE" or node.image is None:
        return None
    means = image_pixels.linear_pixels(node.image).mean(axis=(0, 1))
    if channel is None and socket.socket.links[0].from_socket.name == "Alpha":
        channel = 3
    return float(means[:3].mean() if channel is None else means[channel])


def number_of(socket, reading):
    """A number, or the mean of a picture. A note says so if other nodes compute the number, which are not followed."""
    value = socket.constant()
    if value is None:
        image = socket.source() and nearest_image(socket.source())
        if image:
            image_pixels.check(image.image, f'material "{reading.name}"')
        value = mean_of(socket)
    if value is None:
        reading.notes.append(f'{socket.label()} of material "{reading.name}" comes from nodes that are not read: its own value is used')
        value = socket.value()
    return sum(value[:3]) / 3.0 if isinstance(value, tuple) else value


def output_node(tree):
    outputs = [node for node in tree.nodes if node.type == "OUTPUT_MATERIAL"]
    return next((node for node in outputs if node.is_active_output), outputs[0] if outputs else None)


def surface_node(material, notes):
    """The node that defines a surface: the one at the output, or the nearest one behind mix shaders."""
    output = output_node(material.node_tree)
    first = source_of(output.inputs["Surface"]) if output is not None else None
    node = next((node for node in _upstream(first, lambda socket: socket.type == "SHADER") if node.type in _SURFACES), None)
    if node is not None and node != first:
        notes.append(f'material "{material.name}" mixes shaders: only its {node.name} is used')
    return node


def image_node_of(node):
    """(UV map, rows of its transform) of an image texture, or None if it does not lie on a UV map."""
    matrix = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0)
    if node.projection != "FLAT":
        return None
    source = source_of(node.inputs["Vector"])
    if source is not None and source.type == "MAPPING":
        if source.vector_type != "POINT" or any(s.is_linked for s in source.inputs if s.name != "Vector"):
            return None
        matrix = _mapping_rows(source)
        node, source = source, source_of(source.inputs["Vector"])
        if source is None:
            return None  # Mapping without an input maps a single point
    if source is None:
        return "", matrix
    if source.type == "UVMAP":
        return source.uv_map, matrix
    if source.type == "TEX_COORD":
        return ("", matrix) if node.inputs["Vector"].links[0].from_socket.name == "UV" else None
    return None


def _mapping_rows(node):
    """The rows of a transform that scales, then turns about Z, then moves."""
    move, turn, scale = (node.inputs[name].default_value for name in ("Location", "Rotation", "Scale"))
    c, s = math.cos(turn[2]), math.sin(turn[2])
    return (c * scale[0], -s * scale[1], move[0], s * scale[0], c * scale[1], move[1])
