#include "techniques/ch/ch_projector.h"

#include "techniques/harmonic_rows.h"
#include "techniques/receiver_cast.h"

namespace prelight {

namespace {

class ChProjector final : public Projector {
 public:
  explicit ChProjector(const BakeContext& context) : context_(context) {}

  std::string_view stage() const override { return "bounce"; }

  void run(ReceiverCast* cast, Bake& bake, Progress& progress) override {
    const SlotTransfer& transfer = cast->transfer(progress);
    bake.ch = chTransfer(context_, transfer, frontValues(transfer));
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
