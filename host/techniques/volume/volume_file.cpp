#include "techniques/volume/volume_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/values/baked_ranges.h"
#include "io/values/value_reader.h"
#include "techniques/compressed_rows.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t maxVolumeSide = 1024;
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

/// Values of all cells, as floats at `member` or compressed at `memberCompressed`; empty where neither is.
std::vector<float> readCells(const JsonCursor& json, const ValueReader& values, const char* member,
                             int channels, const VolumeTransfer& volume,
                             std::optional<CompressedTransfer>& compressed) {
  const std::size_t cells = volume.grid.count();
  if (const auto floats = json.find(member))
    return values.floats(*floats, "SCALAR", cells * static_cast<std::size_t>(channels) * volume.columns());
  const auto rows = json.find(member + std::string("Compressed"));
  if (!rows) return {};
  CompressedTransfer shared = readShared(values, *rows, channels);
  if (shared.order != volume.order || shared.channels != channels)
    rows->fail(fmt::format("expected order {} and {} channels, got order {} and {} channels", volume.order,
                           channels, shared.order, shared.channels),
               rebake);
  compressed = readAllRows(values, *rows, cells, std::move(shared));
  return decompress(*compressed).coefficients;
}

/// What surfaces send, where it is kept.
void readSent(const JsonCursor& json, const ValueReader& values, VolumeTransfer& volume,
              CompressedParts& compressed) {
  const std::size_t channelsOfAll = 3 * volume.grid.count();
  if (json.find("sentOrder")) {
    volume.sentOrder = readNumber(json.at("sentOrder"), 1, maxSentOrder);
    volume.sent = readCells(json, values, "sent", 3 * volume.sentOrder * volume.sentOrder, volume,
                            compressed.volumeSent);
  }
  if (const auto lights = json.find("lights")) {
    volume.lightOrder = readNumber(json.at("lightOrder"), 1, maxSentOrder);
    const auto groups = static_cast<std::size_t>(readNumber(json.at("groupCount"), 1, mostLightGroups));
    volume.lights = values.floats(*lights, "SCALAR", channelsOfAll * volume.lightBands() * groups);
  }
}

/// Floats at `member`, or what stands for them at `memberCompressed`.
void addCells(GltfDocument& document, const std::vector<float>& values, const char* member,
              const std::optional<CompressedTransfer>& compressed, Json& json) {
  if (values.empty()) return;
  if (!compressed) {
    json[member] = appendValues(document, values);
    return;
  }
  const RowRange all{0, compressed->vertexCount};
  Json rows = sharedToJson(document, *compressed);
  rows.update(rowsToJson(document, *compressed, std::span(&all, 1)));
  json[member + std::string("Compressed")] = std::move(rows);
}

Json numbers(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

}  // namespace

Json volumeToJson(GltfDocument& document, const VolumeTransfer& volume, const CompressedParts& compressed) {
  const VolumeGrid& grid = volume.grid;
  Json json = {{"size", {grid.size.x, grid.size.y, grid.size.z}},
               {"min", numbers(grid.min)},
               {"max", numbers(grid.max)},
               {"order", volume.order},
               {"channels", volume.channels},
               {"bounces", volume.bounces}};
  addCells(document, volume.coefficients, "coefficients", compressed.volume, json);
  addCells(document, volume.direct, "direct", compressed.volumeDirect, json);
  json["air"] = appendValues(document, volume.air);
  if (!volume.sent.empty()) {
    json["sentOrder"] = volume.sentOrder;
    addCells(document, volume.sent, "sent", compressed.volumeSent, json);
  }
  if (!volume.lights.empty()) {
    json["lightOrder"] = volume.lightOrder;
    json["groupCount"] = volume.groups();
    json["lights"] = appendValues(document, volume.lights);
  }
  return json;
}

VolumeTransfer readVolume(const GltfDocument& document, const JsonCursor& root, const JsonCursor& json,
                          CompressedParts& compressed) {
  json.expectObject();
  VolumeTransfer volume;
  volume.grid = readGrid(json);
  volume.order = readNumber(json.at("order"), 1, maxStoredOrder);
  volume.channels = readChannels(json);
  volume.bounces = readBounces(json);
  const ValueReader values(document, root);
  volume.coefficients = readCells(json, values, "coefficients", volume.channels, volume, compressed.volume);
  if (volume.coefficients.empty()) json.at("coefficients");
  volume.direct = readCells(json, values, "direct", 1, volume, compressed.volumeDirect);
  if (volume.channels == 3 && volume.direct.empty())
    json.fail("three channels without the transfer before bounces, 'direct'", rebake);
  volume.air = values.integers<std::uint8_t>(json.at("air"), volume.grid.count());
  readSent(json, values, volume, compressed);
  return volume;
}

}  // namespace prelight
