"""Blender's materials as glTF materials."""

from dataclasses import dataclass, field

import numpy as np

from . import image_pixels
from .nodes import Input, has_nodes, image_node_of, nearest_image, number_of, surface_node

_GREY = (0.8, 0.8, 0.8)  # colour of objects without a material in Cycles


@dataclass(frozen=True)
class Mapping:
    """The coordinates of a texture: a UV map (empty: the one for rendering) and a transform of it."""

    uv_map: str = ""
    matrix: tuple = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0)  # two rows of u, v, 1


@dataclass
class Surface:
    """A material of the file, and the mesh data that its primitives need."""

    index: int
    mapping: Mapping | None = None  # None: no textures
    color_attribute: str = ""


@dataclass
class _Reading:
    """A material while it is read."""

    name: str
    definition: dict
    mapping: Mapping | None = None
    color_attribute: str = ""
    notes: list = field(default_factory=list)


class Materials:
    """The materials and pictures of a file, without duplicates."""

    def __init__(self, gltf, notes):
        self._gltf, self._notes, self._surfaces, self._images = gltf, notes, {}, {}
        self.glow = False  # whether any material glows

    def surface(self, material):
        """The file's material for one of Blender, or for None."""
        key = material.name_full if material is not None else None
        if key not in self._surfaces:
            self._surfaces[key] = self._add(material)
        return self._surfaces[key]

    def _add(self, material):
        name = material.name if material is not None else ""
        reading = _Reading(name, {"name": name, "doubleSided": material is None or not material.use_backface_culling})
        self._read(material, reading)
        self._notes.extend(note for note in reading.notes if note not in self._notes)
        for extension in reading.definition.get("extensions", {}):
            self._gltf.use(extension)
        return Surface(self._gltf.add("materials", reading.definition), reading.mapping, reading.color_attribute)

    def _read(self, material, reading):
        if material is None or not has_nodes(material):
            _set_color(reading.definition, material.diffuse_color[:3] if material is not None else _GREY)
            _make_lambertian(reading.definition)
            return
        node = surface_node(material, reading.notes)
        if node is None:
            reading.notes.append(f'material "{material.name}" has no Principled, Diffuse or Emission node: it is taken as grey')
            _set_color(reading.definition, _GREY)
            _make_lambertian(reading.definition)
        elif node.type == "EMISSION":
            _set_color(reading.definition, (0.0, 0.0, 0.0))
            _make_lambertian(reading.definition)
            self._read_emission(node, ("Color",), ("Strength",), reading)
        elif node.type == "BSDF_DIFFUSE":
            self._read_color(Input(node, "Color"), reading)
            _make_lambertian(reading.definition)
        else:
            self._read_principled(node, reading)

    def _read_principled(self, node, reading):
        pbr = self._read_color(Input(node, "Base Color"), reading)
        for name in ("Metallic", "Roughness"):
            pbr[f"{name.lower()}Factor"] = _clamped(number_of(Input(node, name), reading))
        extensions = reading.definition.setdefault("extensions", {})
        specular = 2.0 * number_of(Input(node, "Specular IOR Level", "Specular"), reading)
        extensions["KHR_materials_specular"] = {"specularFactor": _clamped(specular)}
        extensions["KHR_materials_ior"] = {"ior": max(1.0, number_of(Input(node, "IOR"), reading))}
        transmission = number_of(Input(node, "Transmission Weight", "Transmission"), reading)
        if transmission > 0.0:
            extensions["KHR_materials_transmission"] = {"transmissionFactor": _clamped(transmission)}
            extensions["KHR_materials_volume"] = {"thicknessFactor": 1.0}
        self._read_emission(node, ("Emission Color", "Emission"), ("Emission Strength",), reading)
        self._read_alpha(Input(node, "Alpha"), pbr, reading)

    def _read_color(self, socket, reading):
        pbr = reading.definition.setdefault("pbrMetallicRoughness", {})
        texture = self._texture(socket.source(), reading)
        if texture is None and socket.constant() is None and socket.color_attribute() is None:
            texture = self._texture_behind(socket, reading)
        if texture is not None:
            pbr["baseColorTexture"] = texture
        else:
            attribute = socket.color_attribute()
            reading.color_attribute = attribute or ""
            _set_color(reading.definition, (1.0, 1.0, 1.0) if attribute else self._plain_color(socket, reading))
        return pbr

    def _read_emission(self, node, colors, strengths, reading):
        strength = number_of(Input(node, *strengths), reading)
        socket = Input(node, *colors)
        if strength <= 0.0:
            return
        texture = self._texture(socket.source(), reading)
        color = (1.0, 1.0, 1.0) if texture is not None else self._plain_color(socket, reading)
        if texture is not None:
            reading.definition["emissiveTexture"] = texture
        radiance = strength * np.maximum(np.array(color[:3], dtype=float), 0.0)
        most = float(radiance.max())
        if most <= 0.0:
            return
        self.glow = True
        reading.definition["emissiveFactor"] = (radiance / most).tolist()
        reading.definition.setdefault("extensions", {})["KHR_materials_emissive_strength"] = {"emissiveStrength": most}

    def _read_alpha(self, socket, pbr, reading):
        node = socket.source()
        if node is not None and node.type == "TEX_IMAGE" and "baseColorTexture" in pbr:
            reading.definition["alphaMode"] = "BLEND"
            return
        alpha = _clamped(number_of(socket, reading))
        if alpha < 1.0:
            color = pbr.get("baseColorFactor", [1.0, 1.0, 1.0, 1.0])
            pbr["baseColorFactor"] = [*color[:3], alpha]
            reading.definition["alphaMode"] = "BLEND"

    def _plain_color(self, socket, reading):
        """A colour without a texture; a texture on no UV map is replaced by its mean."""
        constant = socket.constant()
        if constant is not None:
            return constant
        node = socket.source()
        if node.type == "TEX_IMAGE" and node.image is not None:
            image_pixels.check(node.image, f'material "{reading.name}"')
            reading.notes.append(f'"{node.image.name}" of material "{reading.name}" lies on no UV map: its mean colour is used')
            return image_pixels.linear_pixels(node.image)[..., :3].mean(axis=(0, 1)).tolist()
        reading.notes.append(f'{socket.label()} of material "{reading.name}" comes from a node that is not read ({node.name}): its own value is used')
        return socket.value()

    def _texture_behind(self, socket, reading):
        """The texture that reaches a socket through nodes that are not read."""
        node = nearest_image(socket.source())
        texture = self._texture(node, reading)
        if texture is not None:
            through = socket.source().name
            reading.notes.append(f'{socket.label()} of material "{reading.name}" comes through a node that is not read ({through}): "{node.image.name}" is used unchanged')
        return texture

    def _texture(self, node, reading):
        """The file's texture if a node is a picture on a UV map, else None."""
        if node is None or node.type != "TEX_IMAGE" or node.image is None:
            return None
        image_pixels.check(node.image, f'material "{reading.name}"')
        place = image_node_of(node)
        if place is None:
            return None
        mapping = Mapping(*place)
        if reading.mapping not in (None, mapping):
            reading.notes.append(f'"{node.image.name}" of material "{reading.name}" lies on another UV map than its colour: its mean is used')
            return None
        reading.mapping = mapping
        return {"index": self._gltf.add("textures", {"source": self._image(node.image), "sampler": self._sampler(node)})}

    def _sampler(self, node):
        wrap = {"REPEAT": 10497, "MIRROR": 33648}.get(node.extension, 33071)
        nearest = node.interpolation == "Closest"
        return self._gltf.add("samplers", {"wrapS": wrap, "wrapT": wrap, "magFilter": 9728 if nearest else 9729})

    def _image(self, image):
        key = image.name_full
        if key not in self._images:
            self._images[key] = self._gltf.add_image(*image_pixels.color_file(image))
        return self._images[key]


def _set_color(definition, color):
    pbr = definition.setdefault("pbrMetallicRoughness", {})
    pbr["baseColorFactor"] = [_clamped(c) for c in color[:3]] + [1.0]


def _make_lambertian(definition):
    definition["pbrMetallicRoughness"].update({"metallicFactor": 0.0, "roughnessFactor": 1.0})
    definition.setdefault("extensions", {})["KHR_materials_specular"] = {"specularFactor": 0.0}


def _clamped(value):
    return min(1.0, max(0.0, float(value)))
