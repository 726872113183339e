// Paths of a camera that end where they meet light which was computed beforehand. All that a path does at a surface is one
// kernel: most of the time goes into finding out what the surface is like.
//   generatePaths -> [trace -> followPaths -> trace -> addArrivals] ... -> averageSamples
// Options: those of the included files, PRELIGHT_CACHED_CAUSTICS (there are caustic photons).
#include "gather/irradiance_map_funcs.cl"
#ifdef PRELIGHT_CACHED_CAUSTICS
#include "photon/density_funcs.cl"
#endif
#include "reference/path_ends_kernels.cl"
#include "reference/path_point_funcs.cl"
#include "transport/irradiance_funcs.cl"

// A ray a work-item. Caustics are smooth over a pixel, as their filter is wider, and cost most: of a pixel's samples that meet
// a surface straight, causticSamples look them up for all. Glass and mirrors send a pixel's samples to places far apart.
// corners, irradiances: of an IrradianceMap of indirect light; the density arguments are the members of DensityMaps,
// causticRadius the largest radius of their estimate. meets: 0: emission alone counts at this vertex; goesOn: 0: no ray
// leaves it. -> shadowRays, items [counters[0]]; nextRays, nextQueue [counters[1]].
__kernel void followPaths(__constant const ReferenceParameters* p, const uint count, const uint depth, const uint meets,
                          const uint goesOn, __global const Ray* rays, __global const Hit* hits,
                          __global const uint* queue, __global PathState* paths, __global Ray* shadowRays,
                          __global ShadowItem* items, __global Ray* nextRays, __global uint* nextQueue,
                          __global uint* counters, __global const DeviceTriangle* triangles,
                          __global const DeviceMaterial* bases, __global const float2* texCoords,
                          __global const float4* colors, __global const ushort4* texels,
                          __global const float* vertices, __global const uchar* flat,
                          __global const ShadeMaterial* materials, __global const DeviceMaterial* layers,
                          __global const ushort4* layerTexels, __global const uint* tables,
                          __global const uint* emitters, __global const float* emitterDensities,
                          __global const PunctualLight* punctual, __global const float4* sky,
                          __global const float2* corners, __global const float4* irradiances, const uint mapWidth,
                          const uint mapHeight, const uint triangleCount
#ifdef PRELIGHT_CACHED_CAUSTICS
                          ,
                          __constant const DensityParameters* densityParameters, __global const LeafTree* photonTrees,
                          __global const float* photonBoxes, __global const PhotonBlock* photonBlocks,
                          __global const SurfacePlace* places, __global const LeafTree* areaTrees,
                          __global const AreaNode* areaNodes, __global const AreaTriangle* areaTriangles,
                          const float causticRadius, const uint samples, const uint causticSamples
#endif
) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const PathScene s = {{triangles, bases, texCoords, colors, texels}, vertices, flat, materials, layers, layerTexels};
  const Lights lights = {tables, emitters, emitterDensities, punctual, sky};
  const Ray ray = rays[i];
  const Hit hit = hits[i];
  const uint number = queue[i];
  PathState path = paths[number];
  Interaction surface;
  if (hit.triangle != PRELIGHT_NO_TRIANGLE) surface = loadInteraction(s, ray, hit);
  collectAt(p, depth, s, lights, ray, hit, surface, &path);
  // A ray of a diffuse lobe looks for lights alone.
  if (hit.triangle != PRELIGHT_NO_TRIANGLE && meets != 0u && path.diffuseBounces == 0u) {
    const PathPoint at = pathPointAt(s, surface, number);
    if (isDiffuse(at.bsdf)) {
      const IrradianceMap map = {corners, irradiances, (int2)((int)mapWidth, (int)mapHeight), triangleCount};
      float3 irradiance = irradianceAt(map, hit.triangle, surface.front, hit.u, hit.v);
#ifdef PRELIGHT_TRANSLUCENT
      float3 beyond = irradianceAt(map, hit.triangle, !surface.front, hit.u, hit.v);
#endif
#ifdef PRELIGHT_CACHED_CAUSTICS
      const DensityMaps maps = {densityParameters, photonTrees, photonBoxes, photonBlocks,
                                places, areaTrees, areaNodes, areaTriangles};
      const bool shared = depth == 0u;
      if (!shared || number % samples < causticSamples) {
        const float share = shared ? (float)samples / (float)causticSamples : 1.0f;
        irradiance += photonIrradiance(maps, surface.position, surface.geometric, hit.triangle, causticRadius) * share;
#ifdef PRELIGHT_TRANSLUCENT
        if (largest(at.bsdf.transmitted) > 0.0f)
          beyond += photonIrradiance(maps, surface.position, -surface.geometric, hit.triangle, causticRadius) * share;
#endif
      }
#endif
      float3 radiance = reflectIrradiance(at.bsdf, surface.woLocal.z, irradiance);
#ifdef PRELIGHT_TRANSLUCENT
      radiance += transmitIrradiance(at.bsdf, surface.woLocal.z, beyond);
#endif
      vstore3(vload3(0, path.radiance) + vload3(0, path.throughput) * radiance, 0, path.radiance);
    }
    Ray shadow;
    ShadowItem item;
    if (p->lights.groupCount > 0u && sampleLightAt(p, depth, s, lights, at, path, PRELIGHT_NO_TRIANGLE, &shadow, &item)) {
      const uint slot = atomic_inc(counters);
      shadowRays[slot] = shadow;
      items[slot] = item;
    }
    Ray next;
    if (goesOn != 0u && scatterAt(p, depth, at, &path, &next)) {
      const uint slot = atomic_inc(counters + 1);
      nextRays[slot] = next;
      nextQueue[slot] = number;
    }
  }
  paths[number] = path;
}
