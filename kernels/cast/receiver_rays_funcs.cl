// Rays of a receiver from points of the unit square.
#ifndef PRELIGHT_CAST_RECEIVER_RAYS_FUNCS_CL
#define PRELIGHT_CAST_RECEIVER_RAYS_FUNCS_CL

#include "core/sampling_block_funcs.cl"
#include "shared/cast_types.h"
#include "shared/ray_types.h"

// Stores eight rays along the directions to which points (u, v) of the square are mapped: cosine-weighted around the
// shading normal when the points are uniform. The rays begin `near` from the receiver and end `reach` farther on, both
// in m.
void storeReceiverRays(__global const Receiver* r, float8 u, float8 v, float near, float reach, __global Ray* rays) {
  float8 x, y, squaredRadius;
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

#endif
