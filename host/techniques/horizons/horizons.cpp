#include "techniques/horizons/horizons.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "io/values/baked_ranges.h"
#include "io/values/value_reader.h"
#include "options/rows.h"
#include "techniques/horizons/horizon_bands.h"
#include "techniques/horizons/sector_column.h"
#include "techniques/packed_values.h"
#include "techniques/receiver_cast.h"

namespace prelight {

namespace {

std::vector<PlannedPass> horizonsPasses(const PlanInput& input) {
  const int sectors = input.request.horizons.sectors;
  if (sectors == 0) return {};
  return {{Pass::Horizons, true, fmt::format("of {} sectors of azimuth, from the same cast", sectors)}};
}

/// Sums of the fit, its solution, and what is stored of it.
void addHorizonsMemory(const PlanInput& input, Plan& plan) {
  const auto sectors = static_cast<std::uint64_t>(input.request.horizons.sectors);
  if (sectors == 0) return;
  plan.hostBytes += input.scene.vertexCount() * sectors * (sectorRows * (4 + 4) + 4 + 4) +
                    24ull * input.scene.triangleCount();
}

void addHorizonsToKey(const BakeRequest& request, StateHash& hash) {
  if (request.horizons.sectors == 0) return;
  hash.text("horizons");
  hash.value(request.horizons.sectors);
}

constexpr std::size_t horizonGrain = 4096;  // vertices that a thread takes at once

class HorizonsProjector final : public Projector {
 public:
  explicit HorizonsProjector(const BakeContext& context)
      : context_(context),
        sectors_(static_cast<std::size_t>(context.request.horizons.sectors)),
        column_(static_cast<std::uint32_t>(sectors_)) {}

  std::string_view stage() const override { return "horizons"; }

  void addColumns(const HemisphereColumn& /*hemisphere*/, std::vector<Column*>& columns) override {
    columns.push_back(&column_);
  }

  void run(ReceiverCast* cast, Bake& bake, Progress& progress) override {
    const std::vector<float> fitted = column_.solve(cast->front(), progress);
    HorizonTransfer horizons{static_cast<int>(sectors_), {}, {}};
    horizons.angles.resize(context_.scene.vertexCount() * sectors_);
    horizons.feet.resize(horizons.angles.size());
    parallelRanges(context_.scene.vertexCount(), horizonGrain, [&](std::size_t begin, std::size_t end) {
      std::vector<SectorRays> rays(sectors_);
      for (std::size_t v = begin; v < end; ++v) {
        const float* values = &fitted[context_.mesh.slotOfVertex[v] * sectorRows * sectors_];
        for (std::size_t s = 0; s < sectors_; ++s) rays[s] = raysOf(values + s);
        closedBands(rays, std::span(horizons.feet).subspan(v * sectors_, sectors_),
                    std::span(horizons.angles).subspan(v * sectors_, sectors_));
      }
    });
    bake.horizons = std::move(horizons);
  }

 private:
  const BakeContext& context_;
  /// Values of a sector, of a vertex.
  SectorRays raysOf(const float* values) const {
    return {.open = 1.0 + double(finiteOr(values[sectors_], -1.0f)),
            .closed = double(finiteOr(values[0], 1.0f)),
            .height = double(finiteOr(values[2 * sectors_], 0.5f))};
  }

  std::size_t sectors_;
  SectorColumn column_;
};

std::unique_ptr<Projector> makeHorizonsProjector(const BakeContext& context) {
  if (context.request.horizons.sectors == 0) return nullptr;
  return std::make_unique<HorizonsProjector>(context);
}

using Json = Technique::Json;

constexpr float highestHorizon = 0.5f * std::numbers::pi_v<float>;
constexpr float rounding = 1e-6f;  // of a right angle

std::size_t horizonsBytes(const Bake& bake) {
  return bake.horizons ? bytesOf(bake.horizons->angles) + bytesOf(bake.horizons->feet) : 0;
}

void writeHorizonsEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (!output.bake.horizons) return;
  const HorizonTransfer& horizons = *output.bake.horizons;
  const auto width = static_cast<std::size_t>(horizons.sectors);
  const ByteForm form{.isSigned = false, .scale = highestHorizon};
  entry["horizons"] = {{"sectors", horizons.sectors},
                       {"angles", output.column("horizons", horizons.angles, ranges, width, form)}};
  if (!horizons.feet.empty())
    entry["horizons"]["feet"] = output.column("feet of horizons", horizons.feet, ranges, width, form);
}

class HorizonsReader final : public TechniqueReader {
 public:
  explicit HorizonsReader(const BakedInput& input) : input_(input), values_(input.document, input.root) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& bake) override {
    const auto json = entry.find("horizons");
    if (!json) return;
    const int sectors = readNumber(json->at("sectors"), BakeRequest::minSectors, BakeRequest::maxSectors);
    if (!bake.horizons) bake.horizons = HorizonTransfer{sectors, {}, {}};
    expectSame(*json, sectors == bake.horizons->sectors, "sectors");
    const auto width = static_cast<std::size_t>(sectors);
    const std::size_t count = vertexCount(ranges) * width;
    const std::vector<float> horizons = anglesIn(json->at("angles"), count);
    placeVertices(horizons, ranges, width, input_.scene, bake.horizons->angles);
    const auto feet = json->find("feet");  // older files have none
    if (feet) placeVertices(anglesIn(*feet, count), ranges, width, input_.scene, bake.horizons->feet);
  }

 private:
  std::vector<float> anglesIn(const JsonCursor& json, std::size_t count) const {
    std::vector<float> values = values_.floats(json, "SCALAR", count);
    for (const float angle : values)
      if (angle < 0.0f || angle > highestHorizon + rounding)
        json.fail(fmt::format("expected angles from 0 to pi/2, radians, got {:g}", angle), rebake);
    return values;
  }

  const BakedInput& input_;
  ValueReader values_;
};

void summarizeHorizons(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.horizons) return;
  const std::size_t bytes = horizonsBytes(bake);
  found.push_back({"horizons",
                   fmt::format("horizons in {} sectors of azimuth", bake.horizons->sectors),
                   bytes,
                   true,
                   {{"sectors", bake.horizons->sectors}, {"bytes", bytes}}});
}

void addHorizonsArrays(const Bake& bake, std::vector<BakedArray>& arrays) {
  if (!bake.horizons) return;
  const std::string layout = fmt::format("[vertex][sector {}]", bake.horizons->sectors);
  arrays.push_back({"horizons", layout, {bake.horizons->angles}});
  if (!bake.horizons->feet.empty()) arrays.push_back({"feet of horizons", layout, {bake.horizons->feet}});
}

constexpr auto horizonsOptions = std::to_array<Option<BakeRequest>>({
    options::BakeRow::number<&BakeRequest::horizons, &HorizonsRequest::sectors>(
        options::whole(BakeRequest::minSectors, BakeRequest::maxSectors, "none"),
        {.field = "HorizonsRequest::sectors",
         .name = "horizons",
         .help = "horizon angles in this many sectors of azimuth around the normal (8 is usual), to shadow "
                 "sky, lights and reflections"}),
});

}  // namespace

Technique horizonsTechnique() {
  return {.name = "horizons",
          .options = {.rows = horizonsOptions, .behind = "cones"},
          .shading = &horizonsShading,
          .use = {.bounces = false},
          .plan = {.passes = horizonsPasses, .addMemory = addHorizonsMemory, .addToKey = addHorizonsToKey},
          .makeProjector = makeHorizonsProjector,
          .file = {.members = {"horizons"},
                   .quantizable = true,
                   .accessors = {"angles", "feet"},
                   .storedBytes = horizonsBytes,
                   .writeEntry = writeHorizonsEntry,
                   .makeReader = makeTechniqueReader<HorizonsReader>},
          .summarize = summarizeHorizons,
          .addArrays = addHorizonsArrays};
}

}  // namespace prelight
