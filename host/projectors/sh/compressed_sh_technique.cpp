#include <fmt/format.h>

#include <algorithm>

#include "io/values/append_values.h"
#include "io/values/vertex_values.h"
#include "projectors/sh/compression_names.h"
#include "projectors/sh/harmonic_file.h"
#include "projectors/sh/sh_technique.h"
#include "projectors/summary_text.h"

namespace prelight {

namespace {

using Json = Technique::Json;

constexpr std::uint64_t maxClusters = 1u << 16, maxComponents = 3 * 32 * 32;

void writeCompressedEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (!output.bake.compressedSh) return;
  const CompressedTransfer& transfer = *output.bake.compressedSh;
  const auto components = static_cast<std::size_t>(transfer.components);
  Json json = Json::object();
  const auto add = [&](const char* name, const auto& values, std::size_t width) {
    if (!values.empty()) json[name] = appendVertices(output.document, values, ranges, width);
  };
  add("halves", transfer.halves, transfer.dimension());
  add("bytes", transfer.bytes, transfer.dimension());
  add("clusters", transfer.clusterOf, 1);
  add("weights", transfer.weightFloats, components);
  add("weights", transfer.weightHalves, components);
  add("weights", transfer.weightBytes, components);
  entry["shCompressed"] = std::move(json);
}

void writeCompressedRoot(const BakedOutput& output, Json& root) {
  if (!output.bake.compressedSh) return;
  const CompressedTransfer& transfer = *output.bake.compressedSh;
  Json json = {{"method", methodName(transfer.method)},
               {"order", transfer.order},
               {"channels", transfer.channels},
               {"bounces", transfer.bounces}};
  const auto add = [&](const char* name, const std::vector<float>& values) {
    if (!values.empty()) json[name] = appendValues(output.document, values);
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
  root["shCompressed"] = std::move(json);
}

template <std::size_t count>
std::size_t indexOfName(const JsonCursor& json, const std::array<std::string_view, count>& names) {
  const auto at = std::find(names.begin(), names.end(), json.asString());
  if (at == names.end())
    json.fail(fmt::format("expected one of {}, got {}", fmt::join(names, ", "), json.asString()), rebake);
  return static_cast<std::size_t>(at - names.begin());
}

class CompressedReader final : public TechniqueReader {
 public:
  explicit CompressedReader(const BakedInput& input) : input_(input), values_(input.document, input.root) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    const auto json = entry.find("shCompressed");
    if (!json) return;
    if (!bake.compressedSh) bake.compressedSh = readShared(*json);
    CompressedTransfer& transfer = *bake.compressedSh;
    const std::size_t vertices = vertexCount(ranges),
                      components = static_cast<std::size_t>(transfer.components);
    const auto integers = [&]<typename T>(const char* member, std::size_t width, std::vector<T>& target) {
      placeVertices(values_.integers<T>(json->at(member), vertices * width), ranges, width, input_.scene,
                    target);
    };
    if (transfer.method == CompressionMethod::Half) integers("halves", transfer.dimension(), transfer.halves);
    if (transfer.method == CompressionMethod::Band8) integers("bytes", transfer.dimension(), transfer.bytes);
    if (transfer.clusters > 1 || (transfer.clusters == 1 && json->find("clusters"))) {
      integers("clusters", 1, transfer.clusterOf);
      for (const std::uint16_t cluster : transfer.clusterOf)
        if (cluster >= transfer.clusters)
          json->at("clusters").fail(fmt::format("cluster {} of {}", cluster, transfer.clusters), rebake);
    }
    if (components == 0) return;
    if (transfer.weights == WeightStorage::Half) integers("weights", components, transfer.weightHalves);
    if (transfer.weights == WeightStorage::Byte) integers("weights", components, transfer.weightBytes);
    if (transfer.weights == WeightStorage::Float)
      placeVertices(values_.floats(json->at("weights"), "SCALAR", vertices * components), ranges, components,
                    input_.scene, transfer.weightFloats);
  }

 private:
  /// What vertices share, from the root.
  CompressedTransfer readShared(const JsonCursor& json) const {
    const auto shared = input_.extension ? input_.extension->find("shCompressed") : std::nullopt;
    if (!shared) json.fail("the root's extension does not describe the compression", rebake);
    CompressedTransfer transfer;
    transfer.method = static_cast<CompressionMethod>(indexOfName(shared->at("method"), compressionMethods));
    transfer.order = readNumber(shared->at("order"), 1, maxStoredOrder);
    transfer.channels = readChannels(*shared);
    transfer.bounces = readBounces(*shared);
    transfer.vertexCount = input_.scene.vertexCount();
    const auto read = [&](const char* member, std::size_t count) {
      return values_.floats(shared->at(member), "SCALAR", count);
    };
    if (transfer.method == CompressionMethod::Half) return transfer;
    if (transfer.method == CompressionMethod::Band8) {
      transfer.ranges = read("ranges", 2 * static_cast<std::size_t>(transfer.channels * transfer.order));
      return transfer;
    }
    transfer.clusters = readNumber(shared->at("clusterCount"), 1, maxClusters);
    transfer.components = readNumber(shared->at("componentCount"), 0, maxComponents);
    const auto clusters = static_cast<std::size_t>(transfer.clusters);
    const auto components = static_cast<std::size_t>(transfer.components);
    transfer.means = read("means", clusters * transfer.dimension());
    if (components == 0) return transfer;
    transfer.weights = static_cast<WeightStorage>(indexOfName(shared->at("weightStorage"), weightStorages));
    transfer.basis = read("basis", clusters * components * transfer.dimension());
    if (transfer.weights == WeightStorage::Byte)
      transfer.weightRanges = read("weightRanges", 2 * clusters * components);
    return transfer;
  }

  const BakedInput& input_;
  ValueReader values_;
};

void summarizeCompressed(const Bake& bake, std::size_t vertices, std::vector<BakedSummary>& found) {
  if (!bake.compressedSh) return;
  const CompressedTransfer& transfer = *bake.compressedSh;
  const std::string method = compressionName({.method = transfer.method,
                                              .clusters = transfer.clusters,
                                              .components = transfer.components,
                                              .weights = transfer.weights});
  const std::size_t bytes = transfer.byteCount();
  found.push_back({"shCompressed",
                   fmt::format("SH of order {} as {}, {}", transfer.order, method,
                               channelsText(transfer.channels, transfer.bounces)),
                   bytes,
                   true,
                   {{"method", method},
                    {"order", transfer.order},
                    {"channels", transfer.channels},
                    {"bounces", transfer.bounces},
                    {"bytes", bytes},
                    {"bytesPerVertex",
                     vertices == 0 ? 0.0 : static_cast<double>(bytes) / static_cast<double>(vertices)}}});
}

}  // namespace

Technique compressedShTechnique() {
  return {.name = "compressed_sh",
          .members = {"shCompressed"},
          .accessors = {"halves", "bytes", "clusters", "weights", "ranges", "means", "basis", "weightRanges"},
          .writeEntry = writeCompressedEntry,
          .writeRoot = writeCompressedRoot,
          .makeReader = makeTechniqueReader<CompressedReader>,
          .summarize = summarizeCompressed};
}

}  // namespace prelight
