#include "techniques/chart_transfer/chart_file.h"

#include <algorithm>
#include <vector>

#include "io/values/baked_ranges.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t maxChartSide = 1u << 14;

std::size_t indexOf(const CompiledScene& scene, const PrimitiveRange& range) {
  const auto found =
      std::find_if(scene.primitives.begin(), scene.primitives.end(), [&](const PrimitiveRange& other) {
        return other.node == range.node && other.primitive == range.primitive &&
               other.instance == range.instance;
      });
  return static_cast<std::size_t>(found - scene.primitives.begin());
}

/// The place of a primitive's map among all; as many as there are where it has none.
std::size_t mapOf(const ChartTransfer& transfer, std::size_t primitive) {
  const auto found = std::find_if(transfer.maps.begin(), transfer.maps.end(),
                                  [&](const auto& map) { return map.primitive == primitive; });
  return static_cast<std::size_t>(found - transfer.maps.begin());
}

/// Rows of the maps before one.
std::size_t rowsBefore(const ChartTransfer& transfer, std::size_t map) {
  std::size_t rows = 0;
  for (std::size_t m = 0; m < map; ++m) rows += transfer.maps[m].texels();
  return rows;
}

}  // namespace

Json chartsToJson(GltfDocument& document, const ChartTransfer& transfer,
                  const std::optional<CompressedTransfer>& compressed, const CompiledScene& scene,
                  const PrimitiveRanges& ranges) {
  std::vector<float> coords, coefficients;
  std::vector<RowRange> rows;
  const ChartTransfer::Map* first = nullptr;
  for (const PrimitiveRange& range : ranges) {
    const std::size_t place = mapOf(transfer, indexOf(scene, range));
    if (place == transfer.maps.size()) return nullptr;
    const ChartTransfer::Map& map = transfer.maps[place];
    if (first == nullptr) first = &map;
    for (const glm::vec2& uv : map.coords) coords.insert(coords.end(), {uv.x, uv.y});
    if (compressed)
      rows.push_back({rowsBefore(transfer, place), map.texels()});
    else
      coefficients.insert(coefficients.end(), map.coefficients.begin(), map.coefficients.end());
  }
  if (first == nullptr) return nullptr;
  Json json = {{"width", first->width},       {"height", first->height},
               {"order", transfer.order},     {"channels", transfer.channels},
               {"bounces", transfer.bounces}, {"texCoord", appendValues(document, coords, "VEC2", 2)}};
  if (compressed)
    json["compressed"] = rowsToJson(document, *compressed, rows);
  else
    json["coefficients"] = appendValues(document, coefficients);
  return json;
}

ChartReader::ChartReader(const BakedInput& input) : input_(input), values_(input.document, input.root) {}

/// The first primitive sets what all have.
void ChartReader::readHeader(const JsonCursor& json) {
  json.expectObject();
  const ChartTransfer header{
      readNumber(json.at("order"), 1, maxStoredOrder), readChannels(json), readBounces(json), {}};
  if (!transfer_) transfer_ = header;
  if (header.order != transfer_->order || header.channels != transfer_->channels ||
      header.bounces != transfer_->bounces)
    json.fail("expected the order, channels and bounces of the other primitives", rebake);
}

void ChartReader::readRowsOf(const JsonCursor& json, std::size_t texels) {
  if (!compressed_) {
    const JsonCursor shared = sharedAt(input_.extension, "texelsCompressed", json);
    compressed_ = readShared(values_, shared);
    if (compressed_->order != transfer_->order || compressed_->channels != transfer_->channels)
      shared.fail("expected the order and channels of the texels", rebake);
  }
  const RowRange rows{compressed_->vertexCount, texels};
  compressed_->vertexCount += static_cast<std::uint32_t>(texels);
  readRows(values_, json, std::span(&rows, 1), *compressed_);
}

void ChartReader::read(const JsonCursor& json, const PrimitiveRanges& ranges) {
  readHeader(json);
  const int width = readNumber(json.at("width"), 1, maxChartSide),
            height = readNumber(json.at("height"), 1, maxChartSide);
  const std::size_t texels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                    each = texels * transfer_->rowLength();
  const std::vector<float> coords = values_.floats(json.at("texCoord"), "VEC2", vertexCount(ranges));
  const auto compressed = json.find("compressed");
  std::vector<float> coefficients;
  const std::size_t rowsBefore = compressed_ ? compressed_->vertexCount : 0;
  if (compressed)
    readRowsOf(*compressed, texels * ranges.size());
  else
    coefficients = values_.floats(json.at("coefficients"), "SCALAR", each * ranges.size());
  std::size_t vertex = 0;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    ChartTransfer::Map map{indexOf(input_.scene, ranges[i]), width, height, {}, {}};
    if (compressed)
      rows_[map.primitive] = {rowsBefore + i * texels, texels};
    else
      map.coefficients.assign(coefficients.begin() + static_cast<std::ptrdiff_t>(i * each),
                              coefficients.begin() + static_cast<std::ptrdiff_t>((i + 1) * each));
    for (std::uint32_t v = 0; v < ranges[i].vertexCount; ++v, ++vertex)
      map.coords.emplace_back(coords[2 * vertex], coords[2 * vertex + 1]);
    transfer_->maps.push_back(std::move(map));
  }
}

void ChartReader::placeCompressed(std::optional<CompressedTransfer>& compressed) {
  std::vector<RowRange> inOrder;
  for (const ChartTransfer::Map& map : transfer_->maps) inOrder.push_back(rows_[map.primitive]);
  compressed = takeRows(*compressed_, inOrder);
  const std::vector<float> all = decompress(*compressed).coefficients;
  auto from = all.begin();
  for (ChartTransfer::Map& map : transfer_->maps) {
    const auto length = static_cast<std::ptrdiff_t>(map.texels() * transfer_->rowLength());
    map.coefficients.assign(from, from + length);
    from += length;
  }
}

void ChartReader::finish(std::optional<ChartTransfer>& transfer,
                         std::optional<CompressedTransfer>& compressed) {
  if (!transfer_) return;
  std::sort(transfer_->maps.begin(), transfer_->maps.end(),
            [](const auto& a, const auto& b) { return a.primitive < b.primitive; });
  if (compressed_) placeCompressed(compressed);
  transfer = std::move(transfer_);
}

}  // namespace prelight
