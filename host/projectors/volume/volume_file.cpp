#include "projectors/volume/volume_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/values/value_reader.h"
#include "scene/gltf/gltf_embed.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

constexpr int volumeFloat = 5126, volumeByte = 5121;
constexpr std::uint64_t maxVolumeOrder = 32, maxVolumeSide = 1024;
constexpr std::uint64_t maxSentOrder = 3, mostLightGroups = 1u << 16;

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
    grid.size[a] = readNumber(json.at("size").at(static_cast<std::size_t>(a)), 1, maxVolumeSide);
  grid.min = readPoint(json.at("min"));
  grid.max = readPoint(json.at("max"));
  const glm::dvec3 sides = (grid.max - grid.min) / glm::dvec3(grid.size);
  const double most = std::max({sides.x, sides.y, sides.z}), least = std::min({sides.x, sides.y, sides.z});
  if (!(least > 0.0) || most - least > 1e-3 * most)
    json.at("max").fail(
        fmt::format("expected cubic cells, got cells of {} x {} x {} m", sides.x, sides.y, sides.z), rebake);
  return grid;
}

/// What surfaces send, where it is kept.
void readSent(const JsonCursor& json, const ValueReader& values, VolumeTransfer& volume) {
  const std::size_t channelsOfAll = 3 * volume.grid.count();
  if (const auto sent = json.find("sent")) {
    volume.sentOrder = readNumber(json.at("sentOrder"), 1, maxSentOrder);
    volume.sent = values.floats(*sent, "SCALAR", channelsOfAll * volume.sentBands() * volume.columns());
  }
  if (const auto lights = json.find("lights")) {
    volume.lightOrder = readNumber(json.at("lightOrder"), 1, maxSentOrder);
    const auto groups = static_cast<std::size_t>(readNumber(json.at("groupCount"), 1, mostLightGroups));
    volume.lights = values.floats(*lights, "SCALAR", channelsOfAll * volume.lightBands() * groups);
  }
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
  json["coefficients"] = append(volume.coefficients, volumeFloat);
  if (!volume.direct.empty()) json["direct"] = append(volume.direct, volumeFloat);
  json["air"] = append(volume.air, volumeByte);
  if (!volume.sent.empty()) {
    json["sentOrder"] = volume.sentOrder;
    json["sent"] = append(volume.sent, volumeFloat);
  }
  if (!volume.lights.empty()) {
    json["lightOrder"] = volume.lightOrder;
    json["groupCount"] = volume.groups();
    json["lights"] = append(volume.lights, volumeFloat);
  }
  return json;
}

VolumeTransfer readVolume(const GltfDocument& document, const JsonCursor& root, const JsonCursor& json) {
  json.expectObject();
  VolumeTransfer volume;
  volume.grid = readGrid(json);
  volume.order = readNumber(json.at("order"), 1, maxVolumeOrder);
  volume.channels = readChannels(json);
  volume.bounces = readBounces(json);
  const std::size_t count = volume.grid.count() * volume.columns();
  const ValueReader values(document, root);
  volume.coefficients =
      values.floats(json.at("coefficients"), "SCALAR", count * static_cast<std::size_t>(volume.channels));
  if (const auto direct = json.find("direct")) volume.direct = values.floats(*direct, "SCALAR", count);
  if (volume.channels == 3 && volume.direct.empty())
    json.fail("three channels without the transfer before bounces, 'direct'", rebake);
  volume.air = values.integers<std::uint8_t>(json.at("air"), volume.grid.count());
  readSent(json, values, volume);
  return volume;
}

}  // namespace prelight
