// Russian roulette for photons that contribute little to a picture (Vorba and Krivanek 2016, after Peter and Pietrek
// 1998).
//   scatterPhotons -> endUnimportant -> [marked photons are listed and moved]
#include "core/vector_funcs.cl"
#include "photon/path_funcs.cl"
#include "shared/ray_types.h"
#include "transport/roulette_funcs.cl"

// Coordinate pair of this roulette's random numbers, beyond those of all surfaces.
#define PRELIGHT_PAIR_IMPORTANCE 0x40000u

float importanceAt(ImportanceGrid grid, __global const float* values, float3 position) {
  const float3 at = (position - vload3(0, grid.lower)) * grid.cellsPerMetre;
  const int3 cell = clamp(convert_int3(at), 0, (int)grid.side - 1);
  return values[((size_t)cell.z * grid.side + cell.y) * grid.side + cell.x];
}

// One work-item per photon that scatterPhotons has processed. rays and hits [count], queue [count]; least [z][y][x], W:
// photons that carry less survive by chance, and then carry that much -> outcomes without PRELIGHT_PHOTON_GOES_ON where
// photons end, and the updated paths and tallies.
__kernel void endUnimportant(__constant const PhotonParameters* p, const PhotonStep step, const ImportanceGrid grid,
                             __global const float* least, __global const Ray* rays, __global const Hit* hits,
                             __global const uint* queue, __global PhotonPath* paths, __global uchar* outcomes,
                             __global long* tallies) {
  const size_t i = get_global_id(0);
  if (i >= step.count || (outcomes[i] & PRELIGHT_PHOTON_GOES_ON) == 0u) return;
  PhotonPath path = paths[queue[i]];
  const float3 position = vload3(0, rays[i].origin) + hits[i].t * vload3(0, rays[i].direction);
  const float3 before = vload3(0, path.power);
  float3 power = before;
  const float survival = fmin(largest(before) / importanceAt(grid, least, position), 1.0f);
  const float chance = photonPoint(p, path.photon, PRELIGHT_PAIR_IMPORTANCE + step.depth).x;
  if (!survives(survival, chance, &power)) {
    outcomes[i] &= (uchar)~PRELIGHT_PHOTON_GOES_ON;
    power = (float3)(0.0f);
  }
  vstore3(power, 0, path.power);
  paths[queue[i]] = path;
  const float change[3] = {before.x, before.y, before.z}, now[3] = {power.x, power.y, power.z};
  for (uint c = 0; c < 3; ++c) tallies[6 * i + c] += countsOf(p, change[c]) - countsOf(p, now[c]);
}
