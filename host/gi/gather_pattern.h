#pragma once

#include <cstddef>

#include "device/buffer.h"
#include "shared/cast_types.h"
#include "shared/gather_types.h"
#include "shared/ray_types.h"

namespace prelight {

/// Receivers of a final gathering that are on the device at once.
struct GatherBlock {
  std::size_t first = 0;     ///< of all receivers
  std::size_t count = 0;     ///< receivers
  std::size_t rayCount = 0;  ///< of all of these
  const Buffer<device::GatherParameters>& parameters;
  const Buffer<device::Receiver>& receivers;
  Buffer<device::Ray>& rays;        ///< [receiver][ray]
  const Buffer<device::Hit>& hits;  ///< [receiver][ray] the first, while meet() is called
  const Buffer<float>& radiances;   ///< [receiver][ray][3], for sum()
};

/// Which rays a final gathering casts, and what it makes of what they bring.
class GatherPattern {
 public:
  virtual ~GatherPattern() = default;

  virtual void makeRays(const GatherBlock& block) = 0;
  /// Rays have met their first surfaces.
  virtual void meet(const GatherBlock&) {}
  /// All of the light is there.
  virtual void sum(const GatherBlock& block) = 0;
};

}  // namespace prelight
