#include "techniques/haar/haar_projector.h"

#include <fmt/format.h>

#include "techniques/haar/haar_transfer.h"
#include "techniques/receiver_cast.h"

namespace prelight {

namespace {

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

}  // namespace

std::unique_ptr<Projector> haarProjector(const BakeContext& context) {
  if (context.request.haar.size == 0) return nullptr;
  return std::make_unique<HaarProjector>(context);
}

}  // namespace prelight
