"""Materials that show a bake. Meshes keep their own materials, which those of their objects override."""

import math

import bpy

from . import results
from .nodes import has_nodes, output_node, surface_node

_GROUP = "Prelight Baked Light"
_ATTRIBUTES = {"AO": results.AO, "LIGHT": results.LIGHT}


def original_of(material):
    """The original of a material that shows a bake; any other material is returned itself."""
    return material.prelight_original if material is not None and material.prelight_is_shown else material


def show(items, what):
    """Gives objects materials that emit base colour x irradiance / pi, or the occlusion itself."""
    hide(items)
    made = {}
    for item in items:
        if not item.data.materials:
            item.data.materials.append(None)
        image, backs = results.light_map_of(item.data), what == "LIGHT_MAP" and results.UV_BACK in item.data.uv_layers
        for slot in item.material_slots:
            key = slot.material, image, backs
            if key not in made:
                made[key] = _material(slot.material, what, image, backs)
            slot.link = "OBJECT"
            slot.material = made[key]


def hide(items):
    """Gives objects their own materials again."""
    for item in items:
        for slot in item.material_slots:
            material = slot.material
            if material is None or not material.prelight_is_shown:
                continue
            original = material.prelight_original
            slot.material = None
            slot.link = "DATA"
            if slot.material != original:  # the object had a material of its own before
                slot.link = "OBJECT"
                slot.material = original
            if material.users == 0:
                bpy.data.materials.remove(material)


def is_shown(item):
    return any(slot.material is not None and slot.material.prelight_is_shown for slot in item.material_slots)


def has_result(item, what):
    """Whether a mesh holds the result that materials would show."""
    if what in _ATTRIBUTES:
        return _ATTRIBUTES[what] in item.data.attributes
    return results.light_map_of(item.data) is not None and results.UV in item.data.uv_layers


def _material(original, what, image, backs):
    name = f"{original.name if original is not None else 'Default'} ({_ATTRIBUTES.get(what, results.LIGHT_MAP)})"
    material = original.copy() if original is not None else bpy.data.materials.new(name)
    material.name = name
    material.prelight_original, material.prelight_is_shown = original, True
    if not has_nodes(material):
        color = material.diffuse_color[:]
        material.use_nodes = True
        surface = surface_node(material, [])
        if surface is not None and "Base Color" in surface.inputs:
            surface.inputs["Base Color"].default_value = color if original is not None else (0.8, 0.8, 0.8, 1.0)
    _show_in(material, what, image, backs)
    return material


def _show_in(material, what, image, backs):
    tree = material.node_tree
    output = output_node(tree) or tree.nodes.new("ShaderNodeOutputMaterial")
    shader = surface_node(material, [])
    light = _attribute(tree, _ATTRIBUTES[what]) if what in _ATTRIBUTES else _look_up(tree, image, backs)
    group = tree.nodes.new("ShaderNodeGroup")
    group.node_tree = _node_group(occlusion=what == "AO")
    tree.links.new(light, group.inputs["Light"])
    shown = group.outputs["Shader"]
    if shader is not None and what != "AO":
        color = shader.inputs["Base Color" if shader.type == "BSDF_PRINCIPLED" else "Color"]
        if shader.type == "EMISSION":
            return  # a glowing surface shows only its own light
        _connect(tree, color, group.inputs["Base Color"])
        if shader.type == "BSDF_PRINCIPLED":
            _connect(tree, shader.inputs["Metallic"], group.inputs["Metallic"])
        _darken(tree, shader)
        both = tree.nodes.new("ShaderNodeAddShader")
        tree.links.new(output.inputs["Surface"].links[0].from_socket, both.inputs[0])
        tree.links.new(shown, both.inputs[1])
        shown = both.outputs[0]
    tree.links.new(shown, output.inputs["Surface"])


def _attribute(tree, name):
    node = tree.nodes.new("ShaderNodeAttribute")
    node.attribute_name = name
    return node.outputs["Color"]


def _look_up(tree, image, backs):
    texture = tree.nodes.new("ShaderNodeTexImage")
    texture.image, texture.interpolation, texture.extension = image, "Linear", "EXTEND"
    place = _uv(tree, results.UV)
    if backs:
        mix = tree.nodes.new("ShaderNodeMix")
        mix.data_type = "VECTOR"
        tree.links.new(tree.nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"], mix.inputs["Factor"])
        vectors = [socket for socket in mix.inputs if socket.type == "VECTOR"]
        a, b = [socket for socket in vectors if socket.name in ("A", "B")]
        tree.links.new(place, a)
        tree.links.new(_uv(tree, results.UV_BACK), b)
        place = next(socket for socket in mix.outputs if socket.type == "VECTOR")
    tree.links.new(place, texture.inputs["Vector"])
    return texture.outputs["Color"]


def _uv(tree, name):
    node = tree.nodes.new("ShaderNodeUVMap")
    node.uv_map = name
    return node.outputs["UV"]


def _connect(tree, source, target):
    if source.is_linked:
        tree.links.new(source.links[0].from_socket, target)
    else:
        target.default_value = source.default_value


def _darken(tree, shader):
    """Stops lamps from lighting a surface again whose light is baked. Its own emission stays."""
    for name in ("Base Color", "Color", "Specular IOR Level", "Specular", "Coat Weight", "Clearcoat", "Sheen Weight", "Sheen"):
        if name not in shader.inputs:
            continue
        socket = shader.inputs[name]
        for link in list(socket.links):
            tree.links.remove(link)
        socket.default_value = (0.0, 0.0, 0.0, 1.0) if hasattr(socket.default_value, "__len__") else 0.0


def _node_group(occlusion):
    """A node group that emits base colour x (1 - metallic) x light / pi, or the light itself."""
    name = f"{_GROUP} (AO)" if occlusion else _GROUP
    found = bpy.data.node_groups.get((name, None))
    if found is not None:
        return found
    tree = bpy.data.node_groups.new(name, "ShaderNodeTree")
    _add_socket(tree, "Base Color", "NodeSocketColor", (0.8, 0.8, 0.8, 1.0))
    _add_socket(tree, "Metallic", "NodeSocketFloat", 0.0)
    _add_socket(tree, "Light", "NodeSocketColor", (0.0, 0.0, 0.0, 1.0))
    _add_socket(tree, "Shader", "NodeSocketShader", None)
    entry, leaving = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    emission = tree.nodes.new("ShaderNodeEmission")
    light = entry.outputs["Light"]
    if not occlusion:
        product = tree.nodes.new("ShaderNodeVectorMath")
        product.operation = "MULTIPLY"
        tree.links.new(entry.outputs["Base Color"], product.inputs[0])
        tree.links.new(light, product.inputs[1])
        light = product.outputs[0]
        strength = tree.nodes.new("ShaderNodeMath")  # (1 - metallic) / pi, because metals reflect nothing diffusely
        strength.operation = "MULTIPLY_ADD"
        strength.inputs[1].default_value, strength.inputs[2].default_value = -1.0 / math.pi, 1.0 / math.pi
        tree.links.new(entry.outputs["Metallic"], strength.inputs[0])
        tree.links.new(strength.outputs[0], emission.inputs["Strength"])
    tree.links.new(light, emission.inputs["Color"])
    tree.links.new(emission.outputs[0], leaving.inputs["Shader"])
    return tree


def _add_socket(tree, name, kind, value):
    leaves = kind == "NodeSocketShader"
    if hasattr(tree, "interface"):  # since Blender 4.0
        socket = tree.interface.new_socket(name, in_out="OUTPUT" if leaves else "INPUT", socket_type=kind)
    else:
        socket = (tree.outputs if leaves else tree.inputs).new(kind, name)
    if value is not None:
        socket.default_value = value
