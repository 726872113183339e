// Light that was computed beforehand, added where a camera's path meets the surface.
// Options: those of the included files, PRELIGHT_CACHED_CAUSTICS (there are caustic photons).
#include "gather/irradiance_map_funcs.cl"
#include "shade/diffuse_funcs.cl"
#include "shade/vertex_funcs.cl"
#include "shared/reference_types.h"
#ifdef PRELIGHT_CACHED_CAUSTICS
#include "photon/density_funcs.cl"
#endif

// Caustics are smooth over a pixel, as their filter is wider, and cost most: of a pixel's samples, paths of causticSamples
// look them up for all.
//
// A ray a work-item, after collectRadiance. corners, irradiances: of an IrradianceMap of indirect light; the density
// arguments are the members of DensityMaps, causticRadius the largest radius of their estimate.
__kernel void addCachedLight(const uint count, __global const Ray* rays, __global const Hit* hits,
                             __global const uint* queue, __global PathState* paths,
                             __global const DeviceTriangle* triangles, __global const DeviceMaterial* bases,
                             __global const float2* texCoords, __global const float4* colors,
                             __global const ushort4* texels, __global const float* vertices,
                             __global const uchar* flat, __global const ShadeMaterial* materials,
                             __global const DeviceMaterial* layers, __global const ushort4* layerTexels,
                             __global const float2* corners, __global const float4* irradiances, const uint mapWidth,
                             const uint mapHeight, const uint triangleCount
#ifdef PRELIGHT_CACHED_CAUSTICS
                             ,
                             __constant const DensityParameters* densityParameters,
                             __global const LeafTree* photonTrees, __global const float* photonBoxes,
                             __global const PhotonBlock* photonBlocks, __global const SurfacePlace* places,
                             __global const LeafTree* areaTrees, __global const AreaNode* areaNodes,
                             __global const AreaTriangle* areaTriangles, const float causticRadius,
                             const uint samples, const uint causticSamples
#endif
) {
  const size_t i = get_global_id(0);
  if (i >= count || hits[i].triangle == PRELIGHT_NO_TRIANGLE) return;
  if (paths[queue[i]].diffuseBounces > 0u) return;  // it looks for lights alone
  const PathScene s = {{triangles, bases, texCoords, colors, texels}, vertices, flat, materials, layers, layerTexels};
  const IrradianceMap map = {corners, irradiances, (int2)((int)mapWidth, (int)mapHeight), triangleCount};
  const Hit hit = hits[i];
  const PathVertex vertex = loadVertex(s, rays[i], hit);
  const Bsdf bsdf = loadBsdf(s, vertex);
  if (!(largest(bsdf.diffuse) > 0.0f)) return;
  float3 irradiance = irradianceAt(map, hit.triangle, vertex.front, hit.u, hit.v);
#ifdef PRELIGHT_CACHED_CAUSTICS
  const DensityMaps maps = {densityParameters, photonTrees, photonBoxes, photonBlocks,
                            places, areaTrees, areaNodes, areaTriangles};
  if (queue[i] % samples < causticSamples)
    irradiance += photonIrradiance(maps, vertex.position, vertex.geometric, hit.triangle, causticRadius) *
                  ((float)samples / (float)causticSamples);
#endif
  __global PathState* path = paths + queue[i];
  const float3 radiance = reflectIrradiance(bsdf, dot(vertex.wo, vertex.shading), irradiance);
  vstore3(vload3(0, path->radiance) + vload3(0, path->throughput) * radiance, 0, path->radiance);
}
