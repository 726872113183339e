#include "techniques/compressed_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "compress/compressed_parts.h"
#include "io/values/baked_ranges.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t maxClusters = 1u << 16, maxComponents = 3 * 32 * 32;
constexpr std::array<std::string_view, 3> weightStorages = {"float", "half", "byte"};

template <std::size_t count>
std::size_t indexOfName(const JsonCursor& json, const std::array<std::string_view, count>& names) {
  const auto at = std::find(names.begin(), names.end(), json.asString());
  if (at == names.end())
    json.fail(fmt::format("expected one of {}, got {}", fmt::join(names, ", "), json.asString()), rebake);
  return static_cast<std::size_t>(at - names.begin());
}

std::size_t countOf(std::span<const RowRange> rows) {
  std::size_t count = 0;
  for (const RowRange& range : rows) count += range.count;
  return count;
}

/// What a row of an array looks like: its name in the file, the array and how many of its values a row has.
template <typename Transfer, typename Visit>
void forEachRowArray(Transfer& transfer, Visit visit) {
  const auto components = static_cast<std::size_t>(transfer.components);
  if (transfer.method == CompressionMethod::Half) visit("halves", transfer.halves, transfer.dimension());
  if (transfer.method == CompressionMethod::Band8 || transfer.method == CompressionMethod::Rgbe)
    visit("bytes", transfer.bytes, transfer.dimension());
  if (transfer.method == CompressionMethod::Rgbe)
    visit("exponents", transfer.exponents, static_cast<std::size_t>(transfer.order));
  if (transfer.clusters > 0 && transfer.method != CompressionMethod::Pca)
    visit("clusters", transfer.clusterOf, std::size_t{1});
  if (components == 0) return;
  if (transfer.weights == WeightStorage::Float) visit("weights", transfer.weightFloats, components);
  if (transfer.weights == WeightStorage::Half) visit("weights", transfer.weightHalves, components);
  if (transfer.weights == WeightStorage::Byte) visit("weights", transfer.weightBytes, components);
}

template <typename T>
std::vector<T> gatherRows(const std::vector<T>& values, std::span<const RowRange> rows, std::size_t width) {
  std::vector<T> gathered;
  gathered.reserve(countOf(rows) * width);
  for (const RowRange& range : rows) {
    const auto part = std::span(values).subspan(range.first * width, range.count * width);
    gathered.insert(gathered.end(), part.begin(), part.end());
  }
  return gathered;
}

template <typename T>
std::vector<T> readValues(const ValueReader& values, const JsonCursor& json, std::size_t count) {
  if constexpr (std::is_same_v<T, float>)
    return values.floats(json, "SCALAR", count);
  else
    return values.integers<T>(json, count);
}

}  // namespace

std::vector<RowRange> rowsOf(const PrimitiveRanges& ranges, std::size_t before) {
  std::vector<RowRange> rows;
  for (const PrimitiveRange& range : ranges) rows.push_back({before + range.firstVertex, range.vertexCount});
  return rows;
}

Json sharedToJson(GltfDocument& document, const CompressedTransfer& transfer) {
  Json json = {{"method", compressionMethodNames[static_cast<std::size_t>(transfer.method)]},
               {"order", transfer.order},
               {"channels", transfer.channels},
               {"bounces", transfer.bounces}};
  const auto add = [&](const char* name, const std::vector<float>& values) {
    if (!values.empty()) json[name] = appendValues(document, values);
  };
  add("ranges", transfer.ranges);
  if (transfer.clusters > 0) {
    json["clusterCount"] = transfer.clusters;
    json["componentCount"] = transfer.components;
    if (transfer.components > 0)
      json["weightStorage"] = weightStorages[static_cast<std::size_t>(transfer.weights)];
  }
  add("means", transfer.means);
  add("basis", transfer.basis);
  add("weightRanges", transfer.weightRanges);
  return json;
}

CompressedTransfer readShared(const ValueReader& values, const JsonCursor& json, int mostChannels,
                              int mostOrder) {
  CompressedTransfer transfer;
  transfer.method = static_cast<CompressionMethod>(indexOfName(json.at("method"), compressionMethodNames));
  transfer.order = readNumber(json.at("order"), 1, static_cast<std::uint64_t>(mostOrder));
  transfer.channels = mostChannels == 3
                          ? readChannels(json)
                          : readNumber(json.at("channels"), 1, static_cast<std::uint64_t>(mostChannels));
  transfer.bounces = readBounces(json);
  const auto read = [&](const char* member, std::size_t count) {
    return values.floats(json.at(member), "SCALAR", count);
  };
  if (transfer.method == CompressionMethod::Half || transfer.method == CompressionMethod::Rgbe)
    return transfer;
  if (transfer.method == CompressionMethod::Band8) {
    transfer.ranges = read("ranges", 2 * static_cast<std::size_t>(transfer.channels * transfer.order));
    return transfer;
  }
  transfer.clusters = readNumber(json.at("clusterCount"), 1, maxClusters);
  transfer.components = readNumber(json.at("componentCount"), 0, maxComponents);
  const auto clusters = static_cast<std::size_t>(transfer.clusters);
  const auto components = static_cast<std::size_t>(transfer.components);
  transfer.means = read("means", clusters * transfer.dimension());
  if (components == 0) return transfer;
  transfer.weights = static_cast<WeightStorage>(indexOfName(json.at("weightStorage"), weightStorages));
  transfer.basis = read("basis", clusters * components * transfer.dimension());
  if (transfer.weights == WeightStorage::Byte)
    transfer.weightRanges = read("weightRanges", 2 * clusters * components);
  return transfer;
}

Json rowsToJson(GltfDocument& document, const CompressedTransfer& transfer, std::span<const RowRange> rows) {
  Json json = Json::object();
  forEachRowArray(transfer, [&](const char* name, const auto& array, std::size_t width) {
    json[name] = appendValues(document, gatherRows(array, rows, width));
  });
  return json;
}

void readRows(const ValueReader& values, const JsonCursor& json, std::span<const RowRange> rows,
              CompressedTransfer& transfer) {
  forEachRowArray(transfer, [&]<typename T>(const char* name, std::vector<T>& array, std::size_t width) {
    const bool isCluster = std::string_view(name) == "clusters";
    if (isCluster && transfer.clusters == 1 && !json.find(name)) return;  // all are of the only one
    const std::vector<T> read = readValues<T>(values, json.at(name), countOf(rows) * width);
    if (isCluster)
      for (const T cluster : read)
        if (static_cast<int>(cluster) >= transfer.clusters)
          json.at(name).fail(fmt::format("cluster {} of {}", cluster, transfer.clusters), rebake);
    array.resize(transfer.vertexCount * width);
    auto from = read.begin();
    for (const RowRange& range : rows) {
      const auto length = static_cast<std::ptrdiff_t>(range.count * width);
      std::copy(from, from + length, array.begin() + static_cast<std::ptrdiff_t>(range.first * width));
      from += length;
    }
  });
}

CompressedTransfer readAllRows(const ValueReader& values, const JsonCursor& json, std::size_t count,
                               CompressedTransfer transfer) {
  transfer.vertexCount = static_cast<std::uint32_t>(count);
  const RowRange all{0, count};
  readRows(values, json, std::span(&all, 1), transfer);
  return transfer;
}

CompressedTransfer takeRows(const CompressedTransfer& transfer, std::span<const RowRange> rows) {
  CompressedTransfer taken = transfer;
  taken.vertexCount = static_cast<std::uint32_t>(countOf(rows));
  forEachRowArray(taken, [&](const char* /*name*/, auto& array, std::size_t width) {
    array = gatherRows(array, rows, width);
  });
  return taken;
}

JsonCursor sharedAt(const std::optional<JsonCursor>& extension, const char* member, const JsonCursor& json) {
  const auto shared = extension ? extension->find(member) : std::nullopt;
  if (!shared) json.fail("the root's extension does not describe the compression", rebake);
  return *shared;
}

std::vector<std::string_view> compressedAccessors(std::vector<std::string_view> others) {
  for (const char* name :
       {"halves", "bytes", "exponents", "clusters", "weights", "ranges", "means", "basis", "weightRanges"})
    others.push_back(name);
  return others;
}

std::string methodOf(const CompressedTransfer& transfer) {
  return compressionName({.method = transfer.method,
                          .clusters = transfer.clusters,
                          .components = transfer.components,
                          .weights = transfer.weights});
}

std::string compressionText(const std::optional<CompressedTransfer>& transfer) {
  return transfer ? ", as " + methodOf(*transfer) : std::string();
}

}  // namespace prelight
