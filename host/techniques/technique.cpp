#include "techniques/technique.h"

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

std::string counted(std::size_t count, const char* one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

std::string channelsText(int channels, int bounces) {
  return counted(static_cast<std::size_t>(channels), "channel") + ", " +
         counted(static_cast<std::size_t>(bounces), "bounce");
}

}  // namespace prelight
