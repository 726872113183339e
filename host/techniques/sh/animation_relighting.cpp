#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "prelight/error.h"
#include "relight/device/harmonic_part.h"
#include "relight/device/keyframe_relighter.h"
#include "techniques/sh/animated_transfer.h"
#include "techniques/sh/sh.h"

namespace prelight {

namespace {

/// SH at the keys of an animation.
class KeyedPart final : public HarmonicPart {
 public:
  KeyedPart(const AnimatedTransfer& transfer, DeviceContext& device)
      : HarmonicPart(std::make_unique<KeyframeRelighter>(device, transfer.keys), transfer.keys.front().order,
                     device),
        times_(transfer.times) {}

  void setTime(double seconds) override {
    if (!std::isfinite(seconds)) throw UsageError("Relighter::setTime", "got a time that is not finite");
    const KeysAround keys = keysAround(times_, seconds);
    static_cast<KeyframeRelighter&>(*series_).setMoment(keys.first, keys.blend);
  }

 private:
  std::vector<double> times_;
};

std::string keysForm(const Bake& bake) {
  if (!bake.animation || bake.animation->keys.empty()) return {};
  const HarmonicTransfer& first = bake.animation->keys.front();
  return fmt::format("{} keys of {}, two of which are blended", bake.animation->keys.size(),
                     denseForm(first.order, first.channels));
}

std::unique_ptr<RelitPart> makeKeyedPart(const RelitSource& source) {
  return std::make_unique<KeyedPart>(*source.bake.animation, source.device);
}

}  // namespace

const Relighting animationRelighting = {.preference = preferMoving, .form = keysForm, .make = makeKeyedPart};

}  // namespace prelight
