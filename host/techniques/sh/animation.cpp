#include <fmt/format.h>

#include <cmath>

#include "compress/compressed_parts.h"
#include "io/values/value_reader.h"
#include "techniques/compressed_rows.h"
#include "techniques/sh/harmonics.h"
#include "techniques/sh/sh.h"

namespace prelight {

namespace {

using Json = Technique::Json;

constexpr std::uint64_t maxKeys = 1024;

void writeMomentsEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (!output.bake.animation) return;
  entry["keys"] = Json::array();
  const std::optional<CompressedTransfer>& compressed = output.bake.compressedParts.keys;
  const std::vector<HarmonicTransfer>& keys = output.bake.animation->keys;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (compressed)
      entry["keys"].push_back({{"shCompressed", rowsToJson(output.document, *compressed,
                                                           rowsOf(ranges, k * output.scene.vertexCount()))}});
    else
      entry["keys"].push_back({{"sh", harmonicToJson(output.document, keys[k], ranges)}});
  }
}

void writeMomentsRoot(const BakedOutput& output, Json& root) {
  const auto& animation = output.bake.animation;
  if (!animation) return;
  root["animation"] = {{"index", animation->animation}, {"times", animation->times}};
  if (output.bake.compressedParts.keys)
    root["animation"]["shCompressed"] = sharedToJson(output.document, *output.bake.compressedParts.keys);
}

class MomentsReader final : public TechniqueReader {
 public:
  explicit MomentsReader(const BakedInput& input) : input_(input), values_(input.document, input.root) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    const auto json = entry.find("keys");
    if (!json) return;
    if (!bake.animation) bake.animation = readTimes(*json);
    const std::size_t count = bake.animation->times.size();
    if (json->arraySize() != count)
      json->fail(fmt::format("{} keys, but the root gives {} times", json->arraySize(), count), rebake);
    if (json->at(0).find("shCompressed"))
      readCompressed(*json, ranges, bake);
    else
      readFloats(*json, ranges);
  }

  void finish(Bake& bake) override {
    for (std::optional<HarmonicTransfer>& key : keys_) bake.animation->keys.push_back(*std::move(key));
    if (bake.compressedParts.keys) takeKeys(decompress(*bake.compressedParts.keys), *bake.animation);
  }

 private:
  void readFloats(const JsonCursor& json, const PrimitiveRanges& ranges) {
    keys_.resize(json.arraySize());
    for (std::size_t k = 0; k < keys_.size(); ++k) {
      const JsonCursor sh = json.at(k).at("sh");
      readHarmonic(values_, sh, ranges, input_.scene, keys_[k]);
      expectSame(sh,
                 keys_[k]->order == keys_[0]->order && keys_[k]->channels == keys_[0]->channels &&
                     keys_[k]->bounces == keys_[0]->bounces,
                 "order, channels and bounces (of the first key)");
    }
  }

  void readCompressed(const JsonCursor& json, const PrimitiveRanges& ranges, Bake& bake) {
    const std::size_t count = json.arraySize(), vertices = input_.scene.vertexCount();
    std::optional<CompressedTransfer>& keys = bake.compressedParts.keys;
    if (!keys) {
      keys = readShared(values_, sharedAt(input_.extension->find("animation"), "shCompressed", json));
      keys->vertexCount = static_cast<std::uint32_t>(count * vertices);
    }
    for (std::size_t k = 0; k < count; ++k)
      readRows(values_, json.at(k).at("shCompressed"), rowsOf(ranges, k * vertices), *keys);
  }

  /// The animation and the times of its keys, from the root.
  AnimatedTransfer readTimes(const JsonCursor& json) const {
    const auto root = input_.extension ? input_.extension->find("animation") : std::nullopt;
    if (!root) json.fail("the root's extension does not give the times of the keys", rebake);
    AnimatedTransfer animation;
    animation.animation = root->at("index").asIndex(input_.root.countOf("animations"), "animation");
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

  const BakedInput& input_;
  ValueReader values_;
  std::vector<std::optional<HarmonicTransfer>> keys_;
};

void summarizeMoments(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.animation) return;
  const AnimatedTransfer& transfer = *bake.animation;
  std::size_t bytes = 0;
  for (const HarmonicTransfer& key : transfer.keys) bytes += bytesOf(key.coefficients);
  if (bake.compressedParts.keys) bytes = bake.compressedParts.keys->byteCount();
  std::string times;
  for (const double time : transfer.times) times += fmt::format("{}{:g}", times.empty() ? "" : ", ", time);
  found.push_back({"animation",
                   fmt::format("{} of animation {} at {} s{}", counted(transfer.times.size(), "key"),
                               transfer.animation, times, compressionText(bake.compressedParts.keys)),
                   bytes,
                   true,
                   {{"index", transfer.animation}, {"times", transfer.times}, {"bytes", bytes}}});
}

}  // namespace

Technique animationTechnique() {
  return {.name = "animation",
          .file = {.members = {"keys"},
                   .accessors = compressedAccessors({"coefficients"}),
                   .writeEntry = writeMomentsEntry,
                   .writeRoot = writeMomentsRoot,
                   .makeReader = makeTechniqueReader<MomentsReader>},
          .summarize = summarizeMoments,
          .relighting = &animationRelighting};
}

}  // namespace prelight
