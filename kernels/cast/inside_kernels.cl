// Receivers that lie inside objects.
#include "shared/cast_types.h"
#include "shared/ray_types.h"

// A receiver a work-item. rays, hits [receiver][raysPerReceiver]; geometricNormals [triangle][3]; twoSided [triangle], 1
// where both sides are fronts -> inside [receiver], 1 where every ray that leaves the receiver's own surface met the back
// of a one-sided surface: nobody sees such a place, and what it would bake is none of its neighbours' business.
__kernel void markInside(__constant const CastParameters* parameters, __global const Receiver* receivers,
                         __global const Ray* rays, __global const Hit* hits, __global const float* geometricNormals,
                         __global const uchar* twoSided, __global uchar* inside) {
  const size_t receiver = get_global_id(0);
  if (receiver >= parameters->receiverCount) return;
  const float3 up = vload3(0, receivers[receiver].geometricNormal);
  uint leaving = 0, backs = 0;
  for (uint j = 0; j < parameters->raysPerReceiver; ++j) {
    const size_t ray = receiver * parameters->raysPerReceiver + j;
    const float3 direction = vload3(0, rays[ray].direction);
    if (dot(direction, up) <= 0.0f) continue;
    ++leaving;
    const uint t = hits[ray].triangle;
    if (t != PRELIGHT_NO_TRIANGLE && !twoSided[t] && dot(direction, vload3(t, geometricNormals)) > 0.0f) ++backs;
  }
  inside[receiver] = leaving > 0 && backs == leaving ? 1 : 0;
}
