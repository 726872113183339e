// Generation of the receivers' rays.
#include "cast/receiver_rays_funcs.cl"

// One work-item per eight rays of a receiver. receivers [receiver] -> rays [receiver][raysPerReceiver], cosine-weighted
// around the shading normal. A receiver's rays are a block of its sequence, in the order of sobolIndexInCell8: an
// aligned run of 8 or 16 rays fills a compact cone. Rays that dip below the triangle itself may hit it, because the
// surface hides that part of the hemisphere. Next: traceRays.
__kernel void generateRays(__constant const CastParameters* parameters, __global const Receiver* receivers,
                           __global Ray* rays) {
  const size_t i = get_global_id(0);
  const uint count = parameters->raysPerReceiver;
  if (i >= (size_t)parameters->receiverCount * (count / 8)) return;
  __global const Receiver* r = receivers + i / (count / 8);
  const uint8 cell = (uint)(i % (count / 8)) * 8 + (uint8)(0, 1, 2, 3, 4, 5, 6, 7);
  float8 u, v;
  sampleSobol8(sobolIndexInCell8(cell, 31 - clz(count), r->firstSample, r->seed), r->seed, &u, &v);
  const float near = parameters->nearLimit;
  storeReceiverRays(r, u, v, near, parameters->farLimit > 0.0f ? parameters->farLimit - near : MAXFLOAT, rays + i * 8);
}
