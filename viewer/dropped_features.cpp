#include "viewer/dropped_features.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "scene/lobes.h"

namespace prelight::viewer {
namespace {

struct Droppable {
  const char* what;
  bool (*has)(const CompiledMaterial&);
};

constexpr std::array<Droppable, 6> droppables = {
    {{"clear coats", [](const CompiledMaterial& m) { return m.clearcoat.factor > 0.0f; }},
     {"sheen", [](const CompiledMaterial& m) { return hasSheen(m); }},
     {"anisotropy", [](const CompiledMaterial& m) { return isAnisotropic(m); }},
     {"iridescence", [](const CompiledMaterial& m) { return hasFilm(m); }},
     {"dispersion", [](const CompiledMaterial& m) { return isGlass(m) && m.dispersion > 0.0f; }},
     {"KHR_materials_specular of glass",
      [](const CompiledMaterial& m) { return isSpecularGlass(m) && m.specular > 0.0f; }}}};

std::string nameOf(const Scene& scene, std::size_t material) {
  const bool named = material < scene.materials.size() && !scene.materials[material].name.empty();
  return named ? '"' + scene.materials[material].name + '"' : "material " + std::to_string(material);
}

/// The first few.
std::string namesOf(const Scene& scene, const std::vector<std::size_t>& materials) {
  constexpr std::size_t most = 3;
  std::string names;
  for (std::size_t i = 0; i < materials.size() && i < most; ++i)
    names += (i > 0 ? ", " : "") + nameOf(scene, materials[i]);
  return materials.size() > most ? names + " and " + std::to_string(materials.size() - most) + " more"
                                 : names;
}

}  // namespace

void noteDroppedFeatures(const Scene& scene, const CompiledScene& compiled, Shading shading,
                         Warnings& notes) {
  if (shading == Shading::GlobalIllumination) return;
  std::vector<bool> drawn(compiled.materials.size(), false);
  for (const std::uint32_t material : compiled.triangleMaterials) drawn[material] = true;
  for (const Droppable& droppable : droppables) {
    std::vector<std::size_t> having;
    for (std::size_t i = 0; i < drawn.size(); ++i)
      if (drawn[i] && droppable.has(compiled.materials[i])) having.push_back(i);
    if (!having.empty())
      notes.push_back(std::string(shadingName(shading)) + " shading leaves out " + droppable.what + " of " +
                      namesOf(scene, having) + " (docs/materials.md)");
  }
}

}  // namespace prelight::viewer
