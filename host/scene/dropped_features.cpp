#include "scene/dropped_features.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "scene/lobes.h"

namespace prelight {
namespace {

//                           full in OpenGL, transfer
constexpr std::array<DroppedFeature, 6> features = {
    {{"clear coats", [](const CompiledMaterial& m) { return m.clearcoat.factor > 0.0f; }, {false, true}},
     {"sheen", [](const CompiledMaterial& m) { return hasSheen(m); }, {false, true}},
     {"anisotropy", [](const CompiledMaterial& m) { return isAnisotropic(m); }, {false, true}},
     {"iridescence", [](const CompiledMaterial& m) { return hasFilm(m); }, {false, true}},
     // Shadings that use transfer show what was baked.
     {"scattering within bodies", [](const CompiledMaterial& m) { return scattersWithin(m); }, {true, false}},
     {"light through glass", [](const CompiledMaterial& m) { return isGlass(m); }, {false, true}}}};

std::string shownName(const Scene& scene, std::size_t material) {
  const bool named = material < scene.materials.size() && !scene.materials[material].name.empty();
  return named ? '"' + scene.materials[material].name + '"' : "material " + std::to_string(material);
}

/// Returns the first few names.
std::string shownNames(const Scene& scene, const std::vector<std::size_t>& materials) {
  constexpr std::size_t most = 3;
  std::string names;
  for (std::size_t i = 0; i < materials.size() && i < most; ++i)
    names += (i > 0 ? ", " : "") + shownName(scene, materials[i]);
  return materials.size() > most ? names + " and " + std::to_string(materials.size() - most) + " more"
                                 : names;
}

}  // namespace

std::span<const DroppedFeature> droppedFeatures() { return features; }

void noteDroppedFeatures(const Scene& scene, const CompiledScene& compiled, MaterialPath path,
                         const std::string& who, Warnings& notes) {
  std::vector<bool> drawn(compiled.materials.size(), false);
  for (const std::uint32_t material : compiled.triangleMaterials) drawn[material] = true;
  for (const DroppedFeature& feature : features) {
    if (!feature.droppedBy[static_cast<std::size_t>(path)]) continue;
    std::vector<std::size_t> having;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      if (!drawn[i] || !feature.has(compiled.materials[i])) continue;
      const int source = compiled.materials[i].source;
      const std::size_t named = source < 0 ? i : static_cast<std::size_t>(source);
      if (std::find(having.begin(), having.end(), named) == having.end()) having.push_back(named);
    }
    if (!having.empty())
      notes.push_back(who + " leaves out " + feature.what + " of " + shownNames(scene, having) +
                      " (docs/materials.md)");
  }
}

}  // namespace prelight
