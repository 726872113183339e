#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "base/colour.h"
#include "scene/compile/compile_parts.h"

namespace prelight {

namespace {

struct SrgbTable {
  std::array<float, 256> linear{};
  SrgbTable() {
    for (std::size_t i = 0; i < linear.size(); ++i)
      linear[i] = static_cast<float>(linearOfSrgb(static_cast<double>(i) / 255.0));
  }
};

float meanChannel(const Image& image, std::size_t channel) {
  double sum = 0.0;
  for (std::size_t i = channel; i < image.rgba.size(); i += 4) sum += image.rgba[i];
  return static_cast<float>(sum / (255.0 * static_cast<double>(image.rgba.size() / 4)));
}

/// Returns the linear mean colour of an sRGB image.
glm::vec3 meanColor(const Image& image) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c) sum[static_cast<int>(c)] += linearFromSrgb(image.rgba[i + c]);
  }
  return glm::vec3(sum / static_cast<double>(image.rgba.size() / 4));
}

/// Returns the least value of a channel over all texels, 0 to 1.
float leastChannel(const Image& image, std::size_t channel) {
  std::uint8_t least = 255;
  for (std::size_t i = channel; i < image.rgba.size(); i += 4) least = std::min(least, image.rgba[i]);
  return static_cast<float>(least) / 255.0f;
}

/// Returns the least vertex alpha, at most 1, per [material, then glTF's default material].
std::vector<float> leastVertexAlphas(const Scene& scene) {
  std::vector<float> least(scene.materials.size() + 1, 1.0f);
  for (const Mesh& mesh : scene.meshes)
    for (const Primitive& primitive : mesh.primitives) {
      float& alpha =
          primitive.material < 0 ? least.back() : least[static_cast<std::size_t>(primitive.material)];
      for (const glm::vec4& color : primitive.colors) alpha = std::min(alpha, color.a);
      for (const MorphTarget& target : primitive.targets)
        if (!target.colors.empty()) alpha = 0.0f;  // for any weights of the targets
    }
  return least;
}

constexpr float mostAnisotropy = 0.99f;  // beyond, float32 does not resolve the lobe

/// Returns the coefficient that leaves `color` of white light after `distance` (KHR_materials_volume).
float absorption(float color, float distance) {
  if (!std::isfinite(distance) || color >= 1.0f) return 0.0f;
  return std::min(-std::log(std::max(color, 1e-6f)) / distance, 1e30f);
}

/// Returns the single-scattering albedo of a particle, given the albedo of a body so thick that no light
/// passes it (KHR_materials_volume_scatter; Kulla and Conty 2017, "Revisiting physically based shading at
/// Imageworks").
float singleScattering(float multiscatter, float anisotropy) {
  if (multiscatter <= 0.0f) return 0.0f;  // the fit would return 3e-5
  const float m = std::clamp(multiscatter, 0.0f, 1.0f);
  const float s = 4.09712f + 4.20863f * m - std::sqrt(9.59217f + 41.6808f * m + 17.7126f * m * m);
  return std::clamp((1.0f - s * s) / (1.0f - anisotropy * s * s), 0.0f, 1.0f);
}

/// Returns a texture, or none where its factor is 0.
TextureRef unlessZero(float factor, const TextureRef& texture) {
  return factor > 0.0f ? texture : TextureRef{};
}

void setDielectric(const Material& material, CompiledMaterial& compiled) {
  compiled.ior = material.ior;
  compiled.transmission = material.transmission;
  compiled.transmissionTexture = unlessZero(material.transmission, material.transmissionTexture);
  compiled.solid = material.thickness > 0.0f;
  for (int c = 0; c < 3; ++c)
    compiled.absorption[c] = absorption(material.attenuationColor[c], material.attenuationDistance);
  compiled.scatterAnisotropy = std::clamp(material.scatterAnisotropy, -mostAnisotropy, mostAnisotropy);
  for (int c = 0; c < 3 && compiled.solid && compiled.absorption != glm::vec3(0.0f); ++c)
    compiled.scattering[c] = singleScattering(material.multiscatterColor[c], compiled.scatterAnisotropy);
  compiled.specular = material.specular;
  compiled.specularTexture = unlessZero(material.specular, material.specularTexture);
  compiled.specularColor = material.specularColor;
  compiled.specularColorTexture = unlessZero(material.specular, material.specularColorTexture);
  compiled.translucency = material.diffuseTransmission;
  compiled.translucencyTexture =
      unlessZero(material.diffuseTransmission, material.diffuseTransmissionTexture);
  compiled.translucentColor = material.diffuseTransmissionColor;
  compiled.translucentColorTexture =
      unlessZero(material.diffuseTransmission, material.diffuseTransmissionColorTexture);
}

class MaterialCompiler {
 public:
  explicit MaterialCompiler(const Scene& scene) : scene_(scene), leastAlphas_(leastVertexAlphas(scene)) {}

  /// `source`: its index among the scene's materials; -1: none of them.
  void add(const Material& material, int source) {
    CompiledMaterial compiled;
    compiled.source = source;
    compiled.doubleSided = material.doubleSided;
    compiled.unlit = material.unlit;
    compiled.baseColor = glm::vec3(material.baseColor);
    compiled.baseColorTexture = material.baseColorTexture;
    compiled.roughness = material.roughness;
    compiled.ior = material.ior;
    if (!material.unlit) {
      compiled.metallic = material.metallic;
      compiled.surfaceTexture = material.metallicRoughnessTexture;
      compiled.normalTexture = material.normalTexture;
      compiled.normalScale = material.normalScale;
      setDielectric(material, compiled);
      if (material.clearcoat.factor > 0.0f) compiled.clearcoat = material.clearcoat;
      if (material.anisotropy.strength > 0.0f) compiled.anisotropy = material.anisotropy;
      if (material.iridescence.factor > 0.0f) compiled.iridescence = material.iridescence;
      if (compiled.solid && material.transmission > 0.0f && material.ior > 0.0f)
        compiled.dispersion = material.dispersion;
      if (material.sheen.color != glm::vec3(0.0f)) compiled.sheen = material.sheen;
      compiled.measured = material.measured;
      setAlbedo(compiled);
      compiled.emission = material.emission;
      if (material.isEmissive()) compiled.emissionTexture = material.emissiveTexture;
    }
    setCoverage(material, compiled);
    materials_.push_back(compiled);
  }

  /// Appends a two-sided copy of a material; `source` as in add().
  void addTwoSided(int source) {
    const auto original = std::find_if(materials_.begin(), materials_.end(),
                                       [&](const CompiledMaterial& m) { return m.source == source; });
    CompiledMaterial copy = *original;
    copy.doubleSided = true;
    materials_.push_back(std::move(copy));
  }

  std::vector<CompiledMaterial> take() { return std::move(materials_); }

 private:
  const Image& image(const TextureRef& ref) const {
    return scene_.images[static_cast<std::size_t>(ref.image)];
  }

  float mean(float factor, const TextureRef& texture, std::size_t channel) const {
    return texture.image < 0 || factor == 0.0f ? factor : factor * meanChannel(image(texture), channel);
  }

  /// Sets the diffuse albedo. Translucency uses the mean of its textures here.
  void setAlbedo(CompiledMaterial& m) const {
    m.albedo = m.baseColor;
    if (m.transmissionTexture.image < 0) m.albedo *= 1.0f - m.transmission;
    if (m.surfaceTexture.image < 0) m.albedo *= 1.0f - m.metallic;
    if (m.translucency <= 0.0f) return;
    const float share = m.meanTranslucency = mean(m.translucency, m.translucencyTexture, 3);
    glm::vec3 color = m.translucentColor;
    if (m.translucentColorTexture.image >= 0) color *= meanColor(image(m.translucentColorTexture));
    m.albedo *= 1.0f - share;
    m.diffuseTransmission = share * (1.0f - mean(m.metallic, m.surfaceTexture, 2)) *
                            (1.0f - mean(m.transmission, m.transmissionTexture, 0)) * color;
  }

  /// Returns the least alpha that any point of a surface of the material can have.
  float leastAlpha(const Material& material, std::size_t index) {
    float alpha = material.baseColor.a * leastAlphas_[index];
    if (material.baseColorTexture.image < 0) return alpha;
    const auto [found, isNew] = leastAlphaOf_.try_emplace(material.baseColorTexture.image, 1.0f);
    if (isNew) found->second = leastChannel(image(material.baseColorTexture), 3);
    return alpha * found->second;
  }

  /// MASK is cut at its cutoff; BLEND is hit by a share of the rays. A material without holes becomes opaque,
  /// because rays pay for every test; one that rounding might cut stays a mask.
  void setCoverage(const Material& material, CompiledMaterial& compiled) {
    if (material.alphaMode == AlphaMode::Opaque) return;
    const bool blended = material.alphaMode == AlphaMode::Blend;
    const float least = leastAlpha(material, materials_.size());
    constexpr float rounding = 1e-5f;
    if (blended ? least >= 1.0f : least >= material.alphaCutoff + rounding) return;
    compiled.blended = blended;
    compiled.alphaCutoff = blended ? 0.5f : material.alphaCutoff;
    compiled.alphaFactor = material.baseColor.a;
  }

  const Scene& scene_;
  std::vector<CompiledMaterial> materials_;
  std::vector<float> leastAlphas_;     ///< [material], of vertex colours
  std::map<int, float> leastAlphaOf_;  ///< [image]
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

std::vector<CompiledMaterial> compileMaterials(const Scene& scene) {
  MaterialCompiler compiler(scene);
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    compiler.add(scene.materials[i], static_cast<int>(i));
  compiler.add(Material{}, -1);
  std::set<int> twoSided;
  for (const Mesh& mesh : scene.meshes)
    for (const Primitive& primitive : mesh.primitives)
      if (primitive.bothSides) twoSided.insert(primitive.material);
  for (const int source : twoSided) compiler.addTwoSided(source);
  return compiler.take();
}

}  // namespace prelight
