#include "techniques/technique.h"

#include <fmt/format.h>

#include <algorithm>

namespace prelight {

nlohmann::ordered_json BakedOutput::column(std::string_view name, std::span<const float> values,
                                           const PrimitiveRanges& ranges, std::size_t width,
                                           const ByteForm& form, const char* type) const {
  const std::vector<float> gathered = gatherVertices(values, ranges, width);
  const std::size_t components = std::string_view(type) == "VEC3" ? 3 : 1;
  if (!quantizes()) return appendValues(document, gathered, type, components);
  return appendQuantized(document, gathered, form, type, components, {}, (*saved)[std::string(name)]);
}

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
