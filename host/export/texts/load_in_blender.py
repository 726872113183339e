"""Imports a scene that Prelight exported and shows its light map (Blender 3.6 and later).

    blender --python load_in_blender.py

Materials emit what their diffuse part reflects of the light map: base colour x irradiance / pi.
"""

import math
import pathlib

import bpy

NAME = "{NAME}"
SIDES_APART = 1e-4  # of a mesh's size
FOLDER = pathlib.Path(__file__).resolve().parent if "__file__" in globals() else pathlib.Path(bpy.path.abspath("//"))


def show_light_map(material, layer, image):
    """Adds what a material reflects of the light map to what it emits itself."""
    nodes, links = material.node_tree.nodes, material.node_tree.links
    output = next((node for node in nodes if node.type == "OUTPUT_MATERIAL" and node.is_active_output), None)
    shader = next((node for node in nodes if node.type == "BSDF_PRINCIPLED"), None)
    if output is None or shader is None or not output.inputs["Surface"].is_linked:
        return
    coordinates = nodes.new("ShaderNodeUVMap")
    coordinates.uv_map = layer
    texture = nodes.new("ShaderNodeTexImage")
    texture.image, texture.interpolation, texture.extension = image, "Linear", "EXTEND"
    links.new(coordinates.outputs["UV"], texture.inputs["Vector"])
    reflected = nodes.new("ShaderNodeVectorMath")
    reflected.operation = "MULTIPLY"
    links.new(texture.outputs["Color"], reflected.inputs[0])
    set_or_link(links, shader.inputs["Base Color"], reflected.inputs[1])
    diffuse = nodes.new("ShaderNodeMath")  # metals reflect nothing diffusely
    diffuse.operation = "SUBTRACT"
    diffuse.inputs[0].default_value = 1.0
    set_or_link(links, shader.inputs["Metallic"], diffuse.inputs[1])
    strength = nodes.new("ShaderNodeMath")
    strength.operation = "MULTIPLY"
    strength.inputs[1].default_value = 1.0 / math.pi
    links.new(diffuse.outputs[0], strength.inputs[0])
    emission = nodes.new("ShaderNodeEmission")
    links.new(reflected.outputs[0], emission.inputs["Color"])
    links.new(strength.outputs[0], emission.inputs["Strength"])
    darken(links, shader)
    both = nodes.new("ShaderNodeAddShader")
    links.new(output.inputs["Surface"].links[0].from_socket, both.inputs[0])
    links.new(emission.outputs[0], both.inputs[1])
    links.new(both.outputs[0], output.inputs["Surface"])


def darken(links, shader):
    """Lamps must not light a surface again whose light is in the map; what it emits itself stays."""
    for link in list(shader.inputs["Base Color"].links):
        links.remove(link)
    shader.inputs["Base Color"].default_value = (0.0, 0.0, 0.0, 1.0)
    for name in ("Specular IOR Level", "Specular", "Coat Weight", "Clearcoat", "Sheen Weight", "Sheen"):
        if name in shader.inputs:
            for link in list(shader.inputs[name].links):
                links.remove(link)
            shader.inputs[name].default_value = 0.0


def set_or_link(links, source, target):
    """Gives an input what another one has: its link or its value."""
    if source.is_linked:
        links.new(source.links[0].from_socket, target)
    elif hasattr(target.default_value, "__len__"):
        target.default_value = source.default_value[: len(target.default_value)]
    else:
        target.default_value = source.default_value


def part_sides(mesh):
    """Cycles draws both sides of every face: where fronts and backs have light of their own, each is moved outwards a little."""
    parted = {i for i, material in enumerate(mesh.materials) if material is not None and material.get("prelight_two_sides")}
    moved = {vertex for face in mesh.polygons if face.material_index in parted for vertex in face.vertices}
    if not moved:
        return
    places = [vertex.co for vertex in mesh.vertices]
    step = SIDES_APART * max(max(p[axis] for p in places) - min(p[axis] for p in places) for axis in range(3))
    offsets = {vertex: step * mesh.vertices[vertex].normal for vertex in moved}
    shapes = [key.data for key in mesh.shape_keys.key_blocks] if mesh.shape_keys else []
    for points in [mesh.vertices, *shapes]:
        for vertex, offset in offsets.items():
            points[vertex].co += offset


def load(folder=FOLDER, name=NAME):
    before = set(bpy.data.objects)
    bpy.ops.import_scene.gltf(filepath=str(folder / f"{name}.glb"))
    image = bpy.data.images.load(str(folder / f"{name}.lightmap.exr"))
    image.colorspace_settings.name = "Non-Color"
    shown = set()
    objects = [o for o in bpy.data.objects if o not in before and o.type == "MESH"]
    for mesh in {o.data for o in objects}:
        part_sides(mesh)
    for mesh_object in objects:
        layers = mesh_object.data.uv_layers
        for slot in mesh_object.material_slots:
            material = slot.material
            texcoord = material.get("prelight_light_map", -1) if material is not None else -1
            if not 0 <= texcoord < len(layers) or material in shown:
                continue
            show_light_map(material, layers[texcoord].name, image)
            shown.add(material)
    return objects


if __name__ == "__main__":
    load()
