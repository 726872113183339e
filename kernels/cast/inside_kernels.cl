// Detection of receivers that lie inside objects.
#include "shared/cast_types.h"
#include "shared/ray_types.h"

// One work-item per receiver. rays, hits [receiver][raysPerReceiver]; geometricNormals [triangle][3]; hides [triangle],
// 1 where the back hides what lies behind it -> inside [receiver]: 1 where no ray that leaves the receiver's own
// surface escapes and at least `quarters` quarters of the rays meet such a back. Such places are never seen, and their
// values must not affect their neighbours. With `closest` 0, hits do not say what was met: 1 where nothing escapes.
__kernel void markInside(__constant const CastParameters* parameters, const uint closest, const uint quarters,
                         __global const Receiver* receivers, __global const Ray* rays, __global const Hit* hits,
                         __global const float* geometricNormals, __global const uchar* hides, __global uchar* inside) {
  const size_t receiver = get_global_id(0);
  if (receiver >= parameters->receiverCount) return;
  const float3 up = vload3(0, receivers[receiver].geometricNormal);
  uint leaving = 0, backs = 0;
  bool escapes = false;
  for (uint j = 0; j < parameters->raysPerReceiver && !escapes; ++j) {
    const size_t ray = receiver * parameters->raysPerReceiver + j;
    const float3 direction = vload3(0, rays[ray].direction);
    if (dot(direction, up) <= 0.0f) continue;
    ++leaving;
    const uint t = hits[ray].triangle;
    escapes = t == PRELIGHT_NO_TRIANGLE;
    if (closest != 0u && !escapes && hides[t] && dot(direction, vload3(t, geometricNormals)) > 0.0f) ++backs;
  }
  inside[receiver] = !escapes && leaving > 0u && (closest == 0u || 4u * backs >= quarters * leaving) ? 1 : 0;
}
