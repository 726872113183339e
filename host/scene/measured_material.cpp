#include "scene/measured_material.h"

#include <fmt/format.h>

#include <map>
#include <string>

#include "base/read_file.h"
#include "scene/codecs/merl_brdf.h"
#include "scene/measured_brdf.h"

namespace prelight {

namespace {

/// Returns all materials of that name, otherwise the one of that number.
std::vector<std::size_t> materialsOf(const Scene& scene, const std::string& asked) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    if (scene.materials[i].name == asked) found.push_back(i);
  for (std::size_t i = 0; found.empty() && i < scene.materials.size(); ++i)
    if (std::to_string(i) == asked) return {i};
  return found;
}

[[noreturn]] void failForMaterial(const Scene& scene, const std::string& asked) {
  std::string list;
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    list += fmt::format("{}{} \"{}\"", i == 0 ? "" : ", ", i, scene.materials[i].name);
  throw UsageError(fmt::format("LoadOptions::brdfs {}", asked),
                   "there is no material with that name or number",
                   list.empty() ? "the file has none" : "the file has " + list);
}

std::shared_ptr<const MeasuredBrdf> readMeasured(const std::filesystem::path& file, Warnings& warnings) {
  const std::string where = file.string();
  std::vector<glm::vec3> values = parseMerlBrdf(readFileBytes(file, where, merlBytes + 1), where);
  return std::make_shared<const MeasuredBrdf>(makeMeasuredBrdf(std::move(values), where, warnings));
}

}  // namespace

void setMeasured(const std::shared_ptr<const MeasuredBrdf>& brdf, Material& material) {
  Material measured;
  measured.name = material.name;
  measured.emission = material.emission;
  measured.emissiveTexture = material.emissiveTexture;
  measured.normalTexture = material.normalTexture;
  measured.normalScale = material.normalScale;
  measured.alphaMode = material.alphaMode;
  measured.alphaCutoff = material.alphaCutoff;
  measured.doubleSided = material.doubleSided;
  measured.baseColor = glm::vec4(brdf->diffuse, material.baseColor.a);
  if (material.alphaMode != AlphaMode::Opaque) measured.baseColorTexture = material.baseColorTexture;
  measured.metallic = 0.0f;
  measured.roughness = brdf->roughness;
  measured.ior = 0.0f;  // the colour is the reflectance
  measured.specular = brdf->rest.empty() ? 0.0f : 1.0f;
  if (!brdf->albedos.empty())
    measured.specularColor = glm::min(glm::vec3(albedoAt(brdf->albedos, 1.0)), glm::vec3(1.0f));
  measured.measured = brdf;
  material = measured;
}

void giveMeasured(Scene& scene, const std::vector<MaterialBrdf>& brdfs, Warnings& warnings) {
  std::map<std::filesystem::path, std::shared_ptr<const MeasuredBrdf>> read;
  for (const MaterialBrdf& asked : brdfs) {
    const std::vector<std::size_t> materials = materialsOf(scene, asked.material);
    if (materials.empty()) failForMaterial(scene, asked.material);
    const auto [brdf, isNew] = read.try_emplace(asked.file);
    if (isNew) brdf->second = readMeasured(asked.file, warnings);
    for (const std::size_t i : materials) setMeasured(brdf->second, scene.materials[i]);
  }
}

}  // namespace prelight
