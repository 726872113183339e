#include <fmt/format.h>

#include "prelight/error.h"
#include "relight/device/dense_relighter.h"
#include "relight/device/relighting.h"
#include "techniques/light_groups/light_groups.h"

namespace prelight {

namespace {

/// The scene's own lights, as rows of a coefficient per group and channel.
class LightGroupPart final : public RelitPart {
 public:
  LightGroupPart(const LightGroupTransfer& transfer, DeviceContext& device, ColorWrite write)
      : groups_(device, {transfer.groups.size(), static_cast<std::size_t>(transfer.channels)},
                transfer.coefficients, write),
        count_(transfer.groups.size()),
        write_(write) {}

  std::size_t receiverCount() const override { return groups_.receiverCount(); }

  std::size_t groupCount() const override { return count_; }

  std::size_t bytesMoved() const override {
    const std::size_t readColors = write_ == ColorWrite::Add ? 3 * receiverCount() * sizeof(float) : 0;
    return shines_ ? groups_.bytesMoved() + readColors : 0;
  }

  void light(const RelighterLight& light) override {
    if (write_ == ColorWrite::Replace &&
        (light.sky != nullptr || !light.lights.empty() || !light.coefficients.empty()))
      throw UsageError("RelighterLight", "the bake holds transfer of the scene's own lights alone",
                       "bake transfer of skies and distant lights as well");
    std::vector<double> colors(3 * count_, 0.0);
    for (std::size_t g = 0; g < light.groups.size(); ++g)
      for (std::size_t c = 0; c < 3; ++c) colors[c * count_ + g] = light.groups[g][static_cast<int>(c)];
    groups_.setLight(colors);
    shines_ = write_ == ColorWrite::Replace || !light.groups.empty();
  }

  void relight(Buffer<float>& radiance) override {
    if (shines_) groups_.relight(radiance);
  }

 private:
  DenseRelighter groups_;
  std::size_t count_;
  ColorWrite write_;
  bool shines_ = true;
};

std::string groupsForm(const Bake& bake) {
  if (!bake.lightGroups || bake.lightGroups->groups.empty()) return {};
  const int channels = bake.lightGroups->channels;
  return fmt::format("{} groups, {} channel{}, rows of floats", bake.lightGroups->groups.size(), channels,
                     channels == 1 ? "" : "s");
}

std::unique_ptr<RelitPart> makeGroupPart(const RelitSource& source) {
  return std::make_unique<LightGroupPart>(*source.bake.lightGroups, source.device, ColorWrite::Replace);
}

std::unique_ptr<RelitPart> makeAddedGroups(const RelitSource& source) {
  return std::make_unique<LightGroupPart>(*source.bake.lightGroups, source.device, ColorWrite::Add);
}

}  // namespace

const Relighting lightGroupsRelighting = {
    .preference = preferOwnLights, .form = groupsForm, .make = makeGroupPart, .makeAdded = makeAddedGroups};

}  // namespace prelight
