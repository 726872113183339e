#include "io/finite_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/magnitudes.h"
#include "prelight/error.h"
#include "scene/gltf/accessor.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

/// Returns the path of the baked member that refers to an accessor, such as "/sh/coefficients".
std::optional<std::string> pathOf(const Json& json, std::size_t accessor) {
  if (!json.is_structured()) return json == accessor ? std::optional<std::string>("") : std::nullopt;
  for (const auto& member : json.items())
    if (const auto rest = pathOf(member.value(), accessor)) return "/" + member.key() + *rest;
  return std::nullopt;
}

std::string placeOf(const GltfDocument& document, std::size_t accessor) {
  std::size_t index = 0;
  for (const Json& node : document.json.at("nodes")) {
    const Json extensions = node.value("extensions", Json::object());
    if (const auto path = pathOf(extensions.value("PRELIGHT_transfer", Json()), accessor))
      return fmt::format("/nodes/{}{}", index, *path);
    ++index;
  }
  return fmt::format("/accessors/{}", accessor);
}

/// Throws if `values` contains an unusable number; `place` describes its position.
template <class Place>
void requireUsable(std::span<const float> values, const std::filesystem::path& path, Place place) {
  const auto bad = std::find_if_not(values.begin(), values.end(),
                                    [](float value) { return std::abs(value) <= largestBaked; });
  if (bad == values.end()) return;
  throw Error(ExitCode::RuntimeFailure, path.string(),
              fmt::format("the bake gave {} at {}, expected numbers of at most {:g}; nothing is written",
                          *bad, place(), largestBaked),
              "look for huge coordinates, lights or emission in the scene");
}

}  // namespace

void requireFinite(const std::filesystem::path& path, const Picture& picture) {
  const auto bad = std::find_if_not(picture.pixels.begin(), picture.pixels.end(), [](const glm::vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  });
  if (bad == picture.pixels.end()) return;
  const std::ptrdiff_t at = bad - picture.pixels.begin();
  throw Error(ExitCode::RuntimeFailure, path.string(),
              fmt::format("the pixel in column {}, row {} came out as ({:g}, {:g}, {:g}); nothing is written",
                          at % picture.width, at / picture.width, bad->x, bad->y, bad->z),
              "look for huge coordinates, lights or emission in the scene");
}

void requireFiniteBake(const GltfDocument& document, std::size_t firstAccessor) {
  constexpr int floatType = 5126;
  const Json accessors = document.json.value("accessors", Json::array());
  for (std::size_t i = firstAccessor; i < accessors.size(); ++i) {
    if (accessors[i].at("componentType") != floatType || accessors[i].at("count") == 0) continue;
    requireUsable(AccessorReader(document, i).floats(), document.path, [&] { return placeOf(document, i); });
  }
}

void requireFiniteLightMap(const std::filesystem::path& path, const LightMap& map) {
  requireUsable(map.values, path, [] { return std::string("a texel of the light map"); });
  for (const EncodedLight& light : map.encoded)
    requireUsable(light.values, path, [&] { return "a texel of the light map as " + light.encoding; });
}

}  // namespace prelight
