#include "techniques/near_lamps/near_lamps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/parallel.h"
#include "compress/small_floats.h"
#include "io/values/baked_ranges.h"
#include "io/values/value_reader.h"
#include "options/rows.h"
#include "plan/cast_orders.h"
#include "scene/light_sources.h"
#include "techniques/near_lamps/lamp_shells.h"
#include "techniques/near_lamps/shell_column.h"
#include "techniques/packed_values.h"
#include "techniques/receiver_cast.h"

namespace prelight {

namespace {

int shellCount(const BakeRequest& request) { return request.nearLamps.shells.value_or(0); }

void chooseShells(const CompiledScene& scene, BakeRequest& request) {
  if (request.nearLamps.shells) return;
  const bool traced = request.visibility == Visibility::Rays;  // drawn views know no distances
  const bool useful = traced && nearLampOrder(request) > 0 && !lampsWithin(scene).empty();
  request.nearLamps.shells = useful ? BakeRequest::usualShells : 0;
}

/// Bytes that a file holds of them.
std::uint64_t fileBytes(const PlanInput& input) {
  const auto order = static_cast<std::uint64_t>(nearLampOrder(input.request));
  return sizeof(std::uint16_t) * input.scene.vertexCount() * order * order *
         static_cast<std::uint64_t>(shellCount(input.request));
}

PlannedPass planNearLamps(const PlanInput& input) {
  const int shells = shellCount(input.request), order = nearLampOrder(input.request);
  if (order == 0)
    return {Pass::NearLamps, false,
            "they use the rays of transfer that distant lights come through, and none is asked for"};
  const std::string within = lampsWithin(input.scene);
  if (shells == 0)
    return {Pass::NearLamps, false,
            "not asked for (NearLampsRequest::shells): no shadows of " + within + " within the scene"};
  const glm::vec3 extent = input.scene.boundsMax - input.scene.boundsMin;
  if (std::min({extent.x, extent.y, extent.z}) <= 0.0f)
    return {Pass::NearLamps, false,
            "the scene is flat: no lamp within its bounds has anything in front of it"};
  const ShellRange range = shellRange(input.scene, input.request.nearLamps);
  return {
      Pass::NearLamps, true,
      fmt::format("{} shells of distance from {:.3g} to {:.3g} m, order {}, {:.1f} MiB in the file, without "
                  "further rays{}",
                  shells, range.nearest, range.farthest, order, double(fileBytes(input)) / (1 << 20),
                  within.empty() ? "" : ", for " + within + " within the scene")};
}

void checkShells(const NearLampsRequest& request) {
  if (!(std::isfinite(request.farthest) && request.farthest >= 0.0))
    throw UsageError("near lamps: farthest",
                     fmt::format("got {}, expected a distance in metres, or 0", request.farthest));
  if (request.order < 0 || request.order > BakeRequest::maxShOrder)
    throw UsageError("near lamps: order",
                     fmt::format("got {}, expected 0 to {}", request.order, BakeRequest::maxShOrder));
}

std::vector<PlannedPass> nearLampsPasses(const PlanInput& input) {
  checkShells(input.request.nearLamps);
  const bool concerned = nearLampOrder(input.request) > 0 && !lampsWithin(input.scene).empty();
  if (shellCount(input.request) == 0 && !concerned) return {};
  return {planNearLamps(input)};
}

/// Sums of the fit, its solution, and what is stored of it.
void addNearLampsMemory(const PlanInput& input, Plan& plan) {
  if (!plan.runs(Pass::NearLamps)) return;
  const auto order = static_cast<std::uint64_t>(nearLampOrder(input.request));
  const auto values = order * order * static_cast<std::uint64_t>(shellCount(input.request));
  plan.hostBytes += input.scene.vertexCount() * values * (4 + 4 + 2) + 24ull * input.scene.triangleCount();
}

const char* nearLampsHits(const BakeRequest& request) {
  return shellCount(request) > 0 && nearLampOrder(request) > 0
             ? "closest hits, because near lamps need to know how far it is to what was hit"
             : nullptr;
}

void addNearLampsToKey(const BakeRequest& request, StateHash& hash) {
  if (shellCount(request) > 0)
    hash.value(shellCount(request)).value(request.nearLamps.farthest).value(request.nearLamps.order);
}

constexpr std::size_t lampGrain = 1024;  // vertices that a thread takes at once

class NearLampsProjector final : public Projector {
 public:
  explicit NearLampsProjector(const BakeContext& context) : context_(context) {
    const ShellRange range = shellRange(context.scene, context.request.nearLamps);
    transfer_.order = nearLampOrder(context.request);
    transfer_.shells = shellCount(context.request);
    transfer_.nearest = range.nearest;
    transfer_.farthest = range.farthest;
  }

  std::string_view stage() const override { return "near lamps"; }

  void addColumns(const HemisphereColumn& /*hemisphere*/, std::vector<Column*>& columns) override {
    ShellShape shape{transfer_.order, {}};
    for (int shell = 1; shell < transfer_.shells; ++shell)
      shape.starts.push_back(static_cast<float>(shellStart(transfer_, shell)));
    columns.push_back(&shells_.emplace(std::move(shape)));
  }

  void run(ReceiverCast* cast, Bake& bake, Progress& progress) override {
    const std::vector<float> fitted = shells_->solve(cast->front(), progress);
    const std::size_t width = transfer_.columns() * static_cast<std::size_t>(transfer_.shells);
    transfer_.halves.resize(context_.scene.vertexCount() * width);
    parallelRanges(context_.scene.vertexCount(), lampGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v)
        for (std::size_t i = 0; i < width; ++i)
          transfer_.halves[v * width + i] =
              toHalf(finiteOr(fitted[context_.mesh.slotOfVertex[v] * width + i], 0.0f));
    });
    bake.nearLamps = transfer_;
  }

 private:
  const BakeContext& context_;
  NearLampTransfer transfer_;
  std::optional<ShellColumn> shells_;
};

std::unique_ptr<Projector> makeNearLampsProjector(const BakeContext& context) {
  if (!context.plan.runs(Pass::NearLamps)) return nullptr;
  return std::make_unique<NearLampsProjector>(context);
}

using Json = Technique::Json;

std::size_t widthOf(const NearLampTransfer& transfer) {
  return transfer.columns() * static_cast<std::size_t>(transfer.shells);
}

std::size_t nearLampsBytes(const Bake& bake) {
  const std::size_t keys = bake.animation ? bake.animation->nearLamps.size() : 0;
  return bake.nearLamps ? (1 + keys) * bytesOf(bake.nearLamps->halves) : 0;
}

/// Returns halves of a primitive's vertices, or bytes with a scale per vertex and shell.
Json halvesToJson(const BakedOutput& output, const NearLampTransfer& transfer,
                  const PrimitiveRanges& ranges) {
  const auto halves = gatherVertices(std::span(transfer.halves), ranges, widthOf(transfer));
  if (!output.quantizes()) return appendValues(output.document, halves);
  std::vector<float> numbers(halves.size());
  std::ranges::transform(halves, numbers.begin(), fromHalf);
  ColumnSavings& saved = (*output.saved)["near lamps"];
  Json json =
      appendQuantized(output.document, numbers, {.group = transfer.columns()}, "SCALAR", 1, {}, saved);
  saved.plainBytes -= halves.size() * sizeof(std::uint16_t);  // they would be halves, not floats
  return json;
}

void writeNearLampsEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (!output.bake.nearLamps) return;
  const NearLampTransfer& transfer = *output.bake.nearLamps;
  entry["nearLamps"] = {{"order", transfer.order},
                        {"shells", transfer.shells},
                        {"nearest", transfer.nearest},
                        {"farthest", transfer.farthest},
                        {"halves", halvesToJson(output, transfer, ranges)}};
  if (!output.bake.animation) return;
  for (const NearLampTransfer& key : output.bake.animation->nearLamps)
    entry["nearLamps"]["keys"].push_back({{"halves", halvesToJson(output, key, ranges)}});
}

class NearLampsReader final : public TechniqueReader {
 public:
  explicit NearLampsReader(const BakedInput& input) : input_(input), values_(input.document, input.root) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    const auto json = entry.find("nearLamps");
    if (!json) return;
    const NearLampTransfer header = readHeader(*json);
    if (!bake.nearLamps) bake.nearLamps = header;
    NearLampTransfer& transfer = *bake.nearLamps;
    expectSame(*json,
               header.order == transfer.order && header.shells == transfer.shells &&
                   header.nearest == transfer.nearest && header.farthest == transfer.farthest,
               "order, shells, nearest and farthest");
    readHalves(*json, ranges, transfer);
    const auto keys = json->find("keys");
    if (!keys) return;
    if (keys_.empty()) keys_.resize(keys->arraySize(), header);
    if (keys->arraySize() != keys_.size())
      keys->fail(
          fmt::format("got {} keys, expected {} as in other primitives", keys->arraySize(), keys_.size()),
          rebake);
    for (std::size_t k = 0; k < keys_.size(); ++k) readHalves(keys->at(k), ranges, keys_[k]);
    place_ = *keys;
  }

  void finish(Bake& bake) override {
    if (keys_.empty()) return;
    if (!bake.animation || bake.animation->times.size() != keys_.size())
      place_->fail(fmt::format("{} keys, but the animation has {}", keys_.size(),
                               bake.animation ? bake.animation->times.size() : 0),
                   rebake);
    bake.animation->nearLamps = std::move(keys_);
  }

 private:
  void readHalves(const JsonCursor& json, const PrimitiveRanges& ranges, NearLampTransfer& transfer) const {
    const JsonCursor halves = json.at("halves");
    const std::size_t count = vertexCount(ranges) * widthOf(transfer);
    const auto values = halves.value().is_object() ? decodedHalves(halves, count)
                                                   : values_.integers<std::uint16_t>(halves, count);
    for (const std::uint16_t value : values)
      if (!std::isfinite(fromHalf(value)))
        halves.fail("expected finite numbers, got one that is not", rebake);
    placeVertices(values, ranges, widthOf(transfer), input_.scene, transfer.halves);
  }

  /// Reads bytes in place of halves.
  std::vector<std::uint16_t> decodedHalves(const JsonCursor& json, std::size_t count) const {
    const std::vector<float> numbers = values_.floats(json, "SCALAR", count);
    std::vector<std::uint16_t> halves(count);
    std::ranges::transform(numbers, halves.begin(), toHalf);
    return halves;
  }

  static NearLampTransfer readHeader(const JsonCursor& json) {
    NearLampTransfer header;
    header.order = readNumber(json.at("order"), 1, maxStoredOrder);
    header.shells = readNumber(json.at("shells"), 2, BakeRequest::maxShells);
    header.nearest = json.at("nearest").asNumber();
    header.farthest = json.at("farthest").asNumber();
    if (!(header.nearest > 0.0 && header.farthest > header.nearest && std::isfinite(header.farthest)))
      json.fail(fmt::format("expected 0 < nearest < farthest, in metres, got {:g} and {:g}", header.nearest,
                            header.farthest),
                rebake);
    return header;
  }

  const BakedInput& input_;
  ValueReader values_;
  std::vector<NearLampTransfer> keys_;  ///< [key]
  std::optional<JsonCursor> place_;     ///< of the last primitive's keys
};

void summarizeNearLamps(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.nearLamps) return;
  const NearLampTransfer& transfer = *bake.nearLamps;
  const std::size_t bytes = nearLampsBytes(bake);
  found.push_back({"nearLamps",
                   fmt::format("shadows of near lamps in {} shells from {:.3g} to {:.3g} m, order {}{}",
                               transfer.shells, transfer.nearest, transfer.farthest, transfer.order,
                               bake.animation && !bake.animation->nearLamps.empty() ? ", at all keys" : ""),
                   bytes,
                   true,
                   {{"order", transfer.order},
                    {"shells", transfer.shells},
                    {"nearest", transfer.nearest},
                    {"farthest", transfer.farthest},
                    {"bytes", bytes}}});
}

constexpr auto nearLampsOptions = std::to_array<Option<BakeRequest>>({
    options::BakeRow::number<&BakeRequest::nearLamps, &NearLampsRequest::shells>(
        options::whole(2, BakeRequest::maxShells, "none"),
        {.field = "NearLampsRequest::shells",
         .name = "near-lamps",
         .help = "shadows of lamps within the scene, from the rays of the transfer of distant lights, with "
                 "this many shells of distance; not given, 8 if a lamp lies within the scene's bounds"}),
});

}  // namespace

Technique nearLampsTechnique() {
  return {.name = "near_lamps",
          .options = {.rows = nearLampsOptions, .behind = "ch-naive"},
          .part = &shellPart,
          .use = {.bounces = false},
          .plan = {.choose = chooseShells,
                   .passes = nearLampsPasses,
                   .addMemory = addNearLampsMemory,
                   .closestHits = nearLampsHits,
                   .addToKey = addNearLampsToKey},
          .makeProjector = makeNearLampsProjector,
          .file = {.members = {"nearLamps"},
                   .quantizable = true,
                   .accessors = {"halves"},
                   .storedBytes = nearLampsBytes,
                   .writeEntry = writeNearLampsEntry,
                   .makeReader = makeTechniqueReader<NearLampsReader>},
          .summarize = summarizeNearLamps,
          .exports = {.copyRelit = copyPart<&TechniqueParts::nearLamps>}};
}

}  // namespace prelight
