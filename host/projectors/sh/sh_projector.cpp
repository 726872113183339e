#include "projectors/sh/sh_projector.h"

#include "projectors/packed_values.h"
#include "projectors/receiver_cast.h"

namespace prelight {

namespace {

class ShProjector final : public Projector {
 public:
  explicit ShProjector(const BakeContext& context) : context_(context) {}

  std::string_view stage() const override { return "bounce"; }

  /// The first bands of the transfer.
  void run(ReceiverCast* cast, Bake& bake, Progress& progress) override {
    const SlotTransfer& transfer = cast->transfer(progress);
    const int order = context_.request.sh.order;
    const auto n = static_cast<std::size_t>(order * order);
    bake.sh = {order, transfer.channels(), transfer.bounces,
               packRows(context_.mesh, transfer, context_.scene, transfer.channels(), n,
                        [&](const float* row, float* out) {
                          for (std::size_t i = 0; i < n; ++i) out[i] = finiteOr(row[i], 0.0f);
                        }),
               false};
  }

 private:
  const BakeContext& context_;
};

}  // namespace

std::unique_ptr<Projector> shProjector(const BakeContext& context) {
  if (context.request.sh.order == 0) return nullptr;
  return std::make_unique<ShProjector>(context);
}

}  // namespace prelight
