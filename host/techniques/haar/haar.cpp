#include "techniques/haar/haar.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "options/rows.h"
#include "plan/cast_orders.h"
#include "techniques/haar/haar_file.h"
#include "techniques/haar/haar_transfer.h"
#include "techniques/receiver_cast.h"

namespace prelight {

namespace {

constexpr std::uint64_t texelCodeBytes = 4;  // of a ray that is kept texel by texel

std::vector<PlannedPass> haarPasses(const PlanInput& input) {
  const BakeRequest& request = input.request;
  if (request.haar.size == 0) return {{Pass::HaarTransfer, false, "not asked for"}};
  return {{Pass::HaarTransfer, true,
           fmt::format("cube map of 6 x {0} x {0}, {1}, from the rays of the same cast{2}", request.haar.size,
                       plannedChannels(input.colored()),
                       input.colored() ? fmt::format("; {} through SH of order {}",
                                                     input.bounces ? "bounces" : "specular transport",
                                                     transferOrder(request))
                                       : "")}};
}

void addHaarMemory(const PlanInput& input, Plan& plan) {
  const BakeRequest& request = input.request;
  if (request.haar.size == 0) return;
  plan.texelBytes = std::min(plannedRays(input.scene, request) * texelCodeBytes, request.memory() / 4);
  plan.hostBytes += plan.texelBytes;
}

void addHaarToKey(const BakeRequest& request, StateHash& hash) {
  hash.value(request.haar.size).value(request.haar.error);
}

class HaarProjector final : public Projector {
 public:
  explicit HaarProjector(const BakeContext& context)
      : context_(context), texels_(context.request.haar.size, context.plan.texelBytes) {}

  std::string_view stage() const override { return "haar"; }
  void addColumns(const HemisphereColumn& /*hemisphere*/, std::vector<Column*>& columns) override {
    columns.push_back(&texels_);
  }

  void run(ReceiverCast* cast, Bake& bake, Progress& progress) override {
    const HaarRequest& request = context_.request.haar;
    const SlotTransfer& transfer = cast->transfer(progress);
    const TexelTransfer direct(context_.scene, context_.mesh, cast->front(), texels_);
    bake.haar = makeHaarTransfer(context_.mesh, direct, cast->hemisphere().baselineOf(Side::Front), transfer,
                                 cast->fitted(), request, progress);
    context_.report.notes.push_back(
        fmt::format("wavelets: {:.0f} of {} coefficients per row are kept, on average",
                    double(bake.haar->indices.size()) / double(bake.haar->offsets.size() - 1),
                    cubeTexelCount(request.size)));
  }

 private:
  const BakeContext& context_;
  TexelColumn texels_;
};

std::unique_ptr<Projector> makeHaarProjector(const BakeContext& context) {
  if (context.request.haar.size == 0) return nullptr;
  return std::make_unique<HaarProjector>(context);
}

std::size_t bytesOfHaar(const Bake& bake) { return bake.haar ? storedBytes(*bake.haar) : 0; }

void summarizeHaar(const Bake& bake, std::size_t /*vertices*/, std::vector<BakedSummary>& found) {
  if (!bake.haar) return;
  const HaarTransfer& transfer = *bake.haar;
  const std::size_t bytes = bytesOfHaar(bake);
  const std::size_t rows = transfer.offsets.empty() ? 0 : transfer.offsets.size() - 1;
  const double mean =
      rows == 0 ? 0.0 : static_cast<double>(transfer.values.size()) / static_cast<double>(rows);
  found.push_back(
      {"haar",
       fmt::format("Haar wavelets on 6 x {0} x {0} texels, {1}; {2:.1f} of {3} coefficients per row",
                   transfer.faceSize, channelsText(transfer.channels, transfer.bounces), mean,
                   6 * transfer.faceSize * transfer.faceSize),
       bytes,
       true,
       {{"faceSize", transfer.faceSize},
        {"channels", transfer.channels},
        {"bounces", transfer.bounces},
        {"coefficientsPerRow", mean},
        {"bytes", bytes}}});
}

constexpr auto haarOptions = std::to_array<Option<BakeRequest>>({
    options::BakeRow::number<&BakeRequest::haar, &HaarRequest::size>(
        options::powerOfTwo(1, BakeRequest::maxHaarSize, "none"),
        {.field = "HaarRequest::size",
         .name = "haar",
         .help = "Haar wavelet transfer on cube maps with this many texels along a side of a face, a power "
                 "of two"}),
    options::BakeRow::number<&BakeRequest::haar, &HaarRequest::error>(
        options::real(0, 1), {.field = "HaarRequest::error",
                              .name = "haar-error",
                              .help = "relative error that is allowed when wavelets are dropped"}),
});

}  // namespace

std::size_t storedBytes(const HaarTransfer& haar) {
  return bytesOf(haar.offsets) + haar.indices.size() * haar.storedIndexBytes() + bytesOf(haar.values);
}

Technique haarTechnique() {
  return {.name = "haar",
          .options = {.rows = haarOptions, .behind = "ch-naive"},
          .shading = &haarShading,
          .plan = {.passes = haarPasses, .addMemory = addHaarMemory, .addToKey = addHaarToKey},
          .makeProjector = makeHaarProjector,
          .file = {.members = {"haar"},
                   .quantizable = true,
                   .accessors = {"offsets", "indices", "values"},
                   .storedBytes = bytesOfHaar,
                   .writeEntry = writeHaar,
                   .makeReader = makeHaarReader},
          .summarize = summarizeHaar,
          .relighting = &haarRelighting,
          .exports = {.asNumbers = true}};
}

}  // namespace prelight
