#include "io/baked_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/baked_sky.h"
#include "io/baked_strip.h"
#include "io/finite_results.h"
#include "io/plan_json.h"
#include "io/scene_fingerprint.h"
#include "io/values/value_reader.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"
#include "techniques/registry/registry.h"

namespace prelight {

BakeReader::BakeReader(const BakedInput& input) : input_(input) {
  for (const Technique& technique : techniques()) {
    const TechniqueFile& file = technique.file;
    if (file.everywhere) members_.insert(members_.end(), file.members.begin(), file.members.end());
    if (file.makeReader != nullptr) readers_.push_back(file.makeReader(input));
  }
}

bool BakeReader::readVertices() {
  bool any = input_.extension.has_value();
  for (const auto& [key, ranges] : groupRanges(input_.scene)) {
    const JsonCursor node = input_.root.at("nodes").at(static_cast<std::size_t>(key.first));
    const auto extension = transferExtension(node);
    any = any || extension.has_value();
    if (!any || vertexCount(ranges) == 0) continue;
    if (!extension) node.fail("no PRELIGHT_transfer on the node, other nodes have it", rebake);
    const JsonCursor primitives = extension->at("primitives");
    const auto index = static_cast<std::size_t>(key.second);
    if (index >= primitives.arraySize())
      primitives.fail(fmt::format("{} primitives, expected more than {}", primitives.arraySize(), index),
                      rebake);
    readEntry(primitives.at(index), ranges);
  }
  return any;
}

void BakeReader::readEntry(const JsonCursor& entry, const PrimitiveRanges& ranges) {
  entry.expectObject();
  const auto quantized = entry.find("quantized");
  std::vector<bool> there;
  for (const std::string_view member : members_)
    there.push_back(entry.find(member) || (quantized && quantized->find(member)));
  if (there_ && *there_ != there)
    entry.fail("expected the same techniques as on the other primitives", rebake);
  there_ = std::move(there);
  for (const auto& reader : readers_) reader->read(entry, ranges, bake_);
  if (!quantized) return;
  quantized->expectObject();
  for (const auto& reader : readers_) reader->read(*quantized, ranges, bake_);
}

Bake BakeReader::finish() {
  for (const auto& reader : readers_) reader->finish(bake_);
  return std::move(bake_);
}

std::size_t storedBytes(const Bake& bake) {
  std::size_t bytes = 0;
  for (const Technique& technique : techniques())
    if (technique.file.storedBytes != nullptr) bytes += technique.file.storedBytes(bake);
  return bytes;
}

nlohmann::ordered_json entryToJson(const BakedOutput& output, const PrimitiveRanges& ranges) {
  nlohmann::ordered_json entry = nlohmann::ordered_json::object();
  if (vertexCount(ranges) == 0) return entry;
  nlohmann::ordered_json quantized = nlohmann::ordered_json::object();
  for (const Technique& technique : techniques())
    if (technique.file.writeEntry != nullptr)
      technique.file.writeEntry(output, ranges,
                                output.quantizes() && technique.file.quantizable ? quantized : entry);
  if (!quantized.empty()) entry["quantized"] = std::move(quantized);
  return entry;
}

void addRootMembers(const BakedOutput& output, nlohmann::ordered_json& root) {
  for (const Technique& technique : techniques())
    if (technique.file.writeRoot != nullptr) technique.file.writeRoot(output, root);
}

namespace {

using Json = nlohmann::ordered_json;

/// Returns the limits that are set, m.
Json limitsToJson(const OcclusionLimits& limits) {
  Json json = Json::object();
  if (limits.nearest > 0.0) json["near"] = limits.nearest;
  if (limits.farthest > 0.0) json["far"] = limits.farthest;
  if (limits.obscurance > 0.0) json["obscurance"] = limits.obscurance;
  return json;
}

OcclusionLimits limitsFromJson(const JsonCursor& json) {
  const auto limit = [&](const char* key) {
    const double value = json.numberOr(key, 0.0);
    if (!(std::isfinite(value) && value >= 0.0))
      json.at(key).fail(fmt::format("expected metres >= 0, got {}", value));
    return value;
  };
  return {limit("near"), limit("far"), limit("obscurance")};
}

std::vector<std::string> stringsFromJson(const JsonCursor& json) {
  std::vector<std::string> strings;
  for (std::size_t i = 0; i < json.arraySize(); ++i) strings.push_back(json.at(i).asString());
  return strings;
}

Json infoToJson(const BakeInfo& info) {
  Json json = {{"version", 1},
               {"generator", info.generator},
               {"seed", info.seed},
               {"rays", info.rays},
               {"error", info.error},
               {"bounces", info.bounces},
               {"plan", toJson(info.plan)},
               {"device", info.device},
               {"seconds", info.seconds}};
  if (info.moment)
    json["moment"] = {{"animation", info.moment->animation}, {"seconds", info.moment->seconds}};
  if (!info.variant.empty()) json["variant"] = info.variant;
  if (info.refined > 0.0) json["refined"] = info.refined;
  if (info.scene >= 0) json["scene"] = info.scene;
  if (const Json limits = limitsToJson(info.limits); !limits.empty()) json["limits"] = limits;
  for (const ShadowSetRequest& set : info.shadowSets)
    json["shadowSets"].push_back({{"receivers", set.receivers}, {"occluders", set.occluders}});
  if (!info.visibility.empty()) json["visibility"] = info.visibility;
  if (info.sky) json["sky"] = toJson(*info.sky);
  return json;
}

RecordedChoice choiceFromJson(const JsonCursor& json, const JsonCursor& root) {
  const std::size_t animations = root.countOf("animations");
  RecordedChoice choice;
  choice.baked = true;
  choice.variant = json.stringOr("variant", "");
  // Scenes may have been removed since.
  if (const auto scene = json.find("scene")) choice.scene = scene->asUnsigned();
  if (const auto played = json.find("animation"))
    choice.played = played->at("index").asIndex(animations, "animation");
  const auto moment = json.find("moment");
  if (!moment) return choice;
  const double seconds = moment->at("seconds").asNumber();
  if (!(std::isfinite(seconds) && seconds >= 0.0))
    moment->at("seconds").fail(fmt::format("expected seconds >= 0, got {}", seconds));
  choice.moment = {moment->at("animation").asIndex(animations, "animation"), seconds};
  return choice;
}

BakeInfo infoFromJson(const JsonCursor& json, const JsonCursor& root) {
  BakeInfo info;
  info.generator = json.stringOr("generator", "");
  info.seed = json.unsignedOr("seed", 0);
  info.rays = json.unsignedOr("rays", 0);
  // JSON has no NaN, so that an unknown error is null.
  const auto error = json.find("error");
  info.error = error && !error->value().is_null() ? error->asNumber() : 0.0;
  info.bounces = static_cast<int>(std::min<std::uint64_t>(json.unsignedOr("bounces", 0), 1u << 20));
  if (const auto plan = json.find("plan")) info.plan = planFromJson(*plan);
  info.device = json.stringOr("device", "");
  info.seconds = json.numberOr("seconds", 0.0);
  const RecordedChoice choice = choiceFromJson(json, root);
  info.scene = choice.scene ? static_cast<int>(std::min<std::size_t>(*choice.scene, 1u << 30)) : -1;
  info.moment = choice.moment;
  info.variant = choice.variant;
  info.refined = std::max(0.0, json.numberOr("refined", 0.0));
  if (const auto limits = json.find("limits")) info.limits = limitsFromJson(*limits);
  json.forEachObject("shadowSets", [&](const JsonCursor& set, std::size_t) {
    info.shadowSets.push_back({stringsFromJson(set.at("receivers")), stringsFromJson(set.at("occluders"))});
  });
  info.visibility = json.stringOr("visibility", "");
  if (const auto sky = json.find("sky")) info.sky = bakedSkyFromJson(*sky);
  return info;
}

}  // namespace

SavingsByColumn embedBake(GltfDocument& document, const CompiledScene& scene, const Bake& bake,
                          const StoredForms* forms) {
  stripBake(document);
  const std::size_t ownAccessors = document.json.value("accessors", Json::array()).size();
  // Reserved at once, because growing step by step would copy the data repeatedly.
  const std::size_t bytes = storedBytes(bake);
  document.bin.reserve(document.bin.size() + bytes + bytes / 16);
  SavingsByColumn saved;
  const BakedOutput output{document, scene, bake, forms, &saved};
  for (const auto& [key, ranges] : groupRanges(scene)) {
    const auto node = static_cast<std::size_t>(key.first);
    Json entry = entryToJson(output, ranges);
    auto& extension = document.json["nodes"][node]["extensions"][transferExtensionName];
    extension["primitives"].push_back(std::move(entry));
  }
  useExtensionName(document.json, transferExtensionName);
  Json root = infoToJson(bake.info);
  root["fingerprint"] = fingerprintOf(document, scene, subjectOf(bake, scene.vertexCount()));
  addRootMembers(output, root);
  document.json["extensions"][transferExtensionName] = std::move(root);
  requireFiniteBake(document, ownAccessors);
  return saved;
}

RecordedChoice readRecordedChoice(const GltfDocument& document) {
  const std::string file = document.path.string();
  const JsonCursor root(file, document.json);
  const auto extension = transferExtension(root);
  return extension ? choiceFromJson(*extension, root) : RecordedChoice{};
}

Bake readQuantizedParts(const GltfDocument& document, const CompiledScene& scene) {
  const std::string file = document.path.string();
  const JsonCursor root(file, document.json);
  const BakedInput input{document, root, scene, transferExtension(root)};
  std::vector<std::unique_ptr<TechniqueReader>> readers;
  for (const Technique& technique : techniques())
    if (technique.file.quantizable) readers.push_back(technique.file.makeReader(input));
  Bake bake;
  for (const auto& [key, ranges] : groupRanges(scene)) {
    if (vertexCount(ranges) == 0) continue;
    const auto node = transferExtension(root.at("nodes").at(static_cast<std::size_t>(key.first)));
    const JsonCursor entry = node->at("primitives").at(static_cast<std::size_t>(key.second));
    if (const auto quantized = entry.find("quantized"))
      for (const auto& reader : readers) reader->read(*quantized, ranges, bake);
  }
  for (const auto& reader : readers) reader->finish(bake);
  return bake;
}

std::optional<Bake> readBake(const GltfDocument& document, const CompiledScene& scene) {
  const std::string file = document.path.string();
  const JsonCursor root(file, document.json);
  const BakedInput input{document, root, scene, transferExtension(root)};
  BakeReader reader(input);
  if (!reader.readVertices()) return std::nullopt;
  BakeInfo info;
  if (input.extension) info = infoFromJson(*input.extension, root);
  std::optional<Bake> bake = reader.finish();
  bake->info = std::move(info);
  return bake;
}

}  // namespace prelight
