#include "techniques/volume/volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "options/rows.h"
#include "plan/cast_orders.h"
#include "techniques/compressed_rows.h"
#include "techniques/receiver_cast.h"
#include "techniques/volume/volume_caster.h"
#include "techniques/volume/volume_file.h"
#include "techniques/volume/volume_light.h"

namespace prelight {

namespace {

/// Values a voxel, without those of light groups: with bounces, three channels, what is direct, and what
/// surfaces send in three channels by four functions of direction.
std::uint64_t valuesOf(const PlanInput& input) {
  const int order = input.request.sh.order;
  return static_cast<std::uint64_t>(order * order) * (input.bounces ? 3 + 1 + 3 * 4 : 1);
}

/// The light that a group adds to a voxel.
std::string lightsText(const PlanInput& input) {
  return input.bounces && input.request.lightGroups ? ", 108 more per light group" : "";
}

std::vector<PlannedPass> volumePasses(const PlanInput& input) {
  const BakeRequest& request = input.request;
  if (request.volume.size == 0) return {{Pass::Volume, false, "not asked for"}};
  if (request.sh.order == 0)
    return {{Pass::Volume, false, "it has the order of the SH transfer, which is not asked for"}};
  return {
      {Pass::Volume, true,
       fmt::format("{} voxels along the longest side, order {}, {}{}, {} bytes per voxel{}; moving objects "
                   "are not in it, and everything in the scene shadows it",
                   request.volume.size, request.sh.order, plannedChannels(input.bounces),
                   input.bounces ? " and one without bounces" : "", 4 * valuesOf(input), lightsText(input))}};
}

void addVolumeMemory(const PlanInput& input, Plan& plan) {
  const auto side = static_cast<std::uint64_t>(input.request.volume.size);
  plan.hostBytes += side * side * side * (4 * valuesOf(input) + 1);
}

void addVolumeToKey(const BakeRequest& request, StateHash& hash) { hash.value(request.volume.size); }

class VolumeProjector final : public Projector {
 public:
  explicit VolumeProjector(const BakeContext& context) : context_(context) {
    requireShOrder(context.request, "VolumeRequest::size");
  }

  std::string_view stage() const override { return "volume"; }

  bool readsReflected() const override { return true; }

  void run(ReceiverCast* cast, Bake& bake, Progress& progress) override {
    const BakeRequest& request = context_.request;
    const SlotTransfer& transfer = cast->transfer(progress);
    const VolumeGrid grid = makeVolumeGrid(context_.scene, request.volume.size);
    const VolumeOptions options{request.sh.order,  cast->bounces(), request.lightGroups.wanted,
                                raysEach(request), request.seed,    request.limits};
    bake.volume =
        makeVolume(context_.scene, context_.mesh, context_.tracer, transfer, grid, options, progress);
    context_.report.rays += std::uint64_t{options.rays} * grid.count();
    context_.report.notes.push_back(
        fmt::format("volume: {} x {} x {} voxels of {:.3g} m, {} rays each, {} of them inside objects",
                    grid.size.x, grid.size.y, grid.size.z, grid.cell(), options.rays,
                    std::count(bake.volume->air.begin(), bake.volume->air.end(), 0)));
  }

 private:
  const BakeContext& context_;
};

/// Throws UsageError without an order of SH.
std::unique_ptr<Projector> makeVolumeProjector(const BakeContext& context) {
  if (context.request.volume.size == 0) return nullptr;
  return std::make_unique<VolumeProjector>(context);
}

using Json = Technique::Json;

void writeVolumeRoot(const BakedOutput& output, Json& root) {
  if (output.bake.volume)
    root["volume"] = volumeToJson(output.document, *output.bake.volume, output.bake.compressedParts);
}

class VolumeReader final : public TechniqueReader {
 public:
  explicit VolumeReader(const BakedInput& input) : input_(input) {}

  void finish(Bake& bake) override {
    if (!input_.extension) return;
    if (const auto volume = input_.extension->find("volume"))
      bake.volume = readVolume(input_.document, input_.root, *volume, bake.compressedParts);
  }

 private:
  const BakedInput& input_;
};

void summarizeVolume(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.volume) return;
  const VolumeTransfer& transfer = *bake.volume;
  const VolumeGrid& grid = transfer.grid;
  const CompressedParts& parts = bake.compressedParts;
  const auto stored = [](const std::optional<CompressedTransfer>& compressed,
                         const std::vector<float>& floats) {
    return compressed ? compressed->byteCount() : bytesOf(floats);
  };
  const std::size_t bytes = stored(parts.volume, transfer.coefficients) +
                            stored(parts.volumeDirect, transfer.direct) + bytesOf(transfer.air) +
                            stored(parts.volumeSent, transfer.sent) + bytesOf(transfer.lights);
  const auto inside = static_cast<std::size_t>(
      std::count(transfer.air.begin(), transfer.air.end(), static_cast<std::uint8_t>(0)));
  found.push_back(
      {"volume",
       fmt::format(
           "volume of {} x {} x {} cells, {:.3g} wide, {} of them inside objects; SH of order {}, {}{}{}",
           grid.size.x, grid.size.y, grid.size.z, grid.cell(), inside, transfer.order,
           channelsText(transfer.channels, transfer.bounces),
           transfer.groups() == 0 ? "" : ", with " + counted(transfer.groups(), "light group"),
           compressionText(parts.volume)),
       bytes,
       false,
       {{"size", {grid.size.x, grid.size.y, grid.size.z}},
        {"min", {grid.min.x, grid.min.y, grid.min.z}},
        {"max", {grid.max.x, grid.max.y, grid.max.z}},
        {"insideCells", inside},
        {"order", transfer.order},
        {"channels", transfer.channels},
        {"bounces", transfer.bounces},
        {"lightGroups", transfer.groups()},
        {"bytes", bytes}}});
}

constexpr auto volumeOptions = std::to_array<Option<BakeRequest>>({
    options::BakeRow::number<&BakeRequest::volume, &VolumeRequest::size>(
        options::whole(1, BakeRequest::maxVolumeSize, "none"),
        {.field = "VolumeRequest::size",
         .name = "volume",
         .help = "SH transfer of points in the air, on a grid of this many voxels along the scene's longest "
                 "side (32 is usual)"}),
});

}  // namespace

Technique volumeTechnique() {
  return {.name = "volume",
          .options = {.rows = volumeOptions},
          .plan = {.passes = volumePasses, .addMemory = addVolumeMemory, .addToKey = addVolumeToKey},
          .makeProjector = makeVolumeProjector,
          .file = {.accessors = compressedAccessors({"coefficients", "direct", "air", "sent", "lights"}),
                   .writeRoot = writeVolumeRoot,
                   .makeReader = makeTechniqueReader<VolumeReader>},
          .summarize = summarizeVolume,
          .relighting = &volumeRelighting,
          .exports = {.forms = {"volume"}}};
}

}  // namespace prelight
