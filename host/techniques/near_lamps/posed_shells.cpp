#include "techniques/near_lamps/posed_shells.h"

#include <algorithm>

#include "compress/small_floats.h"
#include "techniques/sh/animated_transfer.h"
#include "techniques/sh/bent_transfer.h"

namespace prelight {

namespace {

/// Shells as channels.
HarmonicTransfer asChannels(const NearLampTransfer& shells) {
  HarmonicTransfer transfer{shells.order, shells.shells, 0, std::vector<float>(shells.halves.size())};
  std::transform(shells.halves.begin(), shells.halves.end(), transfer.coefficients.begin(), fromHalf);
  return transfer;
}

void setFrom(const HarmonicTransfer& channels, NearLampTransfer& shells) {
  std::transform(channels.coefficients.begin(), channels.coefficients.end(), shells.halves.begin(), toHalf);
}

}  // namespace

std::optional<NearLampTransfer> nearLampsAt(const AnimatedTransfer& animated, const Scene& scene,
                                            const CompiledScene& compiled, double seconds) {
  if (animated.nearLamps.empty()) return std::nullopt;
  const KeysAround keys = keysAround(animated.times, seconds);
  NearLampTransfer result = animated.nearLamps[keys.first];
  if (keys.blend == 0.0) return result;
  const auto transforms = [&](std::size_t key) {
    return transformsAt(scene, animated.animation, animated.times[key]);
  };
  const HarmonicTransfer first = asChannels(result), last = asChannels(animated.nearLamps[keys.last]);
  const HarmonicTransfer mixed =
      mixTransfers({first, transforms(keys.first)}, {last, transforms(keys.last)}, keys.blend,
                   transformsAt(scene, animated.animation, seconds), scene, compiled, KeyMix::Turned);
  setFrom(mixed, result);
  return result;
}

NearLampTransfer bentNearLamps(const NearLampTransfer& shells, const SurfaceBend& bend) {
  NearLampTransfer result = shells;
  setFrom(halfTurned(asChannels(shells), bend), result);
  return result;
}

}  // namespace prelight
