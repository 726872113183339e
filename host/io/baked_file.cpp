#include "io/baked_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "base/error.h"
#include "io/baked_strip.h"
#include "scene/accessor.h"
#include "scene/json_cursor.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;
constexpr const char* extensionName = "PRELIGHT_transfer";
constexpr int float32 = 5126;

/// The ranges of one primitive of one node, an entry an instance, in the instances' order.
using RangesOfPrimitive = std::map<std::pair<int, int>, std::vector<PrimitiveRange>>;

RangesOfPrimitive groupRanges(const CompiledScene& scene) {
  RangesOfPrimitive groups;
  for (const PrimitiveRange& range : scene.primitives) groups[{range.node, range.primitive}].push_back(range);
  for (auto& [key, ranges] : groups) {
    std::sort(ranges.begin(), ranges.end(),
              [](const auto& a, const auto& b) { return a.instance < b.instance; });
  }
  return groups;
}

std::size_t vertexCount(const std::vector<PrimitiveRange>& ranges) {
  std::size_t count = 0;
  for (const PrimitiveRange& range : ranges) count += range.vertexCount;
  return count;
}

/// `width` floats a vertex of the ranges, one after the other.
std::vector<float> gather(std::span<const float> values, const std::vector<PrimitiveRange>& ranges,
                          std::size_t width) {
  std::vector<float> gathered;
  gathered.reserve(vertexCount(ranges) * width);
  for (const PrimitiveRange& range : ranges) {
    const auto part = values.subspan(range.firstVertex * width, range.vertexCount * width);
    gathered.insert(gathered.end(), part.begin(), part.end());
  }
  return gathered;
}

std::span<const float> asFloats(const std::vector<glm::vec3>& vectors) {
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  return {reinterpret_cast<const float*>(vectors.data()), 3 * vectors.size()};
}

int appendFloats(GltfDocument& document, const std::vector<float>& values, const char* type,
                 std::size_t components) {
  return appendAccessor(document, std::as_bytes(std::span(values)), type, float32,
                        values.size() / components);
}

Json primitiveToJson(GltfDocument& document, const Bake& bake, const std::vector<PrimitiveRange>& ranges) {
  Json json = Json::object();
  if (vertexCount(ranges) == 0) return json;
  if (!bake.ao.empty()) json["ao"] = appendFloats(document, gather(bake.ao, ranges, 1), "SCALAR", 1);
  if (!bake.bentNormals.empty()) {
    json["bentNormal"] = appendFloats(document, gather(asFloats(bake.bentNormals), ranges, 3), "VEC3", 3);
  }
  if (bake.sh) {
    const auto width = static_cast<std::size_t>(bake.sh->order * bake.sh->order * bake.sh->channels);
    Json sh = {{"order", bake.sh->order}, {"channels", bake.sh->channels}, {"bounces", bake.sh->bounces}};
    sh["coefficients"] = appendFloats(document, gather(bake.sh->coefficients, ranges, width), "SCALAR", 1);
    json["sh"] = std::move(sh);
  }
  return json;
}

Json infoToJson(const BakeInfo& info) {
  return {{"version", 1},      {"generator", info.generator}, {"seed", info.seed},
          {"rays", info.rays}, {"error", info.error},         {"bounces", info.bounces},
          {"plan", info.plan}, {"device", info.device},       {"seconds", info.seconds}};
}

BakeInfo infoFromJson(const JsonCursor& json) {
  BakeInfo info;
  info.generator = json.stringOr("generator", "");
  info.seed = json.unsignedOr("seed", 0);
  info.rays = json.unsignedOr("rays", 0);
  // JSON has no NaN: an unknown error is null.
  const auto error = json.find("error");
  info.error = error && !error->value().is_null() ? error->asNumber() : 0.0;
  info.bounces = static_cast<int>(std::min<std::uint64_t>(json.unsignedOr("bounces", 0), 1u << 20));
  if (const auto plan = json.find("plan")) info.plan = plan->value();
  info.device = json.stringOr("device", "");
  info.seconds = json.numberOr("seconds", 0.0);
  return info;
}

/// Fills the flat arrays of a Bake from the accessors of its primitives.
class BakeReader {
 public:
  BakeReader(const GltfDocument& document, const CompiledScene& scene)
      : document_(document), file_(document.path.string()), root_(file_, document.json), scene_(scene) {}

  std::optional<Bake> read() {
    const auto rootExtension = extensionOf(root_);
    if (rootExtension) bake_.info = infoFromJson(*rootExtension);
    bool any = rootExtension.has_value();
    for (const auto& [key, ranges] : groupRanges(scene_)) {
      const JsonCursor node = root_.at("nodes").at(static_cast<std::size_t>(key.first));
      const auto extension = extensionOf(node);
      any = any || extension.has_value();
      if (!any || vertexCount(ranges) == 0) continue;
      if (!extension) node.fail("no PRELIGHT_transfer on the node, other nodes have it", rebake);
      const JsonCursor primitives = extension->at("primitives");
      const auto index = static_cast<std::size_t>(key.second);
      if (index >= primitives.arraySize()) {
        primitives.fail(fmt::format("{} primitives, expected more than {}", primitives.arraySize(), index),
                        rebake);
      }
      readPrimitive(primitives.at(index), ranges);
    }
    if (!any) return std::nullopt;
    return std::move(bake_);
  }

 private:
  static constexpr const char* rebake = "bake the scene again";

  static std::optional<JsonCursor> extensionOf(const JsonCursor& object) {
    const auto extensions = object.find("extensions");
    return extensions ? extensions->find(extensionName) : std::nullopt;
  }

  void readPrimitive(const JsonCursor& json, const std::vector<PrimitiveRange>& ranges) {
    json.expectObject();
    const auto ao = json.find("ao");
    const auto bentNormal = json.find("bentNormal");
    const auto sh = json.find("sh");
    const std::array<bool, 3> techniques = {ao.has_value(), bentNormal.has_value(), sh.has_value()};
    if (first_ && techniques != techniques_) {
      json.fail("expected the same techniques as on the other primitives", rebake);
    }
    if (!first_) startArrays(techniques, sh);
    if (ao) scatter(*ao, ranges, "SCALAR", 1, bake_.ao);
    if (bentNormal) scatterVectors(*bentNormal, ranges);
    if (sh) readSh(*sh, ranges);
  }

  void startArrays(const std::array<bool, 3>& techniques, const std::optional<JsonCursor>& sh) {
    first_ = true;
    techniques_ = techniques;
    if (techniques[1]) bake_.bentNormals.resize(scene_.vertexCount());
    if (sh) bake_.sh = readShHeader(*sh);
  }

  static HarmonicTransfer readShHeader(const JsonCursor& json) {
    constexpr std::uint64_t maxOrder = 32;
    HarmonicTransfer sh;
    const std::uint64_t order = json.at("order").asUnsigned();
    if (order < 1 || order > maxOrder) {
      json.at("order").fail(fmt::format("expected 1..{}, got {}", maxOrder, order), rebake);
    }
    const std::uint64_t channels = json.at("channels").asUnsigned();
    if (channels != 1 && channels != 3) {
      json.at("channels").fail(fmt::format("expected 1 or 3, got {}", channels), rebake);
    }
    sh.order = static_cast<int>(order);
    sh.channels = static_cast<int>(channels);
    sh.bounces = static_cast<int>(std::min<std::uint64_t>(json.unsignedOr("bounces", 0), 1u << 20));
    return sh;
  }

  void readSh(const JsonCursor& json, const std::vector<PrimitiveRange>& ranges) {
    const HarmonicTransfer header = readShHeader(json);
    HarmonicTransfer& sh = *bake_.sh;
    if (header.order != sh.order || header.channels != sh.channels || header.bounces != sh.bounces) {
      json.fail("expected the order, channels and bounces of the other primitives", rebake);
    }
    const auto width = static_cast<std::size_t>(sh.order * sh.order * sh.channels);
    scatter(json.at("coefficients"), ranges, "SCALAR", width, sh.coefficients);
  }

  std::vector<float> readFloats(const JsonCursor& reference, const char* type, std::size_t count) const {
    const AccessorReader reader(document_, reference.asIndex(root_.countOf("accessors"), "accessor"));
    if (reader.type() != type || reader.componentType() != float32) {
      reference.fail(fmt::format("expected an accessor of type {} and component type {}, got {} and {}", type,
                                 float32, reader.type(), reader.componentType()),
                     rebake);
    }
    if (reader.count() != count) {
      reference.fail(fmt::format("expected {} values, got {}", count, reader.count()), rebake);
    }
    std::vector<float> values = reader.floats();
    const auto bad = std::find_if(values.begin(), values.end(), [](float v) { return !std::isfinite(v); });
    if (bad != values.end()) {
      reference.fail(fmt::format("value {} is {}, expected finite numbers", bad - values.begin(), *bad),
                     rebake);
    }
    return values;
  }

  /// `width` scalars a vertex.
  void scatter(const JsonCursor& reference, const std::vector<PrimitiveRange>& ranges, const char* type,
               std::size_t width, std::vector<float>& target) const {
    const std::vector<float> values = readFloats(reference, type, vertexCount(ranges) * width);
    target.resize(width * scene_.vertexCount());
    auto from = values.begin();
    for (const PrimitiveRange& range : ranges) {
      const auto length = static_cast<std::ptrdiff_t>(range.vertexCount * width);
      std::copy(from, from + length, target.begin() + static_cast<std::ptrdiff_t>(range.firstVertex * width));
      from += length;
    }
  }

  void scatterVectors(const JsonCursor& reference, const std::vector<PrimitiveRange>& ranges) {
    const std::vector<float> values = readFloats(reference, "VEC3", vertexCount(ranges));
    std::size_t i = 0;
    for (const PrimitiveRange& range : ranges) {
      for (std::uint32_t v = 0; v < range.vertexCount; ++v, i += 3) {
        bake_.bentNormals[range.firstVertex + v] = {values[i], values[i + 1], values[i + 2]};
      }
    }
  }

  const GltfDocument& document_;
  std::string file_;
  JsonCursor root_;
  const CompiledScene& scene_;
  Bake bake_;
  bool first_ = false;
  std::array<bool, 3> techniques_{};
};

}  // namespace

void embedBake(GltfDocument& document, const CompiledScene& scene, const Bake& bake) {
  stripBake(document);
  for (const auto& [key, ranges] : groupRanges(scene)) {
    const auto node = static_cast<std::size_t>(key.first);
    Json primitive = primitiveToJson(document, bake, ranges);
    auto& extension = document.json["nodes"][node]["extensions"][extensionName];
    extension["primitives"].push_back(std::move(primitive));
  }
  auto& used = document.json["extensionsUsed"];
  if (std::find(used.begin(), used.end(), extensionName) == used.end()) used.push_back(extensionName);
  document.json["extensions"][extensionName] = infoToJson(bake.info);
}

std::optional<Bake> readBake(const GltfDocument& document, const CompiledScene& scene) {
  return BakeReader(document, scene).read();
}

}  // namespace prelight
