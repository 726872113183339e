#include "io/volume_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/accessor.h"
#include "scene/gltf_embed.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* rebake = "bake the scene again";
constexpr int floatType = 5126, byteType = 5121;
constexpr std::uint64_t maxOrder = 32, maxSide = 1024;

AccessorReader open(const GltfDocument& document, const JsonCursor& root, const JsonCursor& reference,
                    int componentType, std::size_t count) {
  AccessorReader reader(document, reference.asIndex(root.countOf("accessors"), "accessor"));
  if (reader.type() != "SCALAR" || reader.componentType() != componentType || reader.count() != count)
    reference.fail(fmt::format("expected {} scalars of component type {}, got {} of type {} and component "
                               "type {}",
                               count, componentType, reader.count(), reader.type(), reader.componentType()),
                   rebake);
  return reader;
}

std::vector<float> readFloats(const GltfDocument& document, const JsonCursor& root,
                              const JsonCursor& reference, std::size_t count) {
  std::vector<float> values = open(document, root, reference, floatType, count).floats();
  if (!std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); }))
    reference.fail("a value is not finite", rebake);
  return values;
}

int readWhole(const JsonCursor& json, std::uint64_t least, std::uint64_t most) {
  const std::uint64_t value = json.asUnsigned();
  if (value < least || value > most)
    json.fail(fmt::format("expected {}..{}, got {}", least, most, value), rebake);
  return static_cast<int>(value);
}

glm::dvec3 readPoint(const JsonCursor& json) {
  json.expectNumbers(3);
  glm::dvec3 point(0.0);
  for (int a = 0; a < 3; ++a) {
    point[a] = json.at(static_cast<std::size_t>(a)).asNumber();
    if (!std::isfinite(point[a])) json.fail("expected finite numbers", rebake);
  }
  return point;
}

VolumeGrid readGrid(const JsonCursor& json) {
  VolumeGrid grid;
  json.at("size").expectNumbers(3);
  for (int a = 0; a < 3; ++a)
    grid.size[a] = readWhole(json.at("size").at(static_cast<std::size_t>(a)), 1, maxSide);
  grid.min = readPoint(json.at("min"));
  grid.max = readPoint(json.at("max"));
  const glm::dvec3 sides = (grid.max - grid.min) / glm::dvec3(grid.size);
  const double most = std::max({sides.x, sides.y, sides.z}), least = std::min({sides.x, sides.y, sides.z});
  if (!(least > 0.0) || most - least > 1e-3 * most)
    json.at("max").fail(
        fmt::format("expected cubic cells, got cells of {} x {} x {} m", sides.x, sides.y, sides.z), rebake);
  return grid;
}

Json numbers(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

}  // namespace

Json volumeToJson(GltfDocument& document, const VolumeTransfer& volume) {
  const auto append = [&](const auto& values, int componentType) {
    return appendAccessor(document, std::as_bytes(std::span(values)), "SCALAR", componentType, values.size());
  };
  const VolumeGrid& grid = volume.grid;
  Json json = {{"size", {grid.size.x, grid.size.y, grid.size.z}},
               {"min", numbers(grid.min)},
               {"max", numbers(grid.max)},
               {"order", volume.order},
               {"channels", volume.channels},
               {"bounces", volume.bounces}};
  json["coefficients"] = append(volume.coefficients, floatType);
  if (!volume.direct.empty()) json["direct"] = append(volume.direct, floatType);
  json["air"] = append(volume.air, byteType);
  return json;
}

VolumeTransfer readVolume(const GltfDocument& document, const JsonCursor& root, const JsonCursor& json) {
  json.expectObject();
  VolumeTransfer volume;
  volume.grid = readGrid(json);
  volume.order = readWhole(json.at("order"), 1, maxOrder);
  volume.channels = readWhole(json.at("channels"), 1, 3);
  if (volume.channels == 2) json.at("channels").fail("expected 1 or 3, got 2", rebake);
  volume.bounces = static_cast<int>(std::min<std::uint64_t>(json.unsignedOr("bounces", 0), 1u << 20));
  const std::size_t count = volume.grid.count() * volume.columns();
  volume.coefficients =
      readFloats(document, root, json.at("coefficients"), count * static_cast<std::size_t>(volume.channels));
  if (const auto direct = json.find("direct")) volume.direct = readFloats(document, root, *direct, count);
  if (volume.channels == 3 && volume.direct.empty())
    json.fail("three channels without the transfer before bounces, 'direct'", rebake);
  const auto air = open(document, root, json.at("air"), byteType, volume.grid.count()).unsignedIntegers();
  volume.air.assign(air.begin(), air.end());
  return volume;
}

}  // namespace prelight
