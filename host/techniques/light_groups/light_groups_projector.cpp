#include "techniques/light_groups/light_groups_projector.h"

#include <algorithm>

#include "techniques/packed_values.h"
#include "techniques/receiver_cast.h"

namespace prelight {

namespace {

class LightGroupsProjector final : public Projector {
 public:
  explicit LightGroupsProjector(const BakeContext& context)
      : context_(context),
        lights_(groupLights(context.scene, context.request.lightGroups.named)),
        column_(lights_) {}

  std::string_view stage() const override { return "bounce"; }

  void addColumns(const HemisphereColumn& /*hemisphere*/, std::vector<Column*>& columns) override {
    if (!lights_.empty()) columns.push_back(&column_);
  }
  const LightColumn* carriedLight() const override { return lights_.empty() ? nullptr : &column_; }

  void run(ReceiverCast* cast, Bake& bake, Progress& progress) override {
    const SlotTransfer& transfer = cast->transfer(progress);
    // Lights of different colours in one group make its channels differ even without bounces.
    const int channels = context_.request.lightGroups.named.empty() ? transfer.channels() : 3;
    const std::size_t first = transfer.shColumns(), n = lights_.groups.size();
    bake.lightGroups = {lights_.groups, channels, transfer.bounces,
                        packRows(context_.mesh, frontValues(transfer), context_.scene, channels, n,
                                 [&](const float* row, float* out) {
                                   // Light is never negative; a fit may dip below.
                                   for (std::size_t g = 0; g < n; ++g)
                                     out[g] = std::max(0.0f, finiteOr(row[first + g], 0.0f));
                                 })};
  }

 private:
  const BakeContext& context_;
  GroupedLights lights_;
  LightColumn column_;
};

}  // namespace

std::unique_ptr<Projector> lightGroupsProjector(const BakeContext& context) {
  if (!context.request.lightGroups) return nullptr;
  return std::make_unique<LightGroupsProjector>(context);
}

}  // namespace prelight
