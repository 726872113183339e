#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "scene/compile/compile_parts.h"
#include "scene/image_lookup.h"

namespace prelight {

namespace {

struct SrgbTable {
  std::array<float, 256> linear{};
  SrgbTable() {
    for (std::size_t i = 0; i < linear.size(); ++i) {
      const double s = static_cast<double>(i) / 255.0;
      linear[i] = static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
    }
  }
};

/// Metalness (blue, linear) of an image between its texels at the centre of texel (x, y) of a width x height
/// grid.
float metalnessAt(const Image& image, const TextureRef& ref, int x, int y, int width, int height) {
  const glm::vec2 center((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                         (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
  return sampleImage(image, center, ref.wrapS, ref.wrapT).z;
}

float meanChannel(const Image& image, std::size_t channel) {
  double sum = 0.0;
  for (std::size_t i = channel; i < image.rgba.size(); i += 4) sum += image.rgba[i];
  return static_cast<float>(sum / (255.0 * static_cast<double>(image.rgba.size() / 4)));
}

/// Linear, of an sRGB image.
glm::vec3 meanColor(const Image& image) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c) sum[static_cast<int>(c)] += linearFromSrgb(image.rgba[i + c]);
  }
  return glm::vec3(sum / static_cast<double>(image.rgba.size() / 4));
}

Image whiteImageLike(const Image& image) {
  return {image.name, image.width, image.height, std::vector<std::uint8_t>(image.rgba.size(), 255)};
}

/// Base colour x (1 - metallic x metalness). `base` may be null (white), not both.
Image combineAlbedo(const Image* base, const Image* metal, const TextureRef& metalRef, float metallic) {
  Image image = base != nullptr ? *base : whiteImageLike(*metal);
  if (metal == nullptr) return image;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float dielectric =
          1.0f - metallic * metalnessAt(*metal, metalRef, x, y, image.width, image.height);
      std::uint8_t* texel =
          &image.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                           static_cast<std::size_t>(x))];
      for (int c = 0; c < 3; ++c) texel[c] = srgbFromLinear(linearFromSrgb(texel[c]) * dielectric);
    }
  }
  return image;
}

bool sameCoordinates(const TextureRef& a, const TextureRef& b) {
  return a.texCoord == b.texCoord && a.transform == b.transform && a.wrapS == b.wrapS && a.wrapT == b.wrapT;
}

/// What an albedo image is made of; equal keys share one.
using AlbedoKey = std::tuple<int, int, float, WrapMode, WrapMode>;

/// Of all texels, 0 to 1.
float leastChannel(const Image& image, std::size_t channel) {
  std::uint8_t least = 255;
  for (std::size_t i = channel; i < image.rgba.size(); i += 4) least = std::min(least, image.rgba[i]);
  return static_cast<float>(least) / 255.0f;
}

/// [material, then glTF's default one], at most 1.
std::vector<float> leastVertexAlphas(const Scene& scene) {
  std::vector<float> least(scene.materials.size() + 1, 1.0f);
  for (const Mesh& mesh : scene.meshes)
    for (const Primitive& primitive : mesh.primitives) {
      float& alpha =
          primitive.material < 0 ? least.back() : least[static_cast<std::size_t>(primitive.material)];
      for (const glm::vec4& color : primitive.colors) alpha = std::min(alpha, color.a);
    }
  return least;
}

class MaterialCompiler {
 public:
  MaterialCompiler(const Scene& scene, Warnings& warnings)
      : scene_(scene), warnings_(warnings), leastAlphas_(leastVertexAlphas(scene)) {}

  void add(const Material& material) {
    CompiledMaterial compiled;
    compiled.doubleSided = material.doubleSided;
    TextureRef coordinates;
    if (!material.unlit) {
      setAlbedo(material, compiled, coordinates);
      setDiffuseTransmission(material, compiled);
      setEmission(material, compiled);
    }
    setScattering(material, compiled, coordinates);
    setCoverage(material, compiled, coordinates);
    result_.materials.push_back(compiled);
    result_.coordinates.push_back(coordinates);
  }

  CompiledMaterials take() { return std::move(result_); }

 private:
  const Image& image(const TextureRef& ref) const {
    return scene_.images[static_cast<std::size_t>(ref.image)];
  }

  void setAlbedo(const Material& material, CompiledMaterial& compiled, TextureRef& coordinates) {
    const TextureRef& base = material.baseColorTexture;
    TextureRef metal = material.metallicRoughnessTexture;
    float metallic = material.metallic;
    if (metal.image >= 0 && metallic > 0.0f && base.image >= 0 && !sameCoordinates(base, metal)) {
      warnings_.push_back(
          fmt::format("material \"{}\": metalness uses other texture coordinates than the base "
                      "colour; its mean is taken for light transport",
                      material.name));
      metallic *= meanChannel(image(metal), 2);
      metal.image = -1;
    }
    if (metallic == 0.0f) metal.image = -1;
    const bool textured = metal.image >= 0;  // metalness then sits in the image
    compiled.albedo =
        glm::vec3(material.baseColor) * (1.0f - material.transmission) * (textured ? 1.0f : 1.0f - metallic);
    coordinates = base.image >= 0 ? base : metal;
    addImage(base, metal, metallic, compiled, coordinates);
  }

  /// Textures count with their means: light that comes through leaves diffusely all the same.
  void setDiffuseTransmission(const Material& material, CompiledMaterial& compiled) const {
    float share = material.diffuseTransmission;
    if (share <= 0.0f) return;
    const TextureRef& shares = material.diffuseTransmissionTexture;
    const TextureRef& colors = material.diffuseTransmissionColorTexture;
    const TextureRef& metal = material.metallicRoughnessTexture;
    if (shares.image >= 0) share *= meanChannel(image(shares), 3);
    glm::vec3 color = material.diffuseTransmissionColor;
    if (colors.image >= 0) color *= meanColor(image(colors));
    const float metallic = material.metallic * (metal.image >= 0 ? meanChannel(image(metal), 2) : 1.0f);
    compiled.albedo *= 1.0f - share;
    compiled.diffuseTransmission = share * (1.0f - metallic) * (1.0f - material.transmission) * color;
  }

  void addImage(const TextureRef& base, const TextureRef& metal, float metallic, CompiledMaterial& compiled,
                const TextureRef& coordinates) {
    if (coordinates.image < 0) return;
    const AlbedoKey key = metal.image >= 0
                              ? AlbedoKey{base.image, metal.image, metallic, metal.wrapS, metal.wrapT}
                              : AlbedoKey{base.image, -1, 0.0f, WrapMode::Repeat, WrapMode::Repeat};
    const auto [found, isNew] = imageOf_.try_emplace(key, static_cast<int>(result_.albedoImages.size()));
    if (isNew) {
      const Image* baseImage = base.image >= 0 ? &image(base) : nullptr;
      const Image* metalImage = metal.image >= 0 ? &image(metal) : nullptr;
      result_.albedoImages.push_back(combineAlbedo(baseImage, metalImage, metal, metallic));
    }
    compiled.albedoImage = found->second;
    compiled.wrapS = coordinates.wrapS;
    compiled.wrapT = coordinates.wrapT;
  }

  void setEmission(const Material& material, CompiledMaterial& compiled) {
    compiled.emission = material.emission;
    if (!material.isEmissive() || material.emissiveTexture.image < 0) return;
    const int index = material.emissiveTexture.image;
    auto [found, isNew] = meanEmissionOf_.try_emplace(index, 0.0f);
    if (isNew) found->second = meanColor(image(material.emissiveTexture));
    compiled.emission *= found->second;
  }

  /// What the reference renderer needs beyond albedo and emission.
  void setScattering(const Material& material, CompiledMaterial& compiled, TextureRef& coordinates) {
    compiled.unlit = material.unlit;
    compiled.baseColor = glm::vec3(material.baseColor);
    compiled.roughness = material.roughness;
    compiled.ior = material.ior;
    if (material.unlit) coordinates = material.baseColorTexture;
    if (coordinates.image < 0 && !material.unlit)
      coordinates = material.metallicRoughnessTexture.image >= 0 ? material.metallicRoughnessTexture
                                                                 : material.emissiveTexture;
    const TextureRef& base = material.baseColorTexture;
    compiled.baseColorTexture = {base.image, base.wrapS, base.wrapT};
    if (material.unlit) return;
    compiled.metallic = material.metallic;
    compiled.transmission = material.transmission;
    compiled.solid = material.thickness > 0.0f;
    compiled.specular = material.specular;
    compiled.specularColor = material.specularColor;
    compiled.emissionFactor = material.emission;
    for (int c = 0; c < 3; ++c)
      compiled.absorption[c] = absorption(material.attenuationColor[c], material.attenuationDistance);
    setLayers(material, compiled, coordinates);
  }

  /// A texture that lies elsewhere on the surface than the base colour counts with its mean.
  void setLayers(const Material& material, CompiledMaterial& compiled, const TextureRef& coordinates) {
    const auto lies = [&](const TextureRef& ref) {
      return ref.texCoord == coordinates.texCoord && ref.transform == coordinates.transform;
    };
    const TextureRef& surface = material.metallicRoughnessTexture;
    if (surface.image >= 0 && lies(surface)) {
      compiled.surfaceTexture = {surface.image, surface.wrapS, surface.wrapT};
    } else if (surface.image >= 0) {
      compiled.metallic *= meanChannel(image(surface), 2);
      compiled.roughness *= meanChannel(image(surface), 1);
    }
    const TextureRef& emissive = material.emissiveTexture;
    if (!material.isEmissive() || emissive.image < 0) return;
    if (lies(emissive)) {
      compiled.emissionTexture = {emissive.image, emissive.wrapS, emissive.wrapT};
    } else {
      compiled.emissionFactor = compiled.emission;
    }
  }

  /// Coefficient that leaves `color` of white light after `distance` (KHR_materials_volume).
  static float absorption(float color, float distance) {
    if (!std::isfinite(distance) || color >= 1.0f) return 0.0f;
    return std::min(-std::log(std::max(color, 1e-6f)) / distance, 1e30f);
  }

  /// The least alpha that any point of a surface of the material can have.
  float leastAlpha(const Material& material, std::size_t index) {
    float alpha = material.baseColor.a * leastAlphas_[index];
    if (material.baseColorTexture.image < 0) return alpha;
    const auto [found, isNew] = leastAlphaOf_.try_emplace(material.baseColorTexture.image, 1.0f);
    if (isNew) found->second = leastChannel(image(material.baseColorTexture), 3);
    return alpha * found->second;
  }

  /// MASK is cut at its cutoff. BLEND, which light transport cannot blend, at one half. A material that is
  /// unlit still covers: its holes need the image of its base colour. One that has no hole is opaque, for
  /// rays pay for every look at one; what rounding might cut stays a mask.
  void setCoverage(const Material& material, CompiledMaterial& compiled, TextureRef& coordinates) {
    if (material.alphaMode == AlphaMode::Opaque) return;
    const float cutoff = material.alphaMode == AlphaMode::Mask ? material.alphaCutoff : 0.5f;
    constexpr float rounding = 1e-5f;
    if (leastAlpha(material, result_.materials.size()) >= cutoff + rounding) return;
    compiled.alphaCutoff = cutoff;
    compiled.alphaFactor = material.baseColor.a;
    if (material.unlit && material.baseColorTexture.image >= 0) {
      coordinates = material.baseColorTexture;
      addImage(material.baseColorTexture, TextureRef{}, 0.0f, compiled, coordinates);
    }
  }

  const Scene& scene_;
  Warnings& warnings_;
  CompiledMaterials result_;
  std::map<AlbedoKey, int> imageOf_;
  std::map<int, glm::vec3> meanEmissionOf_;
  std::vector<float> leastAlphas_;     ///< [material], of vertex colours
  std::map<int, float> leastAlphaOf_;  ///< of images
};

}  // namespace

float linearFromSrgb(std::uint8_t value) {
  static const SrgbTable table;
  return table.linear[value];
}

std::uint8_t srgbFromLinear(float value) {
  const float clamped = std::clamp(value, 0.0f, 1.0f);
  const float encoded =
      clamped <= 0.0031308f ? 12.92f * clamped : 1.055f * std::pow(clamped, 1.0f / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(encoded * 255.0f));
}

CompiledMaterials compileMaterials(const Scene& scene, Warnings& warnings) {
  MaterialCompiler compiler(scene, warnings);
  for (const Material& material : scene.materials) compiler.add(material);
  compiler.add(Material{});
  return compiler.take();
}

}  // namespace prelight
