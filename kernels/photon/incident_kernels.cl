// Irradiance from photon maps by the directions from which photons came. Before: photons sorted into maps
// (host/photon/photon_maps). After: light maps of surfaces with normal maps.
#include "core/octahedral_funcs.cl"
#include "photon/density_funcs.cl"
#include "project/incident_funcs.cl"

// Least cosine at which photons count as landing: grazing photons say little about the radiance.
#define PRELIGHT_LEAST_PHOTON_COSINE 0.05f

// Sums power as gatherPower does, but by direction: sums [value], W.
void gatherIncident(const DensityMaps maps, const DensityPlace place, float3 normal, float r2, float3* sums) {
  for (uint leaf = photonLeafFrom(maps, place, 1u, r2); leaf > 0u; leaf = photonLeafAfter(maps, place, leaf, r2)) {
    __global const PhotonBlock* block = photonBlockOf(maps, place, leaf);
    float weights[8];
    vstore8(photonWeights(maps, place, block, r2), 0, weights);
    for (uint i = 0; i < 8; ++i) {
      if (!(weights[i] > 0.0f)) continue;
      const float3 power = (float3)(block->red[i], block->green[i], block->blue[i]);
      const float3 direction = unpackDirection(block->direction[i]);
      addIncident(weights[i] * power, direction, 1.0f / fmax(dot(direction, normal), PRELIGHT_LEAST_PHOTON_COSINE), sums);
    }
  }
}

// One work-item per query. queries [query] -> incident [query][3][value]: irradiance, W/m2, and incident radiance in SH.
__kernel void estimateIncident(__constant const DensityParameters* parameters, __global const DensityLine* lines,
                               __global const DensityQuery* queries, __global float* incident) {
  const size_t i = get_global_id(0);
  if (i >= parameters->queryCount) return;
  const DensityMaps maps = densityMapsOf(parameters, lines);
  const float3 side = normalize(vload3(0, queries[i].normal));
  const DensityPlace place = findDensityPlace(maps, vload3(0, queries[i].position), side, queries[i].triangle, queries[i].patch);
  float3 sums[PRELIGHT_INCIDENT_VALUES];
  for (uint k = 0; k < PRELIGHT_INCIDENT_VALUES; ++k) sums[k] = (float3)(0.0f);
  float area = 1.0f;
  if (place.photons.count > 0u) {
    const float r2 = densityReach(maps, place, queries[i].radius);
    gatherIncident(maps, place, side, r2, sums);
    if (sums[0].x > 0.0f || sums[0].y > 0.0f || sums[0].z > 0.0f)
      area = fmax(densityArea(maps, place, sqrt(r2)), PRELIGHT_LEAST_AREA * r2);
  }
  storeIncident(sums, 1.0f / area, incident + 3u * PRELIGHT_INCIDENT_VALUES * i);
}
