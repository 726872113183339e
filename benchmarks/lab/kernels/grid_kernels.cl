// Photons in one uniform grid per map, sorted by cell: the baseline to which the trees of density_funcs.cl are
// compared. Supports planar regions and the Epanechnikov kernel only.
// PRELIGHT_DENSITY_NEAREST: k, or 0 for all photons within the radius.
#include "photon/density_funcs.cl"

// Photons of a map: its grid, the first photon of each cell of all grids, and the arrays x, y, z, red, green, blue
// [photon].
typedef struct GridPhotons {
  __global const PhotonGrid* grid;
  __global const uint* starts;
  __global const float* members[6];
} GridPhotons;

// Returns the squared distances from p of photons `first` to `first` + 7; infinite from `last` on.
float8 squaredInGrid(const GridPhotons* photons, uint first, uint last, float3 p) {
  const float8 dx = vload8(0, photons->members[0] + first) - p.x, dy = vload8(0, photons->members[1] + first) - p.y,
               dz = vload8(0, photons->members[2] + first) - p.z;
  const int8 inside = (int8)(0, 1, 2, 3, 4, 5, 6, 7) < (int8)((int)(last - first));
  return select((float8)(INFINITY), dx * dx + dy * dy + dz * dz, inside);
}

int3 cellOf(__global const PhotonGrid* grid, float3 p) {
  const float3 place = (p - vload3(0, grid->lower)) * grid->perCell;
  const int3 most = (int3)((int)grid->cells[0] - 1, (int)grid->cells[1] - 1, (int)grid->cells[2] - 1);
  return clamp(convert_int3_rtn(clamp(place, -1.0f, 1e9f)), (int3)(0), most);
}

uint rowStart(__global const PhotonGrid* grid, int y, int z) {
  return grid->firstCell + ((uint)z * grid->cells[1] + (uint)y) * grid->cells[0];
}

float3 gatherFromGrid(const GridPhotons* photons, float3 p, float r2) {
  __global const PhotonGrid* grid = photons->grid;
  __global const uint* starts = photons->starts;
  const float inverse = 1.0f / r2, r = sqrt(r2);
  const int3 low = cellOf(grid, p - r), high = cellOf(grid, p + r);
  float8 red = 0.0f, green = 0.0f, blue = 0.0f;
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y) {
      const uint row = rowStart(grid, y, z);
      const uint last = starts[row + (uint)high.x + 1u];
      for (uint i = starts[row + (uint)low.x]; i < last; i += 8u) {
        const float8 weights = kernelWeights(squaredInGrid(photons, i, last, p) * inverse);
        red += weights * vload8(0, photons->members[3] + i);
        green += weights * vload8(0, photons->members[4] + i);
        blue += weights * vload8(0, photons->members[5] + i);
      }
    }
  return (float3)(sumOf(red), sumOf(green), sumOf(blue));
}

#if PRELIGHT_DENSITY_NEAREST > 0
float visitCells(const GridPhotons* photons, uint cell, uint cellCount, float3 p, float* heap, uint* count, float limit) {
  const uint last = photons->starts[cell + cellCount];
  for (uint i = photons->starts[cell]; i < last; i += 8u) {
    const float8 squared = squaredInGrid(photons, i, last, p);
    if (!any(isless(squared, (float8)(limit)))) continue;
    float reaches[8];
    vstore8(squared, 0, reaches);
    for (uint lane = 0; lane < 8; ++lane) {
      if (!(reaches[lane] < limit)) continue;
      if (*count < PRELIGHT_DENSITY_NEAREST)
        appendToHeap(heap, (*count)++, reaches[lane]);
      else
        replaceRoot(heap, PRELIGHT_DENSITY_NEAREST, reaches[lane]);
      if (*count == PRELIGHT_DENSITY_NEAREST) limit = heap[0];
    }
  }
  return limit;
}

// Returns the squared radius of the k-th nearest photon, searching shell after shell of cells around p's.
float nearestInGrid(const GridPhotons* photons, float3 p, float limit) {
  __global const PhotonGrid* grid = photons->grid;
  float heap[PRELIGHT_DENSITY_NEAREST];
  uint count = 0u;
  const int3 centre = cellOf(grid, p);
  const int3 most = (int3)((int)grid->cells[0] - 1, (int)grid->cells[1] - 1, (int)grid->cells[2] - 1);
  const float3 place = (p - vload3(0, grid->lower)) * grid->perCell - convert_float3(centre);
  const float border = fmin(fmin(fmin(place.x, 1.0f - place.x), fmin(place.y, 1.0f - place.y)), fmin(place.z, 1.0f - place.z));
  for (int s = 0; s <= max(max(most.x, most.y), most.z); ++s) {
    const float reach = fmax((float)(s - 1) + border, 0.0f) / grid->perCell;
    if (s > 0 && reach * reach >= limit) break;
    const int3 low = max(centre - s, (int3)(0)), high = min(centre + s, most);
    for (int z = low.z; z <= high.z; ++z)
      for (int y = low.y; y <= high.y; ++y) {
        const uint row = rowStart(grid, y, z);
        if (abs(z - centre.z) == s || abs(y - centre.y) == s) {
          limit = visitCells(photons, row + (uint)low.x, (uint)(high.x - low.x) + 1u, p, heap, &count, limit);
          continue;
        }
        if (centre.x - s >= 0) limit = visitCells(photons, row + (uint)(centre.x - s), 1u, p, heap, &count, limit);
        if (centre.x + s <= most.x && s > 0)
          limit = visitCells(photons, row + (uint)(centre.x + s), 1u, p, heap, &count, limit);
      }
  }
  return limit;
}
#endif

// One work-item per query, as estimateIrradiance. The hint keeps Intel's compiler from joining work-items, which
// miscompiles the area of some. starts [cell of all grids + 1]; members [6][memberLength]: x .. blue [photon, padded by
// 8].
__kernel __attribute__((vec_type_hint(float8))) void estimateFromGrid(
    __constant const DensityParameters* parameters, __global const DensityLine* lines, __global const PhotonGrid* grids,
    __global const uint* starts, __global const float* members, const uint memberLength,
    __global const DensityQuery* queries, __global float* irradiance) {
  const size_t i = get_global_id(0);
  if (i >= parameters->queryCount) return;
  const DensityMaps maps = densityMapsOf(parameters, lines);
  const float3 position = vload3(0, queries[i].position);
  DensityPlace place = findDensityPlace(maps, position, (float3)(0.0f), queries[i].triangle, PRELIGHT_WHOLE_REGION);
  place.planar = true;
  GridPhotons photons = {grids + place.region, starts, {0, 0, 0, 0, 0, 0}};
  for (uint k = 0; k < 6u; ++k) photons.members[k] = members + (size_t)k * memberLength;
  float r2 = queries[i].radius * queries[i].radius;
#if PRELIGHT_DENSITY_NEAREST > 0
  __global const PhotonGrid* grid = photons.grid;
  if (starts[grid->firstCell + grid->cells[0] * grid->cells[1] * grid->cells[2]] - starts[grid->firstCell] >= PRELIGHT_DENSITY_NEAREST)
    r2 = nearestInGrid(&photons, position, r2);
#endif
  const float3 power = gatherFromGrid(&photons, position, r2);
  vstore3(power / fmax(densityArea(maps, place, sqrt(r2)), PRELIGHT_LEAST_AREA * r2), i, irradiance);
}
