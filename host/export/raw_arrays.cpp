#include "export/raw_arrays.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <span>
#include <string>

#include "compress/compressed_parts.h"

namespace prelight {

void RawArrays::add(const std::string& name, std::span<const float> values,
                    const std::vector<std::size_t>& shape, const std::string& axes,
                    const std::string& meaning) {
  static_assert(std::endian::native == std::endian::little);
  append(name, "float32", std::as_bytes(values), shape, axes, meaning);
}

void RawArrays::add(const std::string& name, std::span<const std::uint8_t> values,
                    const std::vector<std::size_t>& shape, const std::string& axes,
                    const std::string& meaning) {
  append(name, "uint8", std::as_bytes(values), shape, axes, meaning);
}

void RawArrays::add(const std::string& name, std::span<const std::uint32_t> values,
                    const std::vector<std::size_t>& shape, const std::string& axes,
                    const std::string& meaning) {
  append(name, "uint32", std::as_bytes(values), shape, axes, meaning);
}

void RawArrays::add(const std::string& name, std::span<const std::uint16_t> values,
                    const std::vector<std::size_t>& shape, const std::string& axes,
                    const std::string& meaning) {
  append(name, "uint16", std::as_bytes(values), shape, axes, meaning);
}

void RawArrays::addHalves(const std::string& name, std::span<const std::uint16_t> values,
                          const std::vector<std::size_t>& shape, const std::string& axes,
                          const std::string& meaning) {
  append(name, "float16", std::as_bytes(values), shape, axes, meaning);
}

void RawArrays::append(const std::string& name, const char* type, std::span<const std::byte> bytes,
                       const std::vector<std::size_t>& shape, const std::string& axes,
                       const std::string& meaning) {
  bytes_.resize((bytes_.size() + 3) / 4 * 4, 0);
  json_[name] = {
      {"byteOffset", bytes_.size()}, {"type", type}, {"shape", shape}, {"axes", axes}, {"meaning", meaning}};
  std::transform(bytes.begin(), bytes.end(), std::back_inserter(bytes_),
                 [](std::byte value) { return static_cast<std::uint8_t>(value); });
}

namespace {

using Json = nlohmann::ordered_json;

const char* formulaOf(CompressionMethod method) {
  switch (method) {
    case CompressionMethod::Half:
      return "T = halves";
    case CompressionMethod::Band8:
      return "T = ranges[channel][l][0] + ranges[channel][l][1] x bytes, l the band of the function";
    case CompressionMethod::Rgbe:
      return "T = (bytes - 128) / 128 x 2^(exponents[vertex][l] - 128), l the band; 0 for the exponent 0";
    default:
      return "T = means[k] + sum_j weight[j] x basis[k][j], k = clusters[vertex]; weights of bytes are "
             "weightRanges[k][j][0] + weightRanges[k][j][1] x weights[vertex][j]";
  }
}

void addWeights(const CompressedTransfer& sh, RawArrays& arrays) {
  const std::size_t vertices = sh.vertexCount, clusters = static_cast<std::size_t>(sh.clusters),
                    components = static_cast<std::size_t>(sh.components);
  if (components == 0) return;
  const std::string name = "shCompressed.weights", axes = "vertex, component";
  const std::vector<std::size_t> shape = {vertices, components};
  if (sh.weights == WeightStorage::Float) arrays.add(name, sh.weightFloats, shape, axes, "");
  if (sh.weights == WeightStorage::Half) arrays.addHalves(name, sh.weightHalves, shape, axes, "");
  if (sh.weights != WeightStorage::Byte) return;
  arrays.add(name, sh.weightBytes, shape, axes, "in steps of weightRanges");
  arrays.add("shCompressed.weightRanges", sh.weightRanges, {clusters, components, 2},
             "cluster, component, offset scale", "");
}

}  // namespace

Json addRawWavelets(const HaarTransfer& haar, RawArrays& arrays) {
  arrays.add("haar.offsets", haar.offsets, {haar.offsets.size()}, "row",
             "where the coefficients of row vertex x channels + channel begin, and the end");
  arrays.add("haar.indices", haar.indices, {haar.indices.size()}, "coefficient",
             "its place in the cube map, face S S + row S + column");
  arrays.add("haar.values", haar.values, {haar.values.size()}, "coefficient",
             "T: exit radiance is albedo x sum L_i T_i of the transformed radiance L of a sky's texels");
  return {
      {"faceSize", haar.faceSize},
      {"channels", haar.channels},
      {"bounces", haar.bounces},
      {"cube",
       "faces +X -X +Y -Y +Z -Z; with a = 2u - 1, b = 2v - 1, u along columns, v along rows, they look "
       "along (1, -b, -a), (-1, -b, a), (a, 1, b), (a, -1, -b), (a, -b, 1), (-a, -b, -1)"},
      {"transform",
       "of each face in place, for h = 1, 2 .. S/2: of p q / s t at (r, c), (r, c+h), (r+h, c), (r+h, c+h) "
       "stay (p+q+s+t)/2, (p-q+s-t)/2, (p+q-s-t)/2, (p-q-s+t)/2 at the same places"}};
}

Json addRawOccluders(const OccluderTransfer& occluders, RawArrays& arrays) {
  const std::size_t records = occluders.recordCount(), stored = occluders.stored.size();
  arrays.add("vo.offsets", occluders.offsets, {occluders.offsets.size()}, "vertex",
             "where its records begin, and the end");
  arrays.add("vo.occluders", occluders.occluders, {records}, "record", "into `occluders` of the description");
  const std::span<const float> vectors(records == 0 ? nullptr : &occluders.vectors[0].x,
                                       4 * records * stored);
  arrays.add("vo.vectors", vectors, {records, stored, 4}, "record, vector, x y z w", "those of `stored`");
  Json names = Json::array();
  for (const OccluderVector vector : occluders.stored)
    names.push_back(occluderVectorNames[static_cast<std::size_t>(vector)]);
  return {{"occluders", occluders.names},
          {"stored", names},
          {"meaning",
           "position: mean of the part that is seen, world space, and its mean distance, m; occlusion: sum "
           "of directions weighted by the form factor, and the form factor, whose sum over occluders is the "
           "hidden part of a cosine-weighted sky; others: as in Prelight's docs/file-format.md"}};
}

Json addRawCompressed(const CompressedTransfer& sh, RawArrays& arrays) {
  const std::size_t vertices = sh.vertexCount, channels = static_cast<std::size_t>(sh.channels),
                    order = static_cast<std::size_t>(sh.order), columns = order * order;
  const std::string axes = "vertex, channel, function";
  if (!sh.halves.empty())
    arrays.addHalves("shCompressed.halves", sh.halves, {vertices, channels, columns}, axes, "");
  if (!sh.bytes.empty()) arrays.add("shCompressed.bytes", sh.bytes, {vertices, channels, columns}, axes, "");
  if (!sh.exponents.empty())
    arrays.add("shCompressed.exponents", sh.exponents, {vertices, order}, "vertex, band", "");
  if (!sh.ranges.empty())
    arrays.add("shCompressed.ranges", sh.ranges, {channels, order, 2}, "channel, band, offset scale", "");
  const auto clusters = static_cast<std::size_t>(sh.clusters);
  if (!sh.means.empty())
    arrays.add("shCompressed.means", sh.means, {clusters, channels, columns}, "cluster, channel, function",
               "");
  if (!sh.basis.empty())
    arrays.add("shCompressed.basis", sh.basis,
               {clusters, static_cast<std::size_t>(sh.components), channels, columns},
               "cluster, component, channel, function", "");
  if (!sh.clusterOf.empty())
    arrays.add("shCompressed.clusters", sh.clusterOf, {vertices}, "vertex", "without them, all are 0");
  addWeights(sh, arrays);
  return {{"method", compressionMethodNames[static_cast<std::size_t>(sh.method)]},
          {"order", sh.order},
          {"channels", sh.channels},
          {"bounces", sh.bounces},
          {"transfer", formulaOf(sh.method)}};
}

namespace {

void addTransfer(const std::optional<HarmonicTransfer>& transfer, const char* name, std::size_t vertices,
                 RawArrays& arrays) {
  if (!transfer) return;
  const auto channels = static_cast<std::size_t>(transfer->channels);
  const auto columns = static_cast<std::size_t>(transfer->order * transfer->order);
  arrays.add(name, transfer->coefficients, {vertices, channels, columns}, "vertex, channel, function",
             "T: exit radiance is albedo x sum L_i T_i of a far light's coefficients L");
}

}  // namespace

nlohmann::ordered_json addRawVertices(const CompiledScene& scene, const Bake& bake, RawArrays& arrays) {
  const std::size_t vertices = scene.vertexCount();
  if (!bake.ao.empty())
    arrays.add("ao", bake.ao, {vertices}, "vertex", "cosine-weighted accessibility, 1 = open");
  if (!bake.bentNormals.empty())
    arrays.add("bentNormal", std::span(&bake.bentNormals[0].x, 3 * vertices), {vertices, 3},
               "vertex, coordinate", "unit, world space");
  if (bake.irradiance)
    arrays.add("irradiance", std::span(&(*bake.irradiance)[0].x, 3 * vertices), {vertices, 3},
               "vertex, channel", "of the scene's own lights, W/m2");
  addTransfer(bake.sh, "sh", vertices, arrays);
  addTransfer(bake.ch, "ch", vertices, arrays);
  nlohmann::ordered_json primitives = nlohmann::ordered_json::array();
  for (const PrimitiveRange& range : scene.primitives)
    primitives.push_back({{"node", range.node},
                          {"primitive", range.primitive},
                          {"instance", range.instance},
                          {"firstVertex", range.firstVertex},
                          {"vertexCount", range.vertexCount}});
  nlohmann::ordered_json description = {
      {"version", 1},
      {"contents",
       "baked data of the vertices, in the order of the file's own vertices, primitive after primitive"},
      {"primitives", primitives}};
  if (bake.haar) description["haar"] = addRawWavelets(*bake.haar, arrays);
  if (bake.occluders) description["vo"] = addRawOccluders(*bake.occluders, arrays);
  if (bake.compressedSh) description["shCompressed"] = addRawCompressed(*bake.compressedSh, arrays);
  return description;
}

}  // namespace prelight
