#include <algorithm>
#include <cmath>
#include <numeric>

#include "techniques/bake_fit.h"
#include "techniques/shading.h"
#include "techniques/thickness/thickness.h"

namespace prelight {
namespace {

/// Returns the mean over the vertices that lie on bodies, m; 1 where none do.
double meanThickness(const std::vector<float>& thickness) {
  const auto bodies = std::ranges::count_if(thickness, [](float t) { return t > 0.0f; });
  const double sum = std::accumulate(thickness.begin(), thickness.end(), 0.0);
  return bodies > 0 ? sum / static_cast<double>(bodies) : 1.0;
}

/// Returns the share of light that passes through the body below each vertex, [vertex]: what the absorption
/// of its material leaves of a ray as long as the thickness. In a body whose material absorbs nothing, light
/// falls to 1/e over the mean thickness of the bake.
std::vector<glm::vec3> passages(const Bake& bake, const CompiledScene& scene) {
  const auto usual = static_cast<float>(1.0 / meanThickness(bake.thickness));
  std::vector<glm::vec3> passed(bake.thickness.size());
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const glm::vec3 absorption = scene.materials[scene.triangleMaterials[t]].absorption;
    const glm::vec3 density = absorption == glm::vec3(0.0f) ? glm::vec3(usual) : absorption;
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = scene.triangles[t][corner];
      passed[vertex] = glm::exp(-bake.thickness[vertex] * density);
    }
  }
  return passed;
}

}  // namespace

extern const ShadingInfo thicknessShading = {
    .shading = Shading::Thickness,
    .summary = "like phong, with light that shines through bodies as far as they are thin",
    .bakeOption = "thickness",
    .bakedName = "thickness",
    .rules = {{"thickness_ambient.glsl"}, Reflection::Everywhere, Through::None},
    .error = {.sky = 0.1f, .outside = 0.1f, .inside = 0.1f},
    .carriedBy = [](const Bake& bake) { return !bake.thickness.empty(); },
    .askedBy = [](const BakeRequest& request) { return request.thickness; },
    .addTo = [](BakeRequest& request, const BakeRequest&) { request.thickness = true; },
    .check =
        [](const Bake& bake, const CompiledScene& scene) {
          if (!bake.thickness.empty()) requireCount("thickness", bake.thickness.size(), scene.vertexCount());
        },
    .take =
        [](Bake& into, Bake& from) {
          if (!from.thickness.empty()) into.thickness = std::move(from.thickness);
        },
    .vertexNumbers = passages,
};

}  // namespace prelight
