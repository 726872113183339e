#include "io/bake_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "io/baked_ranges.h"
#include "io/chart_file.h"
#include "io/compression_names.h"
#include "io/occluder_file.h"
#include "io/value_reader.h"

namespace prelight {

namespace {

constexpr std::uint64_t maxOrder = 32, maxGlossyOrder = 32, maxFaceSize = 1024, maxGroups = 1u << 16,
                        maxClusters = 1u << 16, maxComponents = 3 * 32 * 32, maxKeys = 1024;

/// All primitives must tell the same of what they share; the first sets it.
void expectSame(const JsonCursor& json, bool same, const char* what) {
  if (!same) json.fail(fmt::format("expected the {} of the other primitives", what), rebake);
}

/// A sparse row on its way from file to Bake.
struct RowPlace {
  std::size_t first = 0;
  std::size_t count = 0;
};

class VertexReader {
 public:
  VertexReader(const GltfDocument& document, const JsonCursor& root, const CompiledScene& scene)
      : document_(document),
        values_(document, root),
        root_(root),
        scene_(scene),
        extension_(transferExtension(root)) {}

  void readPrimitive(const JsonCursor& json, const PrimitiveRanges& ranges) {
    json.expectObject();
    const std::array<const char*, 11> names = {"ao",   "bentNormal", "sh",        "shCompressed",
                                               "ch",   "haar",       "glossy",    "lightGroups",
                                               "keys", "vo",         "irradiance"};
    std::array<bool, 11> techniques{};
    for (std::size_t i = 0; i < names.size(); ++i) techniques[i] = json.find(names[i]).has_value();
    if (started_ && techniques != techniques_)
      json.fail("expected the same techniques as on the other primitives", rebake);
    started_ = true;
    techniques_ = techniques;
    if (const auto ao = json.find("ao"))
      scatter(values_.floats(*ao, "SCALAR", vertexCount(ranges)), ranges, 1, bake_.ao);
    if (const auto bent = json.find("bentNormal")) readBentNormals(*bent, ranges);
    if (const auto irradiance = json.find("irradiance")) readIrradiance(*irradiance, ranges);
    if (const auto sh = json.find("sh")) readHarmonic(*sh, ranges, bake_.sh);
    if (const auto ch = json.find("ch")) readHarmonic(*ch, ranges, bake_.ch);
    if (const auto haar = json.find("haar")) readHaar(*haar, ranges);
    if (const auto glossy = json.find("glossy")) readGlossy(*glossy, ranges);
    if (const auto groups = json.find("lightGroups")) readLightGroups(*groups, ranges);
    if (const auto compressed = json.find("shCompressed")) readCompressed(*compressed, ranges);
    if (const auto keys = json.find("keys")) readKeys(*keys, ranges);
    if (const auto vo = json.find("vo")) {
      if (!occluders_) occluders_.emplace(document_, root_, scene_);
      occluders_->read(*vo, ranges, extension_ ? extension_->find("vo") : std::nullopt);
    }
    if (const auto texels = json.find("texels"))
      readCharts(document_, root_, *texels, scene_, ranges, bake_.texels);
  }

  Bake finish() {
    if (bake_.haar) assembleHaar();
    if (bake_.texels) sortMaps(*bake_.texels);
    if (occluders_) bake_.occluders = occluders_->finish(scene_.vertexCount());
    for (std::optional<HarmonicTransfer>& key : keys_) bake_.animation->keys.push_back(*std::move(key));
    return std::move(bake_);
  }

 private:
  template <typename T>
  void scatter(const std::vector<T>& values, const PrimitiveRanges& ranges, std::size_t width,
               std::vector<T>& target) const {
    target.resize(width * scene_.vertexCount());
    scatterVertices(values, ranges, width, target);
  }

  std::vector<glm::vec3> readVectors(const JsonCursor& json, const PrimitiveRanges& ranges) const {
    const std::vector<float> values = values_.floats(json, "VEC3", vertexCount(ranges));
    std::vector<glm::vec3> vectors;
    for (std::size_t i = 0; i + 2 < values.size(); i += 3)
      vectors.emplace_back(values[i], values[i + 1], values[i + 2]);
    return vectors;
  }

  void readBentNormals(const JsonCursor& json, const PrimitiveRanges& ranges) {
    scatter(readVectors(json, ranges), ranges, 1, bake_.bentNormals);
  }

  void readIrradiance(const JsonCursor& json, const PrimitiveRanges& ranges) {
    const std::vector<glm::vec3> vectors = readVectors(json, ranges);
    for (const glm::vec3& e : vectors)
      if (e.x < 0.0f || e.y < 0.0f || e.z < 0.0f)
        json.fail(fmt::format("irradiance of {}, {}, {}, expected none below 0", e.x, e.y, e.z), rebake);
    if (!bake_.irradiance) bake_.irradiance.emplace();
    scatter(vectors, ranges, 1, *bake_.irradiance);
  }

  void readHarmonic(const JsonCursor& json, const PrimitiveRanges& ranges,
                    std::optional<HarmonicTransfer>& target) {
    HarmonicTransfer header;
    header.order = readNumber(json.at("order"), 1, maxOrder);
    header.channels = readChannels(json);
    header.bounces = readBounces(json);
    header.naive = json.stringOr("projection", "") == "naive";
    if (!target) target = header;
    expectSame(json,
               header.order == target->order && header.channels == target->channels &&
                   header.bounces == target->bounces && header.naive == target->naive,
               "order, channels and bounces");
    const auto width = static_cast<std::size_t>(header.order * header.order * header.channels);
    scatter(values_.floats(json.at("coefficients"), "SCALAR", vertexCount(ranges) * width), ranges, width,
            target->coefficients);
  }

  void readKeys(const JsonCursor& json, const PrimitiveRanges& ranges) {
    if (!bake_.animation) bake_.animation = readAnimation(json);
    const std::size_t count = bake_.animation->times.size();
    if (json.arraySize() != count)
      json.fail(fmt::format("{} keys, but the root gives {} times", json.arraySize(), count), rebake);
    keys_.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      const JsonCursor sh = json.at(k).at("sh");
      readHarmonic(sh, ranges, keys_[k]);
      expectSame(sh,
                 keys_[k]->order == keys_[0]->order && keys_[k]->channels == keys_[0]->channels &&
                     keys_[k]->bounces == keys_[0]->bounces,
                 "order, channels and bounces (of the first key)");
    }
  }

  /// The animation and the times of its keys, from the root.
  AnimatedTransfer readAnimation(const JsonCursor& json) const {
    const auto root = extension_ ? extension_->find("animation") : std::nullopt;
    if (!root) json.fail("the root's extension does not give the times of the keys", rebake);
    AnimatedTransfer animation;
    animation.animation = root->at("index").asIndex(root_.countOf("animations"), "animation");
    const JsonCursor times = root->at("times");
    const std::size_t count = times.arraySize();
    if (count == 0 || count > maxKeys)
      times.fail(fmt::format("expected 1..{} times, got {}", maxKeys, count), rebake);
    for (std::size_t k = 0; k < count; ++k) {
      const double time = times.at(k).asNumber();
      if (!std::isfinite(time) || time < 0.0 || (k > 0 && time <= animation.times.back()))
        times.at(k).fail(fmt::format("expected seconds >= 0 that ascend, got {}", time), rebake);
      animation.times.push_back(time);
    }
    return animation;
  }

  void readHaar(const JsonCursor& json, const PrimitiveRanges& ranges) {
    HaarTransfer header;
    header.faceSize = readNumber(json.at("faceSize"), 1, maxFaceSize);
    if (!std::has_single_bit(static_cast<unsigned>(header.faceSize)))
      json.at("faceSize").fail(fmt::format("expected a power of two, got {}", header.faceSize), rebake);
    header.channels = readChannels(json);
    header.bounces = readBounces(json);
    if (!bake_.haar) bake_.haar = header;
    expectSame(json,
               header.faceSize == bake_.haar->faceSize && header.channels == bake_.haar->channels &&
                   header.bounces == bake_.haar->bounces,
               "face size, channels and bounces");
    const auto channels = static_cast<std::size_t>(header.channels);
    const auto offsets =
        values_.integers<std::uint32_t>(json.at("offsets"), vertexCount(ranges) * channels + 1);
    const auto indices = values_.shortOrLongIntegers(json.at("indices"));
    const auto values = values_.floats(json.at("values"), "SCALAR", indices.size());
    checkRows(json, offsets, indices);
    rows_.resize(scene_.vertexCount() * channels);
    const std::size_t base = pooledIndices_.size();
    std::size_t row = 0;
    for (const PrimitiveRange& range : ranges)
      for (std::size_t r = 0; r < range.vertexCount * channels; ++r, ++row)
        rows_[range.firstVertex * channels + r] = {base + offsets[row], offsets[row + 1] - offsets[row]};
    pooledIndices_.insert(pooledIndices_.end(), indices.begin(), indices.end());
    pooledValues_.insert(pooledValues_.end(), values.begin(), values.end());
  }

  void checkRows(const JsonCursor& json, const std::vector<std::uint32_t>& offsets,
                 const std::vector<std::uint32_t>& indices) const {
    if (offsets.front() != 0 || offsets.back() > indices.size() ||
        !std::is_sorted(offsets.begin(), offsets.end()))
      json.at("offsets").fail("expected offsets that ascend from 0 to the number of indices at most", rebake);
    const auto size = static_cast<std::uint32_t>(bake_.haar->faceSize);
    for (std::size_t row = 0; row + 1 < offsets.size(); ++row)
      for (std::uint32_t i = offsets[row]; i < offsets[row + 1]; ++i)
        if (indices[i] >= 6 * size * size || (i > offsets[row] && indices[i] <= indices[i - 1]))
          json.at("indices").fail(fmt::format("index {} of row {} is {}, expected ascending indices below {}",
                                              i - offsets[row], row, indices[i], 6 * size * size),
                                  rebake);
  }

  void assembleHaar() {
    HaarTransfer& haar = *bake_.haar;
    haar.offsets = {0};
    for (const RowPlace& row : rows_) {
      haar.indices.insert(haar.indices.end(), pooledIndices_.begin() + static_cast<std::ptrdiff_t>(row.first),
                          pooledIndices_.begin() + static_cast<std::ptrdiff_t>(row.first + row.count));
      haar.values.insert(haar.values.end(), pooledValues_.begin() + static_cast<std::ptrdiff_t>(row.first),
                         pooledValues_.begin() + static_cast<std::ptrdiff_t>(row.first + row.count));
      haar.offsets.push_back(static_cast<std::uint32_t>(haar.indices.size()));
    }
  }

  void readGlossy(const JsonCursor& json, const PrimitiveRanges& ranges) {
    GlossyTransfer header;
    header.order = readNumber(json.at("order"), 1, maxGlossyOrder);
    header.channels = readChannels(json);
    header.bounces = readBounces(json);
    if (!bake_.glossy) bake_.glossy = header;
    expectSame(json,
               header.order == bake_.glossy->order && header.channels == bake_.glossy->channels &&
                   header.bounces == bake_.glossy->bounces,
               "order, channels and bounces");
    const auto n = static_cast<std::size_t>(header.order * header.order);
    const std::size_t width = n * n * static_cast<std::size_t>(header.channels);
    scatter(values_.floats(json.at("matrices"), "SCALAR", vertexCount(ranges) * width), ranges, width,
            bake_.glossy->matrices);
  }

  void readLightGroups(const JsonCursor& json, const PrimitiveRanges& ranges) {
    if (!bake_.lightGroups)
      bake_.lightGroups = {readGroupNames(json), readChannels(json), readBounces(json), {}};
    LightGroupTransfer& lights = *bake_.lightGroups;
    expectSame(json, readChannels(json) == lights.channels && readBounces(json) == lights.bounces,
               "channels and bounces");
    const std::size_t width = lights.groups.size() * static_cast<std::size_t>(lights.channels);
    scatter(values_.floats(json.at("coefficients"), "SCALAR", vertexCount(ranges) * width), ranges, width,
            lights.coefficients);
  }

  std::vector<LightGroup> readGroupNames(const JsonCursor& json) const {
    const auto names = extension_ ? extension_->find("lightGroups") : std::nullopt;
    if (!names) json.fail("the root's extension does not name the light groups", rebake);
    const std::size_t count = names->arraySize();
    if (count == 0 || count > maxGroups)
      names->fail(fmt::format("expected 1..{} light groups, got {}", maxGroups, count), rebake);
    std::vector<LightGroup> groups;
    for (std::size_t g = 0; g < count; ++g) {
      const JsonCursor group = names->at(g), color = group.at("color");
      color.expectNumbers(3);
      glm::vec3 rgb(0.0f);
      for (std::size_t c = 0; c < 3; ++c) {
        rgb[static_cast<int>(c)] = static_cast<float>(color.at(c).asNumber());
        if (!std::isfinite(rgb[static_cast<int>(c)]) || rgb[static_cast<int>(c)] < 0.0f)
          color.fail("expected numbers >= 0 that fit a 32-bit float", rebake);
      }
      groups.push_back({group.stringOr("name", ""), rgb});
    }
    return groups;
  }

  void readCompressed(const JsonCursor& json, const PrimitiveRanges& ranges) {
    if (!bake_.compressedSh) bake_.compressedSh = readCompression(json);
    CompressedTransfer& transfer = *bake_.compressedSh;
    const std::size_t vertices = vertexCount(ranges),
                      components = static_cast<std::size_t>(transfer.components);
    const auto integers = [&]<typename T>(const char* member, std::size_t width, std::vector<T>& target) {
      scatter(values_.integers<T>(json.at(member), vertices * width), ranges, width, target);
    };
    if (transfer.method == CompressionMethod::Half) integers("halves", transfer.dimension(), transfer.halves);
    if (transfer.method == CompressionMethod::Band8) integers("bytes", transfer.dimension(), transfer.bytes);
    if (transfer.clusters > 1 || (transfer.clusters == 1 && json.find("clusters"))) {
      integers("clusters", 1, transfer.clusterOf);
      for (const std::uint16_t cluster : transfer.clusterOf)
        if (cluster >= transfer.clusters)
          json.at("clusters").fail(fmt::format("cluster {} of {}", cluster, transfer.clusters), rebake);
    }
    if (components == 0) return;
    if (transfer.weights == WeightStorage::Half) integers("weights", components, transfer.weightHalves);
    if (transfer.weights == WeightStorage::Byte) integers("weights", components, transfer.weightBytes);
    if (transfer.weights == WeightStorage::Float)
      scatter(values_.floats(json.at("weights"), "SCALAR", vertices * components), ranges, components,
              transfer.weightFloats);
  }

  /// What vertices share, from the root.
  CompressedTransfer readCompression(const JsonCursor& json) const {
    const auto shared = extension_ ? extension_->find("shCompressed") : std::nullopt;
    if (!shared) json.fail("the root's extension does not describe the compression", rebake);
    CompressedTransfer transfer;
    transfer.method = static_cast<CompressionMethod>(indexOfName(shared->at("method"), compressionMethods));
    transfer.order = readNumber(shared->at("order"), 1, maxOrder);
    transfer.channels = readChannels(*shared);
    transfer.bounces = readBounces(*shared);
    transfer.vertexCount = scene_.vertexCount();
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

  template <std::size_t count>
  static std::size_t indexOfName(const JsonCursor& json, const std::array<std::string_view, count>& names) {
    const auto at = std::find(names.begin(), names.end(), json.asString());
    if (at == names.end())
      json.fail(fmt::format("expected one of {}, got {}", fmt::join(names, ", "), json.asString()), rebake);
    return static_cast<std::size_t>(at - names.begin());
  }

  const GltfDocument& document_;
  ValueReader values_;
  const JsonCursor& root_;
  const CompiledScene& scene_;
  std::optional<JsonCursor> extension_;
  Bake bake_;
  bool started_ = false;
  std::array<bool, 11> techniques_{};
  std::vector<std::optional<HarmonicTransfer>> keys_;  ///< of an animation
  std::optional<OccluderRows> occluders_;
  std::vector<RowPlace> rows_;  ///< of wavelets, [vertex * channels + channel], into the pools
  std::vector<std::uint32_t> pooledIndices_;
  std::vector<float> pooledValues_;
};

}  // namespace

std::optional<JsonCursor> transferExtension(const JsonCursor& object) {
  const auto extensions = object.find("extensions");
  return extensions ? extensions->find("PRELIGHT_transfer") : std::nullopt;
}

std::optional<Bake> readBakedVertices(const GltfDocument& document, const JsonCursor& root,
                                      const CompiledScene& scene, bool expected) {
  VertexReader reader(document, root, scene);
  bool any = expected;
  for (const auto& [key, ranges] : groupRanges(scene)) {
    const JsonCursor node = root.at("nodes").at(static_cast<std::size_t>(key.first));
    const auto extension = transferExtension(node);
    any = any || extension.has_value();
    if (!any || vertexCount(ranges) == 0) continue;
    if (!extension) node.fail("no PRELIGHT_transfer on the node, other nodes have it", rebake);
    const JsonCursor primitives = extension->at("primitives");
    const auto index = static_cast<std::size_t>(key.second);
    if (index >= primitives.arraySize())
      primitives.fail(fmt::format("{} primitives, expected more than {}", primitives.arraySize(), index),
                      rebake);
    reader.readPrimitive(primitives.at(index), ranges);
  }
  if (!any) return std::nullopt;
  return reader.finish();
}

}  // namespace prelight
