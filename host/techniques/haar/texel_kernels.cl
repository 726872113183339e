// Cube map texels of rays, for projections that need every ray: wavelets.
#include "techniques/haar/cube_funcs.cl"
#include "project/visibility_funcs.cl"
#include "shared/cast_types.h"
#include "shared/ray_types.h"

// One work-item per ray. rays, hits [receiver][raysPerReceiver] -> codes, of that shape: texel of the direction x 256 +
// the share of the light that is blocked, 0..255.
__kernel void codeTexels(__constant const CastParameters* parameters, uint faceSize, __global const Ray* rays,
                         __global const Hit* hits, __global uint* codes) {
  const size_t i = get_global_id(0);
  if (i >= (size_t)parameters->receiverCount * parameters->raysPerReceiver) return;
  const uint blocked = (uint)(255.0f * (1.0f - visibilityOf(parameters, hits[i])) + 0.5f);
  codes[i] = cubeTexel(vload3(0, rays[i].direction), faceSize) << 8 | blocked;
}
