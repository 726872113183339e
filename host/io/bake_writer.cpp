#include "io/bake_writer.h"

#include <array>

#include "io/chart_file.h"
#include "io/compression_names.h"
#include "io/occluder_file.h"
#include "scene/gltf/gltf_embed.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

template <typename T>
constexpr int componentTypeOf() {
  if constexpr (std::is_same_v<T, float>) return 5126;
  if constexpr (std::is_same_v<T, std::uint32_t>) return 5125;
  if constexpr (std::is_same_v<T, std::uint16_t>) return 5123;
  return 5121;
}

template <typename T>
int append(GltfDocument& document, std::span<const T> values, const char* type = "SCALAR",
           std::size_t components = 1) {
  return appendAccessor(document, std::as_bytes(values), type, componentTypeOf<T>(),
                        values.size() / components);
}

template <typename T>
int append(GltfDocument& document, const std::vector<T>& values, const char* type = "SCALAR",
           std::size_t components = 1) {
  return append(document, std::span(values), type, components);
}

template <typename T>
int appendVertices(GltfDocument& document, const std::vector<T>& values, const PrimitiveRanges& ranges,
                   std::size_t width) {
  return append(document, gatherVertices(std::span<const T>(values), ranges, width));
}

std::span<const float> asFloats(const std::vector<glm::vec3>& vectors) {
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  return {reinterpret_cast<const float*>(vectors.data()), 3 * vectors.size()};
}

Json harmonicToJson(GltfDocument& document, const HarmonicTransfer& transfer, const PrimitiveRanges& ranges) {
  const auto width = static_cast<std::size_t>(transfer.order * transfer.order * transfer.channels);
  Json json = {{"order", transfer.order}, {"channels", transfer.channels}, {"bounces", transfer.bounces}};
  if (transfer.naive) json["projection"] = "naive";
  json["coefficients"] = appendVertices(document, transfer.coefficients, ranges, width);
  return json;
}

/// The parts of a scene's sparse rows that belong to ranges, one after the other, in an accessor of numbers
/// of type T.
template <typename T, typename Stored>
int appendRows(GltfDocument& document, const std::vector<Stored>& values, const HaarTransfer& haar,
               const PrimitiveRanges& ranges) {
  const auto channels = static_cast<std::size_t>(haar.channels);
  std::vector<T> gathered;
  for (const PrimitiveRange& range : ranges) {
    const std::uint32_t first = haar.offsets[range.firstVertex * channels],
                        last = haar.offsets[(range.firstVertex + range.vertexCount) * channels];
    const auto rows = std::span(values).subspan(first, last - first);
    if constexpr (std::is_same_v<T, Stored>)
      if (ranges.size() == 1 && !rows.empty()) return append(document, rows);
    gathered.insert(gathered.end(), rows.begin(), rows.end());
  }
  // glTF has no accessor of 0 elements: rows that are all empty point at nothing.
  if (gathered.empty()) gathered.push_back(0);
  return append(document, gathered);
}

Json haarToJson(GltfDocument& document, const HaarTransfer& haar, const PrimitiveRanges& ranges) {
  const auto channels = static_cast<std::size_t>(haar.channels);
  std::vector<std::uint32_t> offsets = {0};
  for (const PrimitiveRange& range : ranges) {
    const std::size_t first = range.firstVertex * channels, last = first + range.vertexCount * channels;
    const std::uint32_t base = offsets.back() - haar.offsets[first];  // may wrap, as the sums below do
    for (std::size_t row = first; row < last; ++row) offsets.push_back(base + haar.offsets[row + 1]);
  }
  Json json = {{"faceSize", haar.faceSize}, {"channels", haar.channels}, {"bounces", haar.bounces}};
  json["offsets"] = append(document, offsets);
  json["indices"] = haar.storedIndexBytes() == sizeof(std::uint16_t)
                        ? appendRows<std::uint16_t>(document, haar.indices, haar, ranges)
                        : appendRows<std::uint32_t>(document, haar.indices, haar, ranges);
  json["values"] = appendRows<float>(document, haar.values, haar, ranges);
  return json;
}

Json glossyToJson(GltfDocument& document, const GlossyTransfer& glossy, const PrimitiveRanges& ranges) {
  const int n = glossy.order * glossy.order;
  Json json = {{"order", glossy.order}, {"channels", glossy.channels}, {"bounces", glossy.bounces}};
  json["matrices"] =
      appendVertices(document, glossy.matrices, ranges, static_cast<std::size_t>(n * n * glossy.channels));
  return json;
}

Json lightGroupsToJson(GltfDocument& document, const LightGroupTransfer& lights,
                       const PrimitiveRanges& ranges) {
  Json json = {{"channels", lights.channels}, {"bounces", lights.bounces}};
  json["coefficients"] = appendVertices(document, lights.coefficients, ranges,
                                        lights.groups.size() * static_cast<std::size_t>(lights.channels));
  return json;
}

Json compressedToJson(GltfDocument& document, const CompressedTransfer& transfer,
                      const PrimitiveRanges& ranges) {
  const auto components = static_cast<std::size_t>(transfer.components);
  Json json = Json::object();
  const auto add = [&](const char* name, const auto& values, std::size_t width) {
    if (!values.empty()) json[name] = appendVertices(document, values, ranges, width);
  };
  add("halves", transfer.halves, transfer.dimension());
  add("bytes", transfer.bytes, transfer.dimension());
  add("clusters", transfer.clusterOf, 1);
  add("weights", transfer.weightFloats, components);
  add("weights", transfer.weightHalves, components);
  add("weights", transfer.weightBytes, components);
  return json;
}

Json sharedCompression(GltfDocument& document, const CompressedTransfer& transfer) {
  Json json = {{"method", methodName(transfer.method)},
               {"order", transfer.order},
               {"channels", transfer.channels},
               {"bounces", transfer.bounces}};
  const auto add = [&](const char* name, const std::vector<float>& values) {
    if (!values.empty()) json[name] = append(document, values);
  };
  add("ranges", transfer.ranges);
  if (transfer.clusters > 0) {
    json["clusterCount"] = transfer.clusters;
    json["componentCount"] = transfer.components;
    if (transfer.components > 0) json["weightStorage"] = weightStorageName(transfer.weights);
  }
  add("means", transfer.means);
  add("basis", transfer.basis);
  add("weightRanges", transfer.weightRanges);
  return json;
}

}  // namespace

std::size_t storedBytes(const Bake& bake) {
  std::size_t bytes = bake.ao.size() * sizeof(float) + bake.bentNormals.size() * sizeof(glm::vec3);
  if (bake.sh) bytes += bake.sh->coefficients.size() * sizeof(float);
  if (bake.ch) bytes += bake.ch->coefficients.size() * sizeof(float);
  if (bake.haar)
    bytes += bake.haar->offsets.size() * sizeof(std::uint32_t) +
             bake.haar->indices.size() * (bake.haar->storedIndexBytes() + sizeof(float));
  if (bake.glossy) bytes += bake.glossy->matrices.size() * sizeof(float);
  if (bake.lightGroups) bytes += bake.lightGroups->coefficients.size() * sizeof(float);
  if (bake.irradiance) bytes += bake.irradiance->size() * sizeof(glm::vec3);
  return bytes;
}

Json bakeToJson(GltfDocument& document, const CompiledScene& scene, const Bake& bake,
                const PrimitiveRanges& ranges, const QuantizedOccluders* occluders) {
  Json json = Json::object();
  if (vertexCount(ranges) == 0) return json;
  if (!bake.ao.empty()) json["ao"] = appendVertices(document, bake.ao, ranges, 1);
  if (!bake.bentNormals.empty())
    json["bentNormal"] = append(document, gatherVertices(asFloats(bake.bentNormals), ranges, 3), "VEC3", 3);
  if (bake.sh) json["sh"] = harmonicToJson(document, *bake.sh, ranges);
  if (bake.compressedSh) json["shCompressed"] = compressedToJson(document, *bake.compressedSh, ranges);
  if (bake.animation) {
    json["keys"] = Json::array();
    for (const HarmonicTransfer& key : bake.animation->keys)
      json["keys"].push_back({{"sh", harmonicToJson(document, key, ranges)}});
  }
  if (bake.ch) json["ch"] = harmonicToJson(document, *bake.ch, ranges);
  if (bake.haar) json["haar"] = haarToJson(document, *bake.haar, ranges);
  if (bake.glossy) json["glossy"] = glossyToJson(document, *bake.glossy, ranges);
  if (bake.lightGroups) json["lightGroups"] = lightGroupsToJson(document, *bake.lightGroups, ranges);
  if (bake.irradiance)
    json["irradiance"] = append(document, gatherVertices(asFloats(*bake.irradiance), ranges, 3), "VEC3", 3);
  if (occluders != nullptr)
    json["vo"] = occludersToJson(document, *occluders, ranges);
  else if (bake.occluders)
    json["vo"] = occludersToJson(document, *bake.occluders, ranges);
  if (bake.texels) {
    Json texels = chartsToJson(document, *bake.texels, scene, ranges);
    if (!texels.is_null()) json["texels"] = std::move(texels);
  }
  return json;
}

void addSharedData(GltfDocument& document, const Bake& bake, const QuantizedOccluders* occluders,
                   Json& root) {
  if (bake.compressedSh) root["shCompressed"] = sharedCompression(document, *bake.compressedSh);
  if (occluders != nullptr)
    root["vo"] = occluderNames(*occluders);
  else if (bake.occluders)
    root["vo"] = occluderNames(*bake.occluders);
  if (bake.animation)
    root["animation"] = {{"index", bake.animation->animation}, {"times", bake.animation->times}};
  if (!bake.lightGroups) return;
  root["lightGroups"] = Json::array();
  for (const LightGroup& group : bake.lightGroups->groups)
    root["lightGroups"].push_back(
        {{"name", group.name}, {"color", {group.color.x, group.color.y, group.color.z}}});
}

}  // namespace prelight
