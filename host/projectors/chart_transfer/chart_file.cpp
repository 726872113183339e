#include "projectors/chart_transfer/chart_file.h"

#include <algorithm>
#include <vector>

#include "io/values/value_reader.h"
#include "scene/gltf/gltf_embed.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

constexpr int chartFloat = 5126;
constexpr std::uint64_t maxChartOrder = 32, maxChartSide = 1u << 14;

std::size_t indexOf(const CompiledScene& scene, const PrimitiveRange& range) {
  const auto found =
      std::find_if(scene.primitives.begin(), scene.primitives.end(), [&](const PrimitiveRange& other) {
        return other.node == range.node && other.primitive == range.primitive &&
               other.instance == range.instance;
      });
  return static_cast<std::size_t>(found - scene.primitives.begin());
}

const ChartTransfer::Map* mapOf(const ChartTransfer& transfer, std::size_t primitive) {
  const auto found = std::find_if(transfer.maps.begin(), transfer.maps.end(),
                                  [&](const auto& map) { return map.primitive == primitive; });
  return found == transfer.maps.end() ? nullptr : &*found;
}

}  // namespace

Json chartsToJson(GltfDocument& document, const ChartTransfer& transfer, const CompiledScene& scene,
                  const PrimitiveRanges& ranges) {
  std::vector<float> coords, coefficients;
  const ChartTransfer::Map* first = nullptr;
  for (const PrimitiveRange& range : ranges) {
    const ChartTransfer::Map* map = mapOf(transfer, indexOf(scene, range));
    if (map == nullptr) return nullptr;
    if (first == nullptr) first = map;
    for (const glm::vec2& uv : map->coords) coords.insert(coords.end(), {uv.x, uv.y});
    coefficients.insert(coefficients.end(), map->coefficients.begin(), map->coefficients.end());
  }
  if (first == nullptr) return nullptr;
  const auto append = [&](const std::vector<float>& values, const char* type, std::size_t components) {
    return appendAccessor(document, std::as_bytes(std::span(values)), type, chartFloat,
                          values.size() / components);
  };
  return {{"width", first->width},
          {"height", first->height},
          {"order", transfer.order},
          {"channels", transfer.channels},
          {"bounces", transfer.bounces},
          {"texCoord", append(coords, "VEC2", 2)},
          {"coefficients", append(coefficients, "SCALAR", 1)}};
}

void readCharts(const GltfDocument& document, const JsonCursor& root, const JsonCursor& json,
                const CompiledScene& scene, const PrimitiveRanges& ranges,
                std::optional<ChartTransfer>& transfer) {
  json.expectObject();
  const ChartTransfer header{
      readNumber(json.at("order"), 1, maxChartOrder), readChannels(json), readBounces(json), {}};
  if (!transfer) transfer = header;
  if (header.order != transfer->order || header.channels != transfer->channels ||
      header.bounces != transfer->bounces)
    json.fail("expected the order, channels and bounces of the other primitives", rebake);
  const int width = readNumber(json.at("width"), 1, maxChartSide),
            height = readNumber(json.at("height"), 1, maxChartSide);
  const ValueReader values(document, root);
  const std::size_t each =
      static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * header.rowLength();
  const std::vector<float> coords = values.floats(json.at("texCoord"), "VEC2", vertexCount(ranges));
  const std::vector<float> coefficients =
      values.floats(json.at("coefficients"), "SCALAR", each * ranges.size());
  std::size_t vertex = 0;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const auto from = coefficients.begin() + static_cast<std::ptrdiff_t>(i * each);
    ChartTransfer::Map map{indexOf(scene, ranges[i]),
                           width,
                           height,
                           {},
                           std::vector<float>(from, from + static_cast<std::ptrdiff_t>(each))};
    for (std::uint32_t v = 0; v < ranges[i].vertexCount; ++v, ++vertex)
      map.coords.emplace_back(coords[2 * vertex], coords[2 * vertex + 1]);
    transfer->maps.push_back(std::move(map));
  }
}

void sortMaps(ChartTransfer& transfer) {
  std::sort(transfer.maps.begin(), transfer.maps.end(),
            [](const auto& a, const auto& b) { return a.primitive < b.primitive; });
}

}  // namespace prelight
