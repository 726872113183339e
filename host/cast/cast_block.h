#pragma once

#include "device/buffer.h"
#include "shared/cast_types.h"
#include "shared/ray_types.h"

namespace prelight {

/// Device buffers of the block that is being cast.
struct CastBlockBuffers {
  const Buffer<device::CastParameters>& parameters;
  const Buffer<device::Receiver>& receivers;
  const Buffer<device::Ray>& rays;
  const Buffer<device::Hit>& hits;  ///< the closest ones where those who read them need that
};

}  // namespace prelight
