#include "techniques/vector_occluders/occluder_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/values/value_reader.h"
#include "scene/gltf/gltf_embed.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t maxOccluders = 1u << 24;

std::vector<OccluderVector> readStored(const JsonCursor& json) {
  std::vector<OccluderVector> stored;
  for (std::size_t i = 0; i < json.arraySize(); ++i) {
    const std::string name = json.at(i).asString();
    const auto found = std::find(occluderVectorNames.begin(), occluderVectorNames.end(), name);
    if (found == occluderVectorNames.end())
      json.at(i).fail(fmt::format("expected one of {}, got {}", fmt::join(occluderVectorNames, ", "), name),
                      rebake);
    const auto vector = static_cast<OccluderVector>(found - occluderVectorNames.begin());
    if (!stored.empty() && vector <= stored.back())
      json.at(i).fail(fmt::format("{} is out of order", name), rebake);
    stored.push_back(vector);
  }
  if (stored.empty()) json.fail("expected the names of the vectors that are stored", rebake);
  return stored;
}

/// Rows of a primitive out of those of a scene.
struct GatheredRows {
  std::vector<std::uint32_t> offsets = {0};
  std::vector<std::uint32_t> occluders;
  std::vector<std::byte> records;
};

/// `records` are those of the scene, each of `recordBytes`.
GatheredRows gatherRows(const std::vector<std::uint32_t>& offsets,
                        const std::vector<std::uint32_t>& occluders, std::span<const std::byte> records,
                        std::size_t recordBytes, const PrimitiveRanges& ranges) {
  GatheredRows rows;
  for (const PrimitiveRange& range : ranges)
    for (std::uint32_t v = range.firstVertex; v < range.firstVertex + range.vertexCount; ++v) {
      const std::uint32_t first = offsets[v], end = offsets[v + 1];
      rows.occluders.insert(rows.occluders.end(), occluders.begin() + first, occluders.begin() + end);
      const auto part = records.subspan(first * recordBytes, (end - first) * recordBytes);
      rows.records.insert(rows.records.end(), part.begin(), part.end());
      rows.offsets.push_back(static_cast<std::uint32_t>(rows.occluders.size()));
    }
  // glTF has no accessor of 0 elements: rows that are all empty point at nothing.
  if (rows.occluders.empty()) {
    rows.occluders.push_back(0);
    rows.records.resize(recordBytes);
  }
  return rows;
}

Json offsetsAndNames(GltfDocument& document, const GatheredRows& rows,
                     const std::vector<OccluderVector>& stored) {
  Json json;
  json["offsets"] =
      appendAccessor(document, std::as_bytes(std::span(rows.offsets)), "SCALAR", 5125, rows.offsets.size());
  for (const OccluderVector vector : stored)
    json["stored"].push_back(occluderVectorNames[static_cast<std::size_t>(vector)]);
  return json;
}

Json namesToJson(const std::vector<std::string>& occluders) {
  Json names = Json::array();
  for (const std::string& name : occluders) names.push_back({{"name", name}});
  return names;
}

}  // namespace

Json occludersToJson(GltfDocument& document, const OccluderTransfer& transfer,
                     const PrimitiveRanges& ranges) {
  const std::size_t width = transfer.stored.size();
  const GatheredRows rows =
      gatherRows(transfer.offsets, transfer.occluders, std::as_bytes(std::span(transfer.vectors)),
                 width * sizeof(glm::vec4), ranges);
  Json json = offsetsAndNames(document, rows, transfer.stored);
  json["occluders"] = appendAccessor(document, std::as_bytes(std::span(rows.occluders)), "SCALAR", 5125,
                                     rows.occluders.size());
  json["vectors"] = appendAccessor(document, rows.records, "VEC4", 5126, rows.occluders.size() * width);
  return json;
}

Json occludersToJson(GltfDocument& document, const QuantizedOccluders& occluders,
                     const PrimitiveRanges& ranges) {
  const GatheredRows rows =
      gatherRows(occluders.offsets, occluders.occluders, std::as_bytes(std::span(occluders.bytes)),
                 quantizedBytes(occluders.stored), ranges);
  Json json = offsetsAndNames(document, rows, occluders.stored);
  if (occluders.names.size() <= 0x10000) {
    const std::vector<std::uint16_t> numbers(rows.occluders.begin(), rows.occluders.end());
    json["occluders"] =
        appendAccessor(document, std::as_bytes(std::span(numbers)), "SCALAR", 5123, numbers.size());
  } else {
    json["occluders"] = appendAccessor(document, std::as_bytes(std::span(rows.occluders)), "SCALAR", 5125,
                                       rows.occluders.size());
  }
  json["bytes"] = appendAccessor(document, rows.records, "SCALAR", component::uint8, rows.records.size());
  return json;
}

Json occluderNames(const OccluderTransfer& transfer) { return {{"occluders", namesToJson(transfer.names)}}; }

Json occluderNames(const QuantizedOccluders& occluders) {
  return {{"occluders", namesToJson(occluders.names)},
          {"distances", {occluders.leastDistance, occluders.mostDistance}}};
}

void OccluderRows::start(const JsonCursor& json, const std::vector<OccluderVector>& stored,
                         const std::optional<JsonCursor>& shared) {
  if (!shared) json.fail("the root's extension does not name the occluders", rebake);
  const JsonCursor occluders = shared->at("occluders");
  if (occluders.arraySize() > maxOccluders) occluders.fail("too many occluders", rebake);
  for (std::size_t i = 0; i < occluders.arraySize(); ++i)
    pool_.names.push_back(occluders.at(i).stringOr("name", ""));
  if (const auto distances = shared->find("distances")) {
    if (distances->arraySize() != 2) distances->fail("expected two", rebake);
    leastDistance_ = distances->at(0).asNumber();
    mostDistance_ = distances->at(1).asNumber();
    if (!(leastDistance_ > 0.0) || !(mostDistance_ >= leastDistance_) || !(mostDistance_ <= 1e30))
      distances->fail("expected the least distance, above 0, and the greatest", rebake);
  }
  pool_.stored = stored;
  started_ = true;
}

void OccluderRows::readVectors(const JsonCursor& json, std::size_t records) {
  const auto numbers = ValueReader(document_, root_).floats(json, "VEC4", records * pool_.stored.size());
  for (std::size_t i = 0; i + 3 < numbers.size(); i += 4)
    pool_.vectors.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]);
}

void OccluderRows::readQuantized(const JsonCursor& json, const PrimitiveRanges& ranges,
                                 const std::vector<std::uint32_t>& offsets, std::size_t records) {
  if (!(leastDistance_ > 0.0)) json.fail("the root's `vo` lacks the distances", rebake);
  const auto& stored = pool_.stored;
  if (std::find(stored.begin(), stored.end(), OccluderVector::Occlusion) == stored.end())
    json.fail("quantized records need occlusion", rebake);
  const std::size_t recordBytes = quantizedBytes(stored);
  const auto bytes = ValueReader(document_, root_).integers<std::uint8_t>(json, records * recordBytes);
  const std::size_t first = pool_.vectors.size();
  pool_.vectors.resize(first + records * stored.size(), glm::vec4(0.0f));
  std::size_t row = 0;
  for (const PrimitiveRange& range : ranges)
    for (std::uint32_t v = 0; v < range.vertexCount; ++v, ++row) {
      const glm::dvec3 vertex = scene_.origin + glm::dvec3(scene_.positions[range.firstVertex + v]);
      for (std::size_t r = offsets[row]; r < offsets[row + 1]; ++r)
        dequantizeRecord(stored, leastDistance_, mostDistance_, vertex, bytes.data() + r * recordBytes,
                         pool_.vectors.data() + first + r * stored.size());
    }
}

void OccluderRows::read(const JsonCursor& json, const PrimitiveRanges& ranges,
                        const std::optional<JsonCursor>& shared) {
  json.expectObject();
  const std::vector<OccluderVector> stored = readStored(json.at("stored"));
  if (!started_) start(json, stored, shared);
  if (stored != pool_.stored) json.fail("expected the vectors of the other primitives", rebake);
  const ValueReader values(document_, root_);
  const std::size_t vertices = vertexCount(ranges);
  const auto offsets = values.integers<std::uint32_t>(json.at("offsets"), vertices + 1);
  const auto occluders = values.shortOrLongIntegers(json.at("occluders"));
  if (offsets.front() != 0 || offsets.back() > occluders.size() ||
      !std::is_sorted(offsets.begin(), offsets.end()))
    json.at("offsets").fail("expected offsets that ascend from 0 to the number of records at most", rebake);
  for (std::size_t r = 0; r < offsets.back(); ++r)
    if (occluders[r] >= pool_.names.size())
      json.at("occluders").fail(fmt::format("occluder {} of {}", occluders[r], pool_.names.size()), rebake);
  const std::size_t base = pool_.occluders.size();
  pool_.occluders.insert(pool_.occluders.end(), occluders.begin(), occluders.end());
  if (const auto bytes = json.find("bytes"))
    readQuantized(*bytes, ranges, offsets, occluders.size());
  else
    readVectors(json.at("vectors"), occluders.size());
  std::size_t row = 0;
  for (const PrimitiveRange& range : ranges)
    for (std::uint32_t v = 0; v < range.vertexCount; ++v, ++row)
      rows_.push_back({range.firstVertex + v, {base + offsets[row], offsets[row + 1] - offsets[row]}});
}

OccluderTransfer OccluderRows::finish(std::size_t vertexCount) const {
  OccluderTransfer transfer{pool_.names, pool_.stored, {0}, {}, {}};
  std::vector<Row> rowOf(vertexCount);
  for (const auto& [vertex, row] : rows_) rowOf[vertex] = row;
  const std::size_t width = pool_.stored.size();
  for (const Row& row : rowOf) {
    for (std::size_t r = row.first; r < row.first + row.count; ++r) {
      transfer.occluders.push_back(pool_.occluders[r]);
      for (std::size_t k = 0; k < width; ++k) transfer.vectors.push_back(pool_.vectors[r * width + k]);
    }
    transfer.offsets.push_back(static_cast<std::uint32_t>(transfer.occluders.size()));
  }
  return transfer;
}

}  // namespace prelight
