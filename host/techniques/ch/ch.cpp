#include "techniques/ch/ch.h"

#include <array>

#include "options/rows.h"
#include "techniques/receiver_cast.h"
#include "techniques/sh/harmonics.h"

namespace prelight {

namespace {

std::vector<PlannedPass> chPasses(const PlanInput& input) {
  const BakeRequest& request = input.request;
  return {planHarmonics(Pass::ChTransfer, request.ch.order, input.colored(),
                        request.ch.naive ? ", naive inner products" : ", an exact map of the SH transfer")};
}

void addChToKey(const BakeRequest& request, StateHash& hash) {
  hash.value(request.ch.order).value(request.ch.naive);
}

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

std::unique_ptr<Projector> makeChProjector(const BakeContext& context) {
  if (context.request.ch.order == 0) return nullptr;
  return std::make_unique<ChProjector>(context);
}

struct ChKind {
  static constexpr auto transfer = &Bake::ch;
  static constexpr const char* key = "ch";
  static constexpr const char* title = "CH";
  static constexpr bool quantizable = true;
};

constexpr auto chOptions = std::to_array<Option<BakeRequest>>({
    options::BakeRow::number<&BakeRequest::ch, &ChRequest::order>(
        options::whole(1, BakeRequest::maxShOrder, "none"),
        {.field = "ChRequest::order", .name = "ch", .help = "cpherical-harmonic transfer of this order"}),
    options::BakeRow::flag<&BakeRequest::ch, &ChRequest::naive>(
        {.field = "ChRequest::naive",
         .name = "ch-naive",
         .help = "store plain inner products with the cpherical harmonics, which are not orthogonal: for "
                 "comparison"}),
});

}  // namespace

Technique chTechnique() {
  return {.name = ChKind::key,
          .options = {.rows = chOptions},
          .shading = &chShading,
          .plan = {.drawable = true, .passes = chPasses, .addToKey = addChToKey},
          .makeProjector = makeChProjector,
          .file = Harmonic<ChKind>::file(),
          .summarize = Harmonic<ChKind>::summarize,
          .addArrays = Harmonic<ChKind>::addArrays,
          .relighting = &chRelighting,
          .exports = {.asNumbers = true, .relitAlone = true, .copyRelit = copyPart<&TechniqueParts::ch>}};
}

}  // namespace prelight
