#include "projectors/ch/ch_projector.h"

#include "basis/ch.h"
#include "projectors/packed_values.h"
#include "projectors/receiver_cast.h"

namespace prelight {

namespace {

class ChProjector final : public Projector {
 public:
  explicit ChProjector(const BakeContext& context) : context_(context) {}

  std::string_view stage() const override { return "bounce"; }

  /// Coefficients, or the inner products that a projection onto non-orthogonal functions takes for them.
  void run(ReceiverCast* cast, Bake& bake, Progress& progress) override {
    const SlotTransfer& transfer = cast->transfer(progress);
    const ChRequest& request = context_.request.ch;
    const auto n = static_cast<std::size_t>(request.order * request.order);
    const ch::Basis basis(request.order);
    std::vector<double> sh(n), coefficients(n);
    const auto write = [&](const float* row, float* out) {
      sh.assign(row, row + n);
      request.naive ? basis.momentsFromSh(sh, coefficients) : basis.fromSh(sh, coefficients);
      for (std::size_t i = 0; i < n; ++i) out[i] = finiteOr(coefficients[i], 0.0f);
    };
    bake.ch = {request.order, transfer.channels(), transfer.bounces,
               packRows(context_.mesh, transfer, context_.scene, transfer.channels(), n, write),
               request.naive};
  }

 private:
  const BakeContext& context_;
};

}  // namespace

std::unique_ptr<Projector> chProjector(const BakeContext& context) {
  if (context.request.ch.order == 0) return nullptr;
  return std::make_unique<ChProjector>(context);
}

}  // namespace prelight
