"""The cells of the grid of materials: one feature each, on a ball or a card of its own."""

import json
import pathlib


def texture(name, **more):
    """A reference to a texture of grid_textures.py; the generator turns the name into an index."""
    return {"texture": name, **more}


def metallic_roughness(color=(0.8, 0.8, 0.8), metal=0.0, rough=0.6, alpha=1.0, **more):
    return {"baseColorFactor": [*color, alpha], "metallicFactor": metal, "roughnessFactor": rough, **more}


def cell(name, shape="ball", extensions=None, lossless=False, material=None, attributes=(), **base):
    """`lossless`: returns all light, so under an even sky of 1 its radiance is 1."""
    out = {"pbrMetallicRoughness": metallic_roughness(**base), **(material or {})}
    if extensions:
        out["extensions"] = {f"KHR_{k}" if k.startswith("texture") else f"KHR_materials_{k}": v for k, v in extensions.items()}
    return {"name": name, "shape": shape, "material": out, "lossless": lossless, "attributes": attributes}


WHITE = (1.0, 1.0, 1.0)
BLACK = (0.0, 0.0, 0.0)
GOLD = (1.0, 0.77, 0.34)
LAMBERT = {"specular": {"specularFactor": 0.0}}


def core():
    yield cell("lambert_white", color=WHITE, extensions=LAMBERT, lossless=True)
    yield cell("base_factor", color=(0.7, 0.3, 0.1))
    yield cell("base_texture", "card", baseColorTexture=texture("colors"))
    yield cell("base_texcoord1", "card", baseColorTexture=texture("colors", texCoord=1))
    turned = {"KHR_texture_transform": {"offset": [0.2, 0.1], "rotation": 0.5, "scale": [2.0, 1.5]}}
    yield cell("texture_transform", "card", baseColorTexture=texture("colors", extensions=turned))
    yield cell("vertex_colors", "card", attributes=("COLOR_0",))
    yield cell("emissive_factor", color=BLACK, material={"emissiveFactor": [0.9, 0.5, 0.2]})
    lamp = {"emissiveFactor": [1, 1, 1], "emissiveTexture": texture("colors", texCoord=1)}
    yield cell("emissive_texcoord1", "card", color=BLACK, material=lamp)
    strong = {"emissive_strength": {"emissiveStrength": 4.0}}
    yield cell("emissive_strength", color=BLACK, extensions=strong, material={"emissiveFactor": [0.9, 0.5, 0.2]})
    yield cell("unlit", color=(0.2, 0.6, 0.4), extensions={"unlit": {}})
    wraps = {"KHR_texture_transform": {"offset": [-1.0, -1.0], "scale": [3.0, 3.0]}}
    for wrap in ("repeat", "clamp", "mirror"):
        yield cell(f"wrap_{wrap}", "card", baseColorTexture=texture("colors", sampler=wrap, extensions=wraps))
    yield cell("nearest", "card", baseColorTexture=texture("few", sampler="nearest"))
    yield cell("mask", "card", baseColorTexture=texture("dots"), material={"alphaMode": "MASK", "alphaCutoff": 0.5})
    yield cell("blend_constant", "card", alpha=0.3, material={"alphaMode": "BLEND"})
    yield cell("blend_texture", "card", baseColorTexture=texture("fade"), material={"alphaMode": "BLEND"})


def reliefs():
    for name, attributes in (("tangents", ("TANGENT",)), ("no_tangents", ()), ("mirrored", ("MIRRORED",))):
        relief = {"normalTexture": texture("bumps")}
        yield cell(f"normal_{name}", "card", extensions=LAMBERT, material=relief, attributes=attributes)
    yield cell("normal_scale", "card", extensions=LAMBERT, material={"normalTexture": texture("bumps", scale=0.4)})
    yield cell("normal_texcoord1", "card", extensions=LAMBERT, material={"normalTexture": texture("bumps", texCoord=1)})


def reflections():
    yield cell("metal_mirror", color=WHITE, metal=1.0, rough=0.0, lossless=True)
    for rough in (0.25, 0.5, 1.0):
        yield cell(f"metal_white_{rough}", color=WHITE, metal=1.0, rough=rough, lossless=True)
    yield cell("metal_gold", color=GOLD, metal=1.0, rough=0.4)
    mixed = {"metallicRoughnessTexture": texture("metals", texCoord=1)}
    yield cell("metal_texcoord1", "card", color=GOLD, metal=1.0, rough=1.0, **mixed)
    for rough in (0.1, 0.5):
        yield cell(f"plastic_{rough}", color=(0.1, 0.3, 0.6), rough=rough)
    yield cell("ior_2", color=BLACK, rough=0.3, extensions={"ior": {"ior": 2.0}})
    ior = {"ior": 1.8}
    yield cell("specular_factor", color=BLACK, rough=0.3, extensions={"ior": ior, "specular": {"specularFactor": 0.4}})
    tint = {"specularColorFactor": [1.0, 0.4, 0.1]}
    yield cell("specular_color", color=BLACK, rough=0.3, extensions={"ior": ior, "specular": tint})
    images = {"specularTexture": texture("fade"), "specularColorTexture": texture("colors")}
    yield cell("specular_textures", "card", color=BLACK, rough=0.3, extensions={"ior": ior, "specular": images})


def glasses():
    clear = {"transmissionFactor": 1.0}
    thick = {"thicknessFactor": 1.0}
    yield cell("glass_solid", color=WHITE, rough=0.0, extensions={"transmission": clear, "volume": thick}, lossless=True)
    dyed = {"thicknessFactor": 1.0, "attenuationDistance": 1.0, "attenuationColor": [0.9, 0.5, 0.2]}
    yield cell("glass_attenuation", color=WHITE, rough=0.0, extensions={"transmission": clear, "volume": dyed})
    images = {"thicknessFactor": 1.0, "thicknessTexture": texture("fade"), **{k: v for k, v in dyed.items() if k[0] == "a"}}
    yield cell("thickness_texture", color=WHITE, rough=0.0, extensions={"transmission": clear, "volume": images})
    yield cell("glass_thin", "card", color=(0.9, 0.7, 0.5), rough=0.0, extensions={"transmission": clear})
    yield cell("glass_rough", color=WHITE, rough=0.4, extensions={"transmission": clear, "volume": thick}, lossless=True)
    yield cell("glass_thin_rough", "card", color=WHITE, rough=0.4, extensions={"transmission": clear})
    part = {"transmissionFactor": 1.0, "transmissionTexture": texture("fade")}
    yield cell("transmission_texture", "card", rough=0.0, extensions={"transmission": part})
    spread = {"transmission": clear, "volume": thick, "ior": {"ior": 1.6}, "dispersion": {"dispersion": 2.0}}
    yield cell("dispersion", color=WHITE, rough=0.0, extensions=spread)


def layers():
    coat = {"clearcoatFactor": 1.0}
    dark = {"color": (0.4, 0.05, 0.05), "rough": 0.7}
    yield cell("clearcoat", extensions={"clearcoat": coat}, **dark)
    yield cell("clearcoat_rough", extensions={"clearcoat": {**coat, "clearcoatRoughnessFactor": 0.4}}, **dark)
    relief = {**coat, "clearcoatNormalTexture": texture("bumps"), "clearcoatRoughnessFactor": 0.2}
    yield cell("clearcoat_normal", "card", extensions={"clearcoat": relief}, **dark)
    for rough in (0.3, 0.7):
        cloth = {"sheenColorFactor": [0.9, 0.8, 0.7], "sheenRoughnessFactor": rough}
        yield cell(f"sheen_{rough}", color=(0.2, 0.1, 0.1), rough=1.0, extensions={"sheen": cloth})
    for name, turn in (("anisotropy", 0.0), ("anisotropy_turned", 0.8)):
        brushed = {"anisotropyStrength": 0.8, "anisotropyRotation": turn}
        brush = {"anisotropy": brushed}
        yield cell(name, color=GOLD, metal=1.0, rough=0.4, extensions=brush, attributes=("TANGENT",))
    film = {"iridescenceFactor": 1.0, "iridescenceIor": 1.5, "iridescenceThicknessMaximum": 400.0}
    yield cell("iridescence", color=WHITE, metal=1.0, rough=0.2, extensions={"iridescence": film})
    leaf = {"diffuseTransmissionFactor": 0.6, "diffuseTransmissionColorFactor": [0.3, 0.8, 0.2]}
    yield cell("diffuse_transmission", "card", extensions={"diffuse_transmission": leaf})


def cells():
    for group in (core, reliefs, reflections, glasses, layers):
        yield from group()


def main():
    """Writes grid_cells.json, which tests/materials reads: run it again where a cell has changed."""
    lines = ",\n".join(json.dumps(what) for what in cells())
    pathlib.Path(__file__).with_suffix(".json").write_text(f"[\n{lines}\n]\n")


if __name__ == "__main__":
    main()
