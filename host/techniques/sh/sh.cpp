#include "techniques/sh/sh.h"

#include <array>

#include "options/rows.h"
#include "techniques/receiver_cast.h"
#include "techniques/sh/harmonics.h"

namespace prelight {

namespace {

std::vector<PlannedPass> shPasses(const PlanInput& input) {
  return {planHarmonics(Pass::ShTransfer, input.request.sh.order, input.colored(), "")};
}

void addShToKey(const BakeRequest& request, StateHash& hash) { hash.value(request.sh.order); }

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

std::unique_ptr<Projector> makeShProjector(const BakeContext& context) {
  if (context.request.sh.order == 0) return nullptr;
  return std::make_unique<ShProjector>(context);
}

struct ShKind {
  static constexpr auto transfer = &Bake::sh;
  static constexpr const char* key = "sh";
  static constexpr const char* title = "SH";
  static constexpr bool quantizable = false;  // it has methods of its own (compress/compress.h)
};

constexpr auto shOptions = std::to_array<Option<BakeRequest>>({
    options::BakeRow::number<&BakeRequest::sh, &ShRequest::order>(
        options::whole(1, BakeRequest::maxShOrder, "none"),
        {.field = "ShRequest::order",
         .name = "sh",
         .help = "spherical-harmonic transfer of this order (order squared coefficients)"}),
});

}  // namespace

Technique shTechnique() {
  return {.name = ShKind::key,
          .options = {.rows = shOptions},
          .shading = &shShading,
          .plan = {.drawable = true, .passes = shPasses, .addToKey = addShToKey},
          .makeProjector = makeShProjector,
          .file = Harmonic<ShKind>::file(),
          .summarize = Harmonic<ShKind>::summarize,
          .addArrays = Harmonic<ShKind>::addArrays,
          .relighting = &shRelighting,
          .exports = {.asNumbers = true, .relitAlone = true, .copyRelit = copyPart<&TechniqueParts::sh>}};
}

}  // namespace prelight
