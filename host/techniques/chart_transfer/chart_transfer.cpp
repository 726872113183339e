#include "techniques/chart_transfer/chart_transfer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "options/rows.h"
#include "plan/cast_orders.h"
#include "prelight/error.h"
#include "receivers/chart_sampler.h"
#include "techniques/chart_transfer/chart_caster.h"
#include "techniques/chart_transfer/chart_file.h"
#include "techniques/receiver_cast.h"

namespace prelight {

namespace {

std::vector<PlannedPass> chartTransferPasses(const PlanInput& input) {
  const BakeRequest& request = input.request;
  if (request.chartTransfer.size == 0) return {{Pass::ChartTransfer, false, "not asked for"}};
  if (request.sh.order == 0)
    return {{Pass::ChartTransfer, false, "they have the order of the SH transfer, which is not asked for"}};
  const std::size_t mapped =
      countMaterials(input.source, [](const Material& m) { return m.normalTexture.image >= 0; });
  return {{Pass::ChartTransfer, true,
           fmt::format("light maps of at most {0} x {0}, order {1}, {2}, with {3}",
                       request.chartTransfer.size, request.sh.order, plannedChannels(input.colored()),
                       mapped > 0 ? fmt::format("the normals{} of {} normal-mapped materials",
                                                request.chartTransfer.relief ? " and horizons" : "", mapped)
                                  : "shading normals, as no material has a normal map")}};
}

void addChartTransferToKey(const BakeRequest& request, StateHash& hash) {
  hash.value(request.chartTransfer.size);
  if (request.chartTransfer.relief) hash.text("relief");
}

void checkMemory(const BakeRequest& request, const Charts& charts) {
  std::uint64_t bytes = 0;
  for (const Chart& chart : charts.charts)
    bytes += static_cast<std::uint64_t>(chart.width) * static_cast<std::uint64_t>(chart.height) * 4u *
             static_cast<std::uint64_t>(request.sh.order * request.sh.order *
                                        (request.bounces > 0 || request.specular ? 3 : 1));
  if (bytes > request.memory())
    throw UsageError("ChartTransferRequest::size",
                     fmt::format("{} light maps take {} MB, more than the {} MB of BakeRequest::maxMemory",
                                 charts.charts.size(), bytes >> 20, request.memory() >> 20),
                     "bake fewer texels or a lower order, or raise BakeRequest::maxMemory");
}

class ChartTransferProjector final : public Projector {
 public:
  explicit ChartTransferProjector(const BakeContext& context) : context_(context) {
    requireShOrder(context.request, "ChartTransferRequest::size");
    checkMemory(context.request, *context.charts);
  }

  std::string_view stage() const override { return "texels"; }

  bool readsReflected() const override { return true; }

  void run(ReceiverCast* cast, Bake& bake, Progress& progress) override {
    const BakeRequest& request = context_.request;
    ChartTransferOptions options{request.sh.order, cast->bounces(), raysEach(request), request.seed,
                                 request.limits};
    options.specular = specularWaysOf(context_, request.sh.order);
    options.sets = &context_.sets;
    options.setTracers = context_.setTracers;
    options.relief = request.chartTransfer.relief;
    const SlotTransfer& transfer = cast->transfer(progress);
    ChartTransferReport made;
    bake.chartTransfer = makeChartTransfer(context_.scene, *context_.charts, context_.mesh, context_.tracer,
                                           transfer, options, progress, made);
    context_.report.rays += made.rays;
    context_.report.notes.push_back(
        fmt::format("texels: {} light maps, {} texels of them on the surface, {} rays each, {:.3g} % of "
                    "those from inside objects",
                    bake.chartTransfer->maps.size(), made.texels, options.rays,
                    100.0 * double(made.hidden * (options.rays / ChartSampler::positionsPerTexel)) /
                        double(std::max<std::uint64_t>(made.rays, 1))));
  }

 private:
  const BakeContext& context_;
};

/// Throws UsageError without an order of SH, and for too little memory.
std::unique_ptr<Projector> makeChartTransferProjector(const BakeContext& context) {
  if (context.charts == nullptr || context.charts->charts.empty()) return nullptr;
  return std::make_unique<ChartTransferProjector>(context);
}

using Json = Technique::Json;

void writeChartTransferEntry(const BakedOutput& output, const PrimitiveRanges& ranges, Json& entry) {
  if (!output.bake.chartTransfer) return;
  Json texels = chartsToJson(output.document, *output.bake.chartTransfer, output.bake.compressedParts.texels,
                             output.scene, ranges);
  if (!texels.is_null()) entry["texels"] = std::move(texels);
}

void writeChartTransferRoot(const BakedOutput& output, Json& root) {
  if (output.bake.compressedParts.texels)
    root["texelsCompressed"] = sharedToJson(output.document, *output.bake.compressedParts.texels);
}

class ChartTransferReader final : public TechniqueReader {
 public:
  explicit ChartTransferReader(const BakedInput& input) : charts_(input) {}

  void read(const JsonCursor& entry, const PrimitiveRanges& ranges, Bake& /*bake*/) override {
    if (const auto texels = entry.find("texels")) charts_.read(*texels, ranges);
  }

  void finish(Bake& bake) override { charts_.finish(bake.chartTransfer, bake.compressedParts.texels); }

 private:
  ChartReader charts_;
};

void summarizeChartTransfer(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.chartTransfer) return;
  const ChartTransfer& transfer = *bake.chartTransfer;
  std::size_t bytes = 0, texels = 0;
  int most = 0;
  for (const ChartTransfer::Map& map : transfer.maps) {
    bytes += bytesOf(map.coefficients);
    texels += map.texels();
    most = std::max({most, map.width, map.height});
  }
  const std::optional<CompressedTransfer>& compressed = bake.compressedParts.texels;
  if (compressed) bytes = compressed->byteCount();
  found.push_back(
      {"texels",
       fmt::format("{} of at most {} texels a side, {} texels in all; SH of order {}, {}{}",
                   counted(transfer.maps.size(), "light map"), most, texels, transfer.order,
                   channelsText(transfer.channels, transfer.bounces), compressionText(compressed)),
       bytes,
       false,
       {{"maps", transfer.maps.size()},
        {"largestSide", most},
        {"texels", texels},
        {"order", transfer.order},
        {"channels", transfer.channels},
        {"bounces", transfer.bounces},
        {"bytes", bytes}}});
}

void addChartTransferArrays(const Bake& bake, std::vector<BakedArray>& arrays) {
  if (!bake.chartTransfer) return;
  const ChartTransfer& texels = *bake.chartTransfer;
  BakedArray array{
      "texels", fmt::format("[texel][channel {}][i] of order {}", texels.channels, texels.order), {}};
  for (const ChartTransfer::Map& map : texels.maps) {
    array.layout += fmt::format(", {}x{} of primitive {}", map.width, map.height, map.primitive);
    array.parts.emplace_back(map.coefficients);
  }
  arrays.push_back(std::move(array));
}

constexpr auto chartTransferOptions = std::to_array<Option<BakeRequest>>({
    options::BakeRow::number<&BakeRequest::chartTransfer, &ChartTransferRequest::size>(
        options::whole(1, BakeRequest::maxChartSize, "none"),
        {.field = "ChartTransferRequest::size",
         .name = "texels",
         .help = "SH transfer at texels, too, with the normals of normal maps: texels along a side of the "
                 "largest map"}),
    options::BakeRow::flag<&BakeRequest::chartTransfer, &ChartTransferRequest::relief>(
        {.field = "ChartTransferRequest::relief",
         .name = "relief",
         .help = "with transfer at texels: bumps of normal maps shadow one another"}),
});

}  // namespace

Technique chartTransferTechnique() {
  return {.name = "texels",
          .options = {.rows = chartTransferOptions},
          .part = &chartPart,
          .use = {.scattering = true},
          .plan = {.passes = chartTransferPasses, .addToKey = addChartTransferToKey},
          .makeProjector = makeChartTransferProjector,
          .file = {.members = {"texels"},
                   .everywhere = false,
                   .accessors = compressedAccessors({"texCoord", "coefficients"}),
                   .writeEntry = writeChartTransferEntry,
                   .writeRoot = writeChartTransferRoot,
                   .makeReader = makeTechniqueReader<ChartTransferReader>},
          .summarize = summarizeChartTransfer,
          .addArrays = addChartTransferArrays,
          .relighting = &texelRelighting};
}

}  // namespace prelight
