#pragma once

#include <cstddef>

#include "device/buffer.h"
#include "shared/cast_types.h"
#include "shared/gather_types.h"
#include "shared/ray_types.h"

namespace prelight {

/// Receivers of a final gathering that are on the device at the same time.
struct GatherBlock {
  std::size_t first = 0;     ///< index among all receivers
  std::size_t count = 0;     ///< receivers
  std::size_t rayCount = 0;  ///< rays of all these receivers
  const Buffer<device::GatherParameters>& parameters;
  const Buffer<device::Receiver>& receivers;
  Buffer<device::Ray>& rays;        ///< [receiver][ray]
  const Buffer<device::Hit>& hits;  ///< [receiver][ray], first hits, valid during meet()
  const Buffer<float>& radiances;   ///< [receiver][ray][3], valid during sum()
};

/// Strategy of a final gathering: which rays are cast, and what is made of the radiance they bring.
class GatherPattern {
 public:
  virtual ~GatherPattern() = default;

  /// Makes the rays of a block.
  virtual void makeRays(const GatherBlock& block) = 0;
  /// Called when rays have met their first surfaces.
  virtual void meet(const GatherBlock&) {}
  /// Called when the radiance of all rays is complete.
  virtual void sum(const GatherBlock& block) = 0;
};

}  // namespace prelight
