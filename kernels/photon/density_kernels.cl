// Irradiance from photon maps. Before: photons sorted into maps (host/photon/photon_maps). After: light maps, pictures.
#include "photon/density_funcs.cl"

// One work-item per query. queries [query] -> irradiance [query][3], W/m2.
__kernel void estimateIrradiance(__constant const DensityParameters* parameters, __global const DensityLine* lines,
                                 __global const DensityQuery* queries, __global float* irradiance) {
  const size_t i = get_global_id(0);
  if (i >= parameters->queryCount) return;
  const DensityMaps maps = densityMapsOf(parameters, lines);
  const float3 position = vload3(0, queries[i].position), side = vload3(0, queries[i].normal);
  vstore3(photonIrradiance(maps, position, side, queries[i].triangle, queries[i].patch, queries[i].radius), i, irradiance);
}
