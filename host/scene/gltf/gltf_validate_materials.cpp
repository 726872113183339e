#include <fmt/format.h>

#include <initializer_list>
#include <utility>

#include "scene/gltf/gltf_use.h"
#include "scene/gltf/gltf_validate.h"

namespace prelight {

namespace {

void validateNumbers(const JsonCursor& object, std::initializer_list<const char*> names) {
  for (const char* name : names) object.numberOr(name, 0.0);
}

void validateColors(const JsonCursor& object,
                    std::initializer_list<std::pair<const char*, std::size_t>> names) {
  for (const auto& [name, components] : names) {
    if (const auto color = object.find(name)) color->expectNumbers(components);
  }
}

void validateTextureInfo(const JsonCursor& root, const JsonCursor& object, const char* name) {
  const auto info = object.find(name);
  if (!info) return;
  const std::size_t index = info->at("index").asIndex(root.countOf("textures"), "texture");
  const JsonCursor texture = root.at("textures").at(index);
  texture.expectObject();
  validateTextureSource(root, texture);
  info->unsignedOr("texCoord", 0);
  const auto extensions = info->find("extensions");
  const auto transform = extensions ? extensions->find("KHR_texture_transform") : std::nullopt;
  if (!transform) return;
  validateColors(*transform, {{"offset", 2}, {"scale", 2}});
  validateNumbers(*transform, {"rotation"});
  transform->unsignedOr("texCoord", 0);
}

void validateMaterialExtensions(const JsonCursor& root, const JsonCursor& extensions) {
  extensions.expectObject();
  if (const auto e = extensions.find("KHR_materials_emissive_strength"))
    validateNumbers(*e, {"emissiveStrength"});
  if (const auto e = extensions.find("KHR_materials_ior")) validateNumbers(*e, {"ior"});
  if (const auto e = extensions.find("KHR_materials_unlit")) e->expectObject();
  if (const auto e = extensions.find("KHR_materials_transmission")) {
    validateNumbers(*e, {"transmissionFactor"});
    validateTextureInfo(root, *e, "transmissionTexture");
  }
  if (const auto e = extensions.find("KHR_materials_diffuse_transmission")) {
    validateNumbers(*e, {"diffuseTransmissionFactor"});
    validateColors(*e, {{"diffuseTransmissionColorFactor", 3}});
    validateTextureInfo(root, *e, "diffuseTransmissionTexture");
    validateTextureInfo(root, *e, "diffuseTransmissionColorTexture");
  }
  if (const auto e = extensions.find("KHR_materials_volume")) {
    validateNumbers(*e, {"thicknessFactor", "attenuationDistance"});
    validateColors(*e, {{"attenuationColor", 3}});
  }
  if (const auto e = extensions.find("KHR_materials_volume_scatter")) {
    validateNumbers(*e, {"scatterAnisotropy"});
    validateColors(*e, {{"multiscatterColor", 3}});
  }
  if (const auto e = extensions.find("KHR_materials_specular")) {
    validateNumbers(*e, {"specularFactor"});
    validateColors(*e, {{"specularColorFactor", 3}});
    validateTextureInfo(root, *e, "specularTexture");
    validateTextureInfo(root, *e, "specularColorTexture");
  }
  if (const auto e = extensions.find("KHR_materials_clearcoat")) {
    validateNumbers(*e, {"clearcoatFactor", "clearcoatRoughnessFactor"});
    for (const char* texture : {"clearcoatTexture", "clearcoatRoughnessTexture", "clearcoatNormalTexture"})
      validateTextureInfo(root, *e, texture);
    if (const auto normal = e->find("clearcoatNormalTexture")) validateNumbers(*normal, {"scale"});
  }
  if (const auto e = extensions.find("KHR_materials_sheen")) {
    validateNumbers(*e, {"sheenRoughnessFactor"});
    validateColors(*e, {{"sheenColorFactor", 3}});
    for (const char* texture : {"sheenColorTexture", "sheenRoughnessTexture"})
      validateTextureInfo(root, *e, texture);
  }
  if (const auto e = extensions.find("KHR_materials_anisotropy")) {
    validateNumbers(*e, {"anisotropyStrength", "anisotropyRotation"});
    validateTextureInfo(root, *e, "anisotropyTexture");
  }
  if (const auto e = extensions.find("KHR_materials_iridescence")) {
    validateNumbers(*e, {"iridescenceFactor", "iridescenceIor", "iridescenceThicknessMinimum",
                         "iridescenceThicknessMaximum"});
    for (const char* texture : {"iridescenceTexture", "iridescenceThicknessTexture"})
      validateTextureInfo(root, *e, texture);
  }
  if (const auto e = extensions.find("KHR_materials_dispersion")) validateNumbers(*e, {"dispersion"});
  if (const auto e = extensions.find("KHR_materials_pbrSpecularGlossiness")) {
    validateNumbers(*e, {"glossinessFactor"});
    validateColors(*e, {{"diffuseFactor", 4}, {"specularFactor", 3}});
    for (const char* texture : {"diffuseTexture", "specularGlossinessTexture"})
      validateTextureInfo(root, *e, texture);
  }
}

void validateMaterial(const JsonCursor& root, const JsonCursor& material) {
  material.stringOr("name", "");
  if (const auto pbr = material.find("pbrMetallicRoughness")) {
    validateColors(*pbr, {{"baseColorFactor", 4}});
    validateNumbers(*pbr, {"metallicFactor", "roughnessFactor"});
    validateTextureInfo(root, *pbr, "baseColorTexture");
    validateTextureInfo(root, *pbr, "metallicRoughnessTexture");
  }
  for (const char* texture : {"normalTexture", "occlusionTexture", "emissiveTexture"}) {
    validateTextureInfo(root, material, texture);
  }
  if (const auto normal = material.find("normalTexture")) validateNumbers(*normal, {"scale"});
  validateColors(material, {{"emissiveFactor", 3}});
  validateNumbers(material, {"alphaCutoff"});
  material.boolOr("doubleSided", false);
  if (const auto mode = material.find("alphaMode")) {
    const std::string& name = mode->asString();
    if (name != "OPAQUE" && name != "MASK" && name != "BLEND") {
      mode->fail(fmt::format("expected OPAQUE, MASK or BLEND, got \"{}\"", name));
    }
  }
  if (const auto extensions = material.find("extensions")) validateMaterialExtensions(root, *extensions);
}

void validateWrap(const JsonCursor& sampler, const char* name) {
  const auto wrap = sampler.find(name);
  if (!wrap) return;
  const std::uint64_t mode = wrap->asUnsigned();
  if (mode != 10497 && mode != 33071 && mode != 33648) {
    wrap->fail(fmt::format("expected 10497, 33071 or 33648, got {}", mode));
  }
}

void validateImage(const JsonCursor& root, const JsonCursor& image) {
  image.stringOr("uri", "");
  image.stringOr("name", "");
  image.stringOr("mimeType", "");
  if (const auto view = image.find("bufferView")) view->asIndex(root.countOf("bufferViews"), "buffer view");
}

void validateLight(const JsonCursor& light) {
  light.stringOr("name", "");
  const JsonCursor type = light.at("type");
  const std::string& name = type.asString();
  if (name != "point" && name != "spot" && name != "directional") {
    type.fail(fmt::format("expected point, spot or directional, got \"{}\"", name));
  }
  validateNumbers(light, {"intensity", "range"});
  validateColors(light, {{"color", 3}});
  if (name == "spot") validateNumbers(light.at("spot"), {"innerConeAngle", "outerConeAngle"});
}

void validateProfile(const JsonCursor& root, const JsonCursor& profile) {
  profile.stringOr("name", "");
  const auto view = profile.find("bufferView");
  if (view) view->asIndex(root.countOf("bufferViews"), "buffer view");
  if (const auto uri = profile.find("uri"); !uri && !view)
    profile.fail("expected the profile's uri or bufferView, got neither");
  profile.stringOr("uri", "");
}

void requirePositive(const JsonCursor& object, const char* name) {
  const JsonCursor member = object.at(name);
  if (!(member.asNumber() > 0.0))
    member.fail(fmt::format("expected a positive number, got {}", member.asNumber()));
}

void validateCamera(const JsonCursor& camera) {
  camera.stringOr("name", "");
  const JsonCursor type = camera.at("type");
  const std::string& name = type.asString();
  if (name == "perspective") {
    const JsonCursor perspective = camera.at("perspective");
    requirePositive(perspective, "yfov");
    requirePositive(perspective, "znear");
    if (perspective.at("yfov").asNumber() >= 3.14159265358979) {
      perspective.at("yfov").fail("expected a field of view below pi radians");
    }
    for (const char* optional : {"aspectRatio", "zfar"}) {
      if (perspective.find(optional)) requirePositive(perspective, optional);
    }
  } else if (name == "orthographic") {
    const JsonCursor orthographic = camera.at("orthographic");
    for (const char* extent : {"xmag", "ymag"}) {
      if (orthographic.at(extent).asNumber() == 0.0)
        orthographic.at(extent).fail("expected a non-zero number");
    }
    orthographic.at("znear").asNumber();
    orthographic.at("zfar").asNumber();
  } else {
    type.fail(fmt::format("expected perspective or orthographic, got \"{}\"", name));
  }
}

}  // namespace

void validateMaterials(const JsonCursor& root, const GltfUse& use, Warnings& warnings) {
  root.forEachObject("images", [&](const JsonCursor& image, std::size_t index) {
    checkPart(use.images.contains(index), warnings, [&] { validateImage(root, image); });
  });
  root.forEachObject("samplers", [](const JsonCursor& sampler, std::size_t) {
    validateWrap(sampler, "wrapS");
    validateWrap(sampler, "wrapT");
  });
  root.forEachObject("textures", [&](const JsonCursor& texture, std::size_t) {
    // A material that uses a texture without its image is an error; an unused texture is only warned of.
    const auto source = texture.find("source");
    if (source && source->asUnsigned() >= root.countOf("images")) {
      warnings.push_back(
          fmt::format("{}: image index {} out of range", source->where(), source->asUnsigned()));
    }
    if (const auto sampler = texture.find("sampler")) sampler->asIndex(root.countOf("samplers"), "sampler");
  });
  root.forEachObject("materials",
                     [&](const JsonCursor& material, std::size_t) { validateMaterial(root, material); });
}

void validateCamerasAndLights(const JsonCursor& root, const GltfUse& use, Warnings& warnings) {
  root.forEachObject("cameras", [&](const JsonCursor& camera, std::size_t index) {
    checkPart(use.cameras.contains(index), warnings, [&] { validateCamera(camera); });
  });
  const auto extensions = root.find("extensions");
  const auto punctual = extensions ? extensions->find("KHR_lights_punctual") : std::nullopt;
  if (punctual) {
    punctual->forEachObject("lights", [&](const JsonCursor& light, std::size_t index) {
      checkPart(use.lights.contains(index), warnings, [&] { validateLight(light); });
    });
  }
  if (const auto profiled = extensions ? extensions->find("EXT_lights_ies") : std::nullopt) {
    profiled->forEachObject("lights", [&](const JsonCursor& profile, std::size_t index) {
      checkPart(use.profiles.contains(index), warnings, [&] { validateProfile(root, profile); });
    });
  }
}

}  // namespace prelight
