#include "io/occluder_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/value_reader.h"
#include "scene/gltf_embed.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t maxOccluders = 1u << 24;

std::vector<OccluderVector> readStored(const JsonCursor& json) {
  std::vector<OccluderVector> stored;
  for (std::size_t i = 0; i < json.arraySize(); ++i) {
    const std::string& name = json.at(i).asString();
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

}  // namespace

Json occludersToJson(GltfDocument& document, const OccluderTransfer& transfer,
                     const PrimitiveRanges& ranges) {
  std::vector<std::uint32_t> offsets = {0}, occluders;
  std::vector<glm::vec4> vectors;
  const std::size_t width = transfer.stored.size();
  for (const PrimitiveRange& range : ranges)
    for (std::uint32_t v = range.firstVertex; v < range.firstVertex + range.vertexCount; ++v) {
      const std::uint32_t first = transfer.offsets[v], end = transfer.offsets[v + 1];
      occluders.insert(occluders.end(), transfer.occluders.begin() + first, transfer.occluders.begin() + end);
      vectors.insert(vectors.end(), transfer.vectors.begin() + static_cast<std::ptrdiff_t>(first * width),
                     transfer.vectors.begin() + static_cast<std::ptrdiff_t>(end * width));
      offsets.push_back(static_cast<std::uint32_t>(occluders.size()));
    }
  // glTF has no accessor of 0 elements: rows that are all empty point at nothing.
  if (occluders.empty()) {
    occluders.push_back(0);
    vectors.resize(width, glm::vec4(0.0f));
  }
  Json json;
  json["offsets"] =
      appendAccessor(document, std::as_bytes(std::span(offsets)), "SCALAR", 5125, offsets.size());
  json["occluders"] =
      appendAccessor(document, std::as_bytes(std::span(occluders)), "SCALAR", 5125, occluders.size());
  json["vectors"] = appendAccessor(document, std::as_bytes(std::span(vectors)), "VEC4", 5126, vectors.size());
  for (const OccluderVector vector : transfer.stored)
    json["stored"].push_back(occluderVectorNames[static_cast<std::size_t>(vector)]);
  return json;
}

Json occluderNames(const OccluderTransfer& transfer) {
  Json names = Json::array();
  for (const std::string& name : transfer.names) names.push_back({{"name", name}});
  return {{"occluders", std::move(names)}};
}

void OccluderRows::read(const JsonCursor& json, const PrimitiveRanges& ranges,
                        const std::optional<JsonCursor>& shared) {
  json.expectObject();
  const std::vector<OccluderVector> stored = readStored(json.at("stored"));
  if (!started_) {
    if (!shared) json.fail("the root's extension does not name the occluders", rebake);
    const JsonCursor occluders = shared->at("occluders");
    if (occluders.arraySize() > maxOccluders) occluders.fail("too many occluders", rebake);
    for (std::size_t i = 0; i < occluders.arraySize(); ++i)
      pool_.names.push_back(occluders.at(i).stringOr("name", ""));
    pool_.stored = stored;
    started_ = true;
  }
  if (stored != pool_.stored) json.fail("expected the vectors of the other primitives", rebake);
  const ValueReader values(document_, root_);
  const std::size_t vertices = vertexCount(ranges);
  const auto offsets = values.integers<std::uint32_t>(json.at("offsets"), vertices + 1);
  const auto occluders = values.integers<std::uint32_t>(json.at("occluders"), std::nullopt);
  if (offsets.front() != 0 || offsets.back() > occluders.size() ||
      !std::is_sorted(offsets.begin(), offsets.end()))
    json.at("offsets").fail("expected offsets that ascend from 0 to the number of records at most", rebake);
  const auto numbers = values.floats(json.at("vectors"), "VEC4", occluders.size() * stored.size());
  for (std::size_t r = 0; r < offsets.back(); ++r)
    if (occluders[r] >= pool_.names.size())
      json.at("occluders").fail(fmt::format("occluder {} of {}", occluders[r], pool_.names.size()), rebake);
  const std::size_t base = pool_.occluders.size();
  pool_.occluders.insert(pool_.occluders.end(), occluders.begin(), occluders.end());
  for (std::size_t i = 0; i + 3 < numbers.size(); i += 4)
    pool_.vectors.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]);
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
