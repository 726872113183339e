#include "techniques/light_groups/light_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/values/baked_ranges.h"
#include "io/values/value_reader.h"
#include "options/rows.h"
#include "techniques/packed_values.h"
#include "techniques/receiver_cast.h"

namespace prelight {

namespace {

std::vector<PlannedPass> lightGroupsPasses(const PlanInput& input) {
  if (!input.request.lightGroups) return {{Pass::LightGroups, false, "not asked for"}};
  return {{Pass::LightGroups, true, "shadow rays from every receiver to every light"}};
}

const char* closestHitsOfSome(const BakeRequest& request) {
  return request.lightGroups ? "closest hits where a group has emitters" : nullptr;
}

void addLightGroupsToKey(const BakeRequest& request, StateHash& hash) {
  hash.value(request.lightGroups.wanted);
  hash.value(request.lightGroups.named.size());
  for (const LightGroupRequest& group : request.lightGroups.named) {
    hash.text(group.name).value(group.patterns.size());
    for (const std::string& pattern : group.patterns) hash.text(pattern);
  }
}

class LightGroupsProjector final : public Projector {
 public:
  explicit LightGroupsProjector(const BakeContext& context)
      : context_(context),
        lights_(groupLights(context.scene, context.request.lightGroups.named)),
        column_(lights_) {}

  std::string_view stage() const override { return "bounce"; }

  void addColumns(const HemisphereColumn& /*hemisphere*/, std::vector<Column*>& columns) override {
    if (!lights_.empty()) columns.push_back(&column_);
  }
  const LightColumn* carriedLight() const override { return lights_.empty() ? nullptr : &column_; }

  void run(ReceiverCast* cast, Bake& bake, Progress& progress) override {
    const SlotTransfer& transfer = cast->transfer(progress);
    // Lights of different colours in one group make its channels differ even without bounces.
    const int channels = context_.request.lightGroups.named.empty() ? transfer.channels() : 3;
    const std::size_t first = transfer.shColumns(), n = lights_.groups.size();
    bake.lightGroups = {lights_.groups, channels, transfer.bounces,
                        packRows(context_.mesh, frontValues(transfer), context_.scene, channels, n,
                                 [&](const float* row, float* out) {
                                   // Light is never negative; a fit may dip below.
                                   for (std::size_t g = 0; g < n; ++g)
                                     out[g] = std::max(0.0f, finiteOr(row[first + g], 0.0f));
                                 })};
  }

 private:
  const BakeContext& context_;
  GroupedLights lights_;
  LightColumn column_;
};

/// Throws UsageError and InputError as groupLights().
std::unique_ptr<Projector> makeLightGroupsProjector(const BakeContext& context) {
  if (!context.request.lightGroups) return nullptr;
  return std::make_unique<LightGroupsProjector>(context);
}

using Json = Technique::Json;

constexpr std::uint64_t maxGroups = 1u << 16;

std::size_t lightGroupsBytes(const Bake& bake) {
  return bake.lightGroups ? bytesOf(bake.lightGroups->coefficients) : 0;
}

std::size_t valuesOf(const LightGroupTransfer& lights) {
  return lights.groups.size() * static_cast<std::size_t>(lights.channels);
}

Json groupsToJson(const LightGroupTransfer& lights) {
  Json groups = Json::array();
  for (const LightGroup& group : lights.groups)
    groups.push_back({{"name", group.name}, {"color", {group.color.x, group.color.y, group.color.z}}});
  return groups;
}

void writeLightGroupsEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (!output.bake.lightGroups) return;
  const LightGroupTransfer& lights = *output.bake.lightGroups;
  Json json = {{"channels", lights.channels}, {"bounces", lights.bounces}};
  const std::size_t width = valuesOf(lights);
  json["coefficients"] =
      output.column("light groups", lights.coefficients, ranges, width, {.square = true, .group = width});
  entry["lightGroups"] = std::move(json);
}

void writeLightGroupsRoot(const BakedOutput& output, Json& root) {
  if (output.bake.lightGroups) root["lightGroups"] = groupsToJson(*output.bake.lightGroups);
}

class LightGroupsReader final : public TechniqueReader {
 public:
  explicit LightGroupsReader(const BakedInput& input) : input_(input), values_(input.document, input.root) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    const auto json = entry.find("lightGroups");
    if (!json) return;
    if (!bake.lightGroups)
      bake.lightGroups = {readGroups(*json), readChannels(*json), readBounces(*json), {}};
    LightGroupTransfer& lights = *bake.lightGroups;
    expectSame(*json, readChannels(*json) == lights.channels && readBounces(*json) == lights.bounces,
               "channels and bounces");
    const std::size_t width = valuesOf(lights);
    placeVertices(values_.floats(json->at("coefficients"), "SCALAR", vertexCount(ranges) * width), ranges,
                  width, input_.scene, lights.coefficients);
  }

 private:
  /// Names and colours, from the root.
  std::vector<LightGroup> readGroups(const JsonCursor& json) const {
    const auto names = input_.extension ? input_.extension->find("lightGroups") : std::nullopt;
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

  const BakedInput& input_;
  ValueReader values_;
};

void summarizeLightGroups(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.lightGroups) return;
  const LightGroupTransfer& transfer = *bake.lightGroups;
  const std::size_t bytes = bytesOf(transfer.coefficients);
  std::string names;
  for (const LightGroup& group : transfer.groups)
    names += fmt::format("{}'{}'", names.empty() ? "" : ", ", group.name);
  found.push_back({"lightGroups",
                   fmt::format("{} {}, {}", counted(transfer.groups.size(), "light group"), names,
                               channelsText(transfer.channels, transfer.bounces)),
                   bytes,
                   true,
                   {{"groups", groupsToJson(transfer)},
                    {"channels", transfer.channels},
                    {"bounces", transfer.bounces},
                    {"bytes", bytes}}});
}

void addLightGroupsArrays(const Bake& bake, std::vector<BakedArray>& arrays) {
  if (!bake.lightGroups) return;
  std::string layout = fmt::format("[vertex][channel {}][group] of", bake.lightGroups->channels);
  for (const LightGroup& group : bake.lightGroups->groups) layout += " " + group.name;
  arrays.push_back({"lightGroups", layout, {bake.lightGroups->coefficients}});
}

constexpr auto lightGroupsOptions = std::to_array<Option<BakeRequest>>({
    options::BakeRow::flag<&BakeRequest::lightGroups, &LightGroupsRequest::wanted>(
        {.field = "BakeRequest::lightGroups",
         .name = "light-groups",
         .help = "transfer of the scene's own lights, each of which can be scaled and coloured at run time"}),
    options::BakeRow::own(
        {.field = "LightGroupRequest::name",
         .name = "light-group",
         .help = "group of lights that change together: NAME=PATTERN[,PATTERN...], with patterns (* and "
                 "?) for names of lights or nodes; repeat it for more groups; every other light is a "
                 "group of its own",
         .example = "lamps=Lamp*,Bulb"}),
});

}  // namespace

Technique lightGroupsTechnique() {
  return {.name = "light_groups",
          .options = {.rows = lightGroupsOptions},
          .shading = &lightsShading,
          .use = {.lights = true},
          .plan = {.passes = lightGroupsPasses,
                   .closestHitsOfSome = closestHitsOfSome,
                   .addToKey = addLightGroupsToKey},
          .makeProjector = makeLightGroupsProjector,
          .file = {.members = {"lightGroups"},
                   .quantizable = true,
                   .accessors = {"coefficients"},
                   .storedBytes = lightGroupsBytes,
                   .writeEntry = writeLightGroupsEntry,
                   .writeRoot = writeLightGroupsRoot,
                   .makeReader = makeTechniqueReader<LightGroupsReader>},
          .summarize = summarizeLightGroups,
          .addArrays = addLightGroupsArrays,
          .relighting = &lightGroupsRelighting,
          .exports = {.relitAlone = true, .copyRelit = copyPart<&TechniqueParts::lightGroups>}};
}

}  // namespace prelight
