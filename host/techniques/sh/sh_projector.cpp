#include "techniques/sh/sh_projector.h"

#include "techniques/harmonic_rows.h"
#include "techniques/receiver_cast.h"

namespace prelight {

namespace {

class ShProjector final : public Projector {
 public:
  explicit ShProjector(const BakeContext& context) : context_(context) {}

  std::string_view stage() const override { return "bounce"; }

  /// The first bands of the transfer.
  void run(ReceiverCast* cast, Bake& bake, Progress& progress) override {
    const SlotTransfer& transfer = cast->transfer(progress);
    bake.sh = shTransfer(context_, transfer, frontValues(transfer));
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
