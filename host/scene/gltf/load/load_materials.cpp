#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/magnitudes.h"
#include "base/parallel.h"
#include "scene/gltf/gltf_use.h"
#include "scene/gltf/image_decode.h"
#include "scene/gltf/load/load_parts.h"

namespace prelight {

namespace {

/// Clamps a value to the range of the specification, and warns once per number.
float clampWithWarning(const LoadContext& context, const JsonCursor& number, float low, float high) {
  const float value = finiteFloat(number);
  const float clamped = std::clamp(value, low, high);
  if (clamped != value) {
    context.warnings.push_back(
        fmt::format("{}: {} lies outside {}..{}; clamped", number.where(), value, low, high));
  }
  return clamped;
}

/// Upper bound where the specification has none, so that products stay finite.
constexpr auto noLimit = static_cast<float>(largestInput);

float clampedOr(const LoadContext& context, const JsonCursor& object, const char* name, float fallback,
                float high = 1.0f) {
  const auto number = object.find(name);
  return number ? clampWithWarning(context, *number, 0.0f, high) : fallback;
}

template <int N>
glm::vec<N, float> clampedColor(const LoadContext& context, const JsonCursor& object, const char* name,
                                const glm::vec<N, float>& fallback, float high = 1.0f) {
  const auto color = object.find(name);
  if (!color) return fallback;
  glm::vec<N, float> result;
  for (int i = 0; i < N; ++i) {
    result[i] = clampWithWarning(context, color->at(static_cast<std::size_t>(i)), 0.0f, high);
  }
  return result;
}

WrapMode wrapMode(int mode) {
  if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return WrapMode::ClampToEdge;
  if (mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return WrapMode::MirroredRepeat;
  return WrapMode::Repeat;
}

/// KHR_texture_transform: translation x rotation x scale, with the rotation of its specification.
glm::mat3 textureTransform(const JsonCursor& transform) {
  const float rotation = transform.find("rotation") ? finiteFloat(transform.at("rotation")) : 0.0f;
  const auto pair = [&](const char* name, const glm::vec2& fallback) {
    const auto values = transform.find(name);
    return values ? glm::vec2(finiteFloat(values->at(0)), finiteFloat(values->at(1))) : fallback;
  };
  const glm::vec2 offset = pair("offset", glm::vec2(0.0f));
  const glm::vec2 scale = pair("scale", glm::vec2(1.0f));
  const float c = std::cos(rotation);
  const float s = std::sin(rotation);
  return {glm::vec3(c * scale.x, -s * scale.x, 0.0f), glm::vec3(s * scale.y, c * scale.y, 0.0f),
          glm::vec3(offset, 1.0f)};
}

TextureRef loadTexture(const LoadContext& context, const JsonCursor& holder, const char* name) {
  TextureRef ref;
  const auto info = holder.find(name);
  if (!info) return ref;
  const std::size_t index = info->at("index").asUnsigned();
  const tinygltf::Texture& texture = context.model.textures[index];
  const auto image = textureImage(context.root.at("textures").at(index));
  std::uint64_t texCoord = info->unsignedOr("texCoord", 0);
  if (const auto transform = LoadContext::extension(*info, "KHR_texture_transform")) {
    ref.transform = textureTransform(*transform);
    texCoord = transform->unsignedOr("texCoord", texCoord);
  }
  if (!image) {
    context.warnings.push_back(info->where() + ": the texture names no image; it is ignored");
    return {};
  }
  if (texCoord > 1) {
    context.warnings.push_back(
        fmt::format("{}: TEXCOORD_{} is beyond the two sets that are read; the texture is ignored",
                    info->where(), texCoord));
    return {};
  }
  ref.image = static_cast<int>(*image);
  ref.texCoord = static_cast<int>(texCoord);
  if (texture.sampler >= 0) {
    const tinygltf::Sampler& sampler = context.model.samplers[static_cast<std::size_t>(texture.sampler)];
    ref.wrapS = wrapMode(sampler.wrapS);
    ref.wrapT = wrapMode(sampler.wrapT);
    if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) ref.filter = TextureFilter::Nearest;
  }
  return ref;
}

void loadVolume(const LoadContext& context, const JsonCursor& volume, Material& material) {
  material.thickness = clampedOr(context, volume, "thicknessFactor", 0.0f, noLimit);
  material.attenuationColor = clampedColor<3>(context, volume, "attenuationColor", glm::vec3(1.0f));
  const auto distance = volume.find("attenuationDistance");
  if (!distance) return;
  if (distance->asNumber() > 0.0) {
    material.attenuationDistance =
        static_cast<float>(distance->asNumber());  // distances beyond float's range become infinite
  } else {
    context.warnings.push_back(distance->where() + ": expected a positive distance; taken as infinite");
  }
}

Clearcoat loadClearcoat(const LoadContext& context, const JsonCursor& json) {
  Clearcoat coat;
  coat.factor = clampedOr(context, json, "clearcoatFactor", 0.0f);
  coat.texture = loadTexture(context, json, "clearcoatTexture");
  coat.roughness = clampedOr(context, json, "clearcoatRoughnessFactor", 0.0f);
  coat.roughnessTexture = loadTexture(context, json, "clearcoatRoughnessTexture");
  coat.normalTexture = loadTexture(context, json, "clearcoatNormalTexture");
  if (const auto info = json.find("clearcoatNormalTexture"); info && info->find("scale"))
    coat.normalScale = finiteFloat(info->at("scale"));
  return coat;
}

Sheen loadSheen(const LoadContext& context, const JsonCursor& json) {
  Sheen sheen;
  sheen.color = clampedColor<3>(context, json, "sheenColorFactor", glm::vec3(0.0f));
  sheen.colorTexture = loadTexture(context, json, "sheenColorTexture");
  sheen.roughness = clampedOr(context, json, "sheenRoughnessFactor", 0.0f);
  sheen.roughnessTexture = loadTexture(context, json, "sheenRoughnessTexture");
  return sheen;
}

Anisotropy loadAnisotropy(const LoadContext& context, const JsonCursor& json) {
  Anisotropy anisotropy;
  anisotropy.strength = clampedOr(context, json, "anisotropyStrength", 0.0f);
  if (const auto rotation = json.find("anisotropyRotation")) anisotropy.rotation = finiteFloat(*rotation);
  anisotropy.texture = loadTexture(context, json, "anisotropyTexture");
  return anisotropy;
}

Iridescence loadIridescence(const LoadContext& context, const JsonCursor& json) {
  Iridescence film;
  film.factor = clampedOr(context, json, "iridescenceFactor", 0.0f);
  film.texture = loadTexture(context, json, "iridescenceTexture");
  film.ior = clampedOr(context, json, "iridescenceIor", 1.3f, noLimit);
  if (film.ior < 1.0f) {
    context.warnings.push_back(
        fmt::format("{}: {} lies below 1; clamped", json.at("iridescenceIor").where(), film.ior));
    film.ior = 1.0f;
  }
  film.thicknessMinimum = clampedOr(context, json, "iridescenceThicknessMinimum", 100.0f, noLimit);
  film.thicknessMaximum = clampedOr(context, json, "iridescenceThicknessMaximum", 400.0f, noLimit);
  film.thicknessTexture = loadTexture(context, json, "iridescenceThicknessTexture");
  return film;
}

void loadExtensions(const LoadContext& context, const JsonCursor& json, Material& material) {
  if (const auto e = LoadContext::extension(json, "KHR_materials_emissive_strength")) {
    const float strength = clampedOr(context, *e, "emissiveStrength", 1.0f, noLimit);
    material.emission *= strength;
    for (int i = 0; i < 3; ++i) {
      if (!(material.emission[i] <= noLimit))
        e->fail(fmt::format("emissive factor x strength is {:g}, expected at most {:g}", material.emission[i],
                            noLimit),
                "dim the material");
    }
  }
  if (const auto e = LoadContext::extension(json, "KHR_materials_transmission")) {
    material.transmission = clampedOr(context, *e, "transmissionFactor", 0.0f);
    material.transmissionTexture = loadTexture(context, *e, "transmissionTexture");
  }
  if (const auto e = LoadContext::extension(json, "KHR_materials_diffuse_transmission")) {
    material.diffuseTransmission = clampedOr(context, *e, "diffuseTransmissionFactor", 0.0f);
    material.diffuseTransmissionTexture = loadTexture(context, *e, "diffuseTransmissionTexture");
    material.diffuseTransmissionColor =
        clampedColor<3>(context, *e, "diffuseTransmissionColorFactor", glm::vec3(1.0f));
    material.diffuseTransmissionColorTexture = loadTexture(context, *e, "diffuseTransmissionColorTexture");
  }
  if (const auto e = LoadContext::extension(json, "KHR_materials_volume")) loadVolume(context, *e, material);
  if (const auto e = LoadContext::extension(json, "KHR_materials_volume_scatter")) {
    material.multiscatterColor = clampedColor<3>(context, *e, "multiscatterColor", glm::vec3(0.0f));
    if (const auto anisotropy = e->find("scatterAnisotropy"))
      material.scatterAnisotropy = clampWithWarning(context, *anisotropy, -1.0f, 1.0f);
  }
  if (const auto e = LoadContext::extension(json, "KHR_materials_ior")) {
    material.ior = clampedOr(context, *e, "ior", 1.5f, noLimit);
    if (material.ior > 0.0f && material.ior < 1.0f) {
      context.warnings.push_back(
          fmt::format("{}: {} lies below 1; clamped", e->at("ior").where(), material.ior));
      material.ior = 1.0f;
    }
  }
  // KHR_materials_pbrSpecularGlossiness excludes KHR_materials_specular. If a material has both, the former
  // wins: it has set the specular parameters above.
  const bool told = LoadContext::extension(json, "KHR_materials_pbrSpecularGlossiness").has_value();
  if (const auto e = LoadContext::extension(json, "KHR_materials_specular"); e && told) {
    context.warnings.push_back(e->where() +
                               ": not for a material of KHR_materials_pbrSpecularGlossiness; left out");
  } else if (e) {
    material.specular = clampedOr(context, *e, "specularFactor", 1.0f);
    material.specularColor = clampedColor<3>(context, *e, "specularColorFactor", glm::vec3(1.0f), noLimit);
    material.specularTexture = loadTexture(context, *e, "specularTexture");
    material.specularColorTexture = loadTexture(context, *e, "specularColorTexture");
  }
  if (const auto e = LoadContext::extension(json, "KHR_materials_clearcoat"))
    material.clearcoat = loadClearcoat(context, *e);
  if (const auto e = LoadContext::extension(json, "KHR_materials_sheen"))
    material.sheen = loadSheen(context, *e);
  if (const auto e = LoadContext::extension(json, "KHR_materials_anisotropy"))
    material.anisotropy = loadAnisotropy(context, *e);
  if (const auto e = LoadContext::extension(json, "KHR_materials_iridescence"))
    material.iridescence = loadIridescence(context, *e);
  if (const auto e = LoadContext::extension(json, "KHR_materials_dispersion"))
    material.dispersion = clampedOr(context, *e, "dispersion", 0.0f, noLimit);
  material.unlit = LoadContext::extension(json, "KHR_materials_unlit").has_value();
}

/// Converts KHR_materials_pbrSpecularGlossiness to the nearest dielectric: the diffuse colour is kept, and
/// glossiness becomes roughness. Its specular reflectance is split into 0.04 times a specular colour, which
/// the texture multiplies too; addRoughness() uses the texture's glossiness.
void loadSpecularGlossiness(const LoadContext& context, const JsonCursor& json, Material& material) {
  material.metallic = 0.0f;
  material.baseColor = clampedColor<4>(context, json, "diffuseFactor", glm::vec4(1.0f));
  material.baseColorTexture = loadTexture(context, json, "diffuseTexture");
  material.roughness = 1.0f - clampedOr(context, json, "glossinessFactor", 1.0f);
  material.specularColor = clampedColor<3>(context, json, "specularFactor", glm::vec3(1.0f)) / 0.04f;
  material.specularColorTexture = loadTexture(context, json, "specularGlossinessTexture");
}

/// Warns of properties of glass that no path draws.
void warnOfPlainGlass(const LoadContext& context, const JsonCursor& json, const Material& material) {
  if (material.transmission == 0.0f || material.unlit) return;
  if (material.anisotropy.strength > 0.0f)
    context.warnings.push_back(json.where() + ": the share that is glass is drawn without anisotropy");
}

Material loadMaterial(const LoadContext& context, std::size_t index) {
  const JsonCursor json = context.root.at("materials").at(index);
  const tinygltf::Material& source = context.model.materials[index];
  Material material;
  material.name = source.name;
  material.doubleSided = source.doubleSided;
  material.alphaMode = source.alphaMode == "MASK"    ? AlphaMode::Mask
                       : source.alphaMode == "BLEND" ? AlphaMode::Blend
                                                     : AlphaMode::Opaque;
  material.alphaCutoff = clampedOr(context, json, "alphaCutoff", 0.5f, noLimit);
  // Exporters older than KHR_materials_emissive_strength write radiances above 1 here on purpose.
  material.emission = clampedColor<3>(context, json, "emissiveFactor", glm::vec3(0.0f), noLimit);
  if (glm::any(glm::greaterThan(material.emission, glm::vec3(1.0f)))) {
    context.warnings.push_back(json.at("emissiveFactor").where() +
                               ": above 1; taken as radiance all the same");
  }
  material.emissiveTexture = loadTexture(context, json, "emissiveTexture");
  material.normalTexture = loadTexture(context, json, "normalTexture");
  if (const auto info = json.find("normalTexture"))
    material.normalScale = info->find("scale") ? finiteFloat(info->at("scale")) : 1.0f;
  if (const auto pbr = json.find("pbrMetallicRoughness")) {
    material.baseColor = clampedColor<4>(context, *pbr, "baseColorFactor", glm::vec4(1.0f));
    material.metallic = clampedOr(context, *pbr, "metallicFactor", 1.0f);
    material.roughness = clampedOr(context, *pbr, "roughnessFactor", 1.0f);
    material.baseColorTexture = loadTexture(context, *pbr, "baseColorTexture");
    material.metallicRoughnessTexture = loadTexture(context, *pbr, "metallicRoughnessTexture");
  }
  if (const auto e = LoadContext::extension(json, "KHR_materials_pbrSpecularGlossiness"))
    loadSpecularGlossiness(context, *e, material);
  loadExtensions(context, json, material);
  warnOfPlainGlass(context, json, material);
  return material;
}

Image roughnessOf(const Image& glossy, float glossiness) {
  Image rough = glossy;
  for (std::size_t i = 0; i < rough.rgba.size(); i += 4) {
    const float value = 255.0f - glossiness * static_cast<float>(glossy.rgba[i + 3]);
    const std::array<std::uint8_t, 4> texel{0, static_cast<std::uint8_t>(std::lround(value)), 0, 255};
    std::copy(texel.begin(), texel.end(), rough.rgba.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return rough;
}

/// Roughness images for materials of KHR_materials_pbrSpecularGlossiness, whose texture stores glossiness in
/// A: separate images with roughness in the channel of core materials. Materials with equal image and factor
/// share one.
class RoughnessImages {
 public:
  explicit RoughnessImages(std::vector<Image>& images) : images_(images) {}

  void addTo(const JsonCursor& json, Material& material) {
    const auto e = LoadContext::extension(json, "KHR_materials_pbrSpecularGlossiness");
    if (!e || !e->find("specularGlossinessTexture") || material.specularColorTexture.image < 0) return;
    const int glossy = material.specularColorTexture.image;
    const float glossiness = 1.0f - material.roughness;
    const auto [known, isNew] =
        made_.emplace(std::pair(glossy, glossiness), static_cast<int>(images_.size()));
    if (isNew) {
      count(*e, images_[static_cast<std::size_t>(glossy)]);
      images_.push_back(roughnessOf(images_[static_cast<std::size_t>(glossy)], glossiness));
    }
    material.roughness = 1.0f;
    material.metallicRoughnessTexture = material.specularColorTexture;
    material.metallicRoughnessTexture.image = known->second;
  }

 private:
  void count(const JsonCursor& json, const Image& image) {
    constexpr std::size_t most = std::size_t{1} << 27;
    texels_ += image.rgba.size() / 4;
    if (texels_ > most)
      json.fail(fmt::format("{} texels of glossiness so far with factors of their own, expected at most {}",
                            texels_, most),
                "give materials of one texture the same glossinessFactor");
  }

  std::vector<Image>& images_;
  std::map<std::pair<int, float>, int> made_;
  std::size_t texels_ = 0;
};

}  // namespace

std::vector<Material> loadMaterials(const LoadContext& context) {
  std::vector<Material> materials;
  materials.reserve(context.model.materials.size());
  for (std::size_t i = 0; i < context.model.materials.size(); ++i)
    materials.push_back(loadMaterial(context, i));
  return materials;
}

std::vector<Image> loadImages(const LoadContext& context, std::vector<Material>& materials) {
  std::vector<bool> used(context.root.countOf("images"), false);
  for (const Material& material : materials) {
    for (const TextureRef* ref :
         {&material.baseColorTexture, &material.metallicRoughnessTexture, &material.emissiveTexture,
          &material.normalTexture, &material.transmissionTexture, &material.specularTexture,
          &material.specularColorTexture, &material.diffuseTransmissionTexture,
          &material.diffuseTransmissionColorTexture, &material.clearcoat.texture,
          &material.clearcoat.roughnessTexture, &material.sheen.colorTexture,
          &material.sheen.roughnessTexture, &material.anisotropy.texture, &material.clearcoat.normalTexture,
          &material.iridescence.texture, &material.iridescence.thicknessTexture}) {
      if (ref->image >= 0) used[static_cast<std::size_t>(ref->image)] = true;
    }
  }
  checkImages(context.document, used);
  std::vector<Image> images(used.size());
  std::vector<Warnings> warnings(used.size());
  parallelRanges(used.size(), 1, [&](std::size_t i, std::size_t) {
    images[i] = used[i] ? loadImage(context.document, i, warnings[i])
                        : whiteImage(context.root.at("images").at(i).stringOr("name", ""));
  });
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (warnings[i].empty()) continue;
    context.warnings.insert(context.warnings.end(), warnings[i].begin(), warnings[i].end());
    for (Material& material : materials)  // a white texel is no valid direction
      for (TextureRef* ref :
           {&material.normalTexture, &material.clearcoat.normalTexture, &material.anisotropy.texture})
        if (ref->image == static_cast<int>(i)) *ref = {};
  }
  RoughnessImages roughness(images);
  for (std::size_t m = 0; m < materials.size(); ++m)
    roughness.addTo(context.root.at("materials").at(m), materials[m]);
  return images;
}

std::vector<std::string> loadVariants(const LoadContext& context) {
  std::vector<std::string> names;
  const auto extension = LoadContext::extension(context.root, "KHR_materials_variants");
  if (!extension) return names;
  extension->forEachObject("variants", [&](const JsonCursor& variant, std::size_t) {
    names.push_back(variant.at("name").asString());
  });
  return names;
}

int materialOfVariant(const LoadContext& context, const JsonCursor& primitive, int variant, int own) {
  if (variant < 0) return own;
  const auto extension = LoadContext::extension(primitive, "KHR_materials_variants");
  if (!extension) return own;
  int material = own;
  extension->forEachObject("mappings", [&](const JsonCursor& mapping, std::size_t) {
    const JsonCursor variants = mapping.at("variants");
    for (std::size_t i = 0; i < variants.arraySize(); ++i)
      if (variants.at(i).asUnsigned() == static_cast<std::uint64_t>(variant))
        material =
            static_cast<int>(mapping.at("material").asIndex(context.root.countOf("materials"), "material"));
  });
  return material;
}

}  // namespace prelight
