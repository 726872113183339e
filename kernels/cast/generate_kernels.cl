// Receivers to rays.
#include "core/sampling_block_funcs.cl"
#include "shared/cast_types.h"
#include "shared/ray_types.h"

// Eight rays of a receiver a work-item. receivers [receiver] -> rays [receiver][raysPerReceiver], cosine-weighted around
// the shading normal. A receiver's rays are a block of its sequence, in the order of sobolIndexInCell8: an aligned run
// of 8 or 16 rays fills a compact cone. Rays that dip below the triangle itself may hit it: the surface hides that
// part of the hemisphere. Next: traceRays.
__kernel void generateRays(__constant const CastParameters* parameters, __global const Receiver* receivers,
                           __global Ray* rays) {
  const size_t i = get_global_id(0);
  const uint count = parameters->raysPerReceiver;
  if (i >= (size_t)parameters->receiverCount * (count / 8)) return;
  __global const Receiver* r = receivers + i / (count / 8);
  const uint8 cell = (uint)(i % (count / 8)) * 8 + (uint8)(0, 1, 2, 3, 4, 5, 6, 7);
  float8 u, v, x, y, squaredRadius;
  sampleSobol8(sobolIndexInCell8(cell, 31 - clz(count), r->firstSample, r->seed), r->seed, &u, &v);
  concentricDisc8(u, v, &x, &y, &squaredRadius);
  const float8 z = sqrt(1.0f - squaredRadius);

  const float3 n = vload3(0, r->normal);
  float3 tangent, bitangent;
  makeFrame(n, &tangent, &bitangent);
  const float8 dx = x * tangent.x + y * bitangent.x + z * n.x;
  const float8 dy = x * tangent.y + y * bitangent.y + z * n.y;
  const float8 dz = x * tangent.z + y * bitangent.z + z * n.z;
  const float8 above = dx * r->geometricNormal[0] + dy * r->geometricNormal[1] + dz * r->geometricNormal[2];
  const uint8 source =
      select((uint8)(PRELIGHT_NO_TRIANGLE), (uint8)(r->triangle), isgreater(above, (float8)(0.0f)));

  float directions[3][8];
  uint sources[8];
  vstore8(dx, 0, directions[0]);
  vstore8(dy, 0, directions[1]);
  vstore8(dz, 0, directions[2]);
  vstore8(source, 0, sources);
  const float3 origin = vload3(0, r->position);
  const float near = parameters->nearLimit;
  const float reach = parameters->farLimit > 0.0f ? parameters->farLimit - near : MAXFLOAT;
  rays += i * 8;
  for (int k = 0; k < 8; ++k) {
    Ray ray;
    ray.origin[0] = origin.x + near * directions[0][k];
    ray.origin[1] = origin.y + near * directions[1][k];
    ray.origin[2] = origin.z + near * directions[2][k];
    ray.sourceTriangle = sources[k];
    ray.direction[0] = directions[0][k];
    ray.direction[1] = directions[1][k];
    ray.direction[2] = directions[2][k];
    ray.tMax = reach;
    rays[k] = ray;
  }
}
