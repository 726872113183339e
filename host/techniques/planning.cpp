#include "techniques/planning.h"

#include <fmt/format.h>

#include <algorithm>

namespace prelight {

std::uint64_t plannedRays(const CompiledScene& scene, const BakeRequest& request) {
  return request.effort.error || request.effort.seconds
             ? ~std::uint64_t{0} / senderBytes
             : request.effort.rays * scene.vertexCount() * 5 / 4 + 65536;
}

std::size_t countMaterials(const Scene& scene, bool (*test)(const Material&)) {
  return static_cast<std::size_t>(std::count_if(scene.materials.begin(), scene.materials.end(), test));
}

std::string plannedChannels(bool colored) {
  return colored ? "3 channels" : "1 channel because nothing colours the light";
}

PlannedPass planHarmonics(Pass name, int order, bool colored, const std::string& how) {
  if (order == 0) return {name, false, "not asked for"};
  return {
      name, true,
      fmt::format("order {}, {} coefficients, {}{}", order, order * order, plannedChannels(colored), how)};
}

}  // namespace prelight
