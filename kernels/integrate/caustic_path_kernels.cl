// Caustics of punctual lights, which no camera path finds by chance. Photons that mirrors and smooth glass have
// scattered are stored on the surface, and paths look them up where they meet it, between collectRadiance and
// sampleLights of integrate/path_kernels.cl.
// [1] Knaus and Zwicker 2011, "Progressive Photon Mapping: A Probabilistic Approach": the radius shrinks from pass to pass.
// Options: those of the included files.
#include "core/octahedral_funcs.cl"
#include "integrate/path_parts_funcs.cl"
#include "integrate/path_point_funcs.cl"
#include "photon/density_funcs.cl"
#include "transport/scene_funcs.cl"

// Photon light that a surface reflects or transmits along a path's ray, estimated within the full radius and within the
// radius of half the disc area.
typedef struct PhotonLight {
  float3 within;
  float3 closer;
} PhotonLight;

// Returns the radiance along the path's ray for a photon of 1 W that lands on 1 m2.
PRELIGHT_INLINE float3 scatteredPhoton(PathPoint at, float3 from) {
  const float facing = fabs(dot(from, at.surface.geometric));
  Scattered f;
  if (facing < 1e-4f || !evalBsdf(at.surface, at.bsdf, from, PRELIGHT_RADIANCE, &f)) return (float3)(0.0f);
  return (f.diffuse + f.glossy) / facing;
}

PRELIGHT_INLINE PhotonLight photonLight(const DensityMaps maps, PathPoint at, float3 side, float radius) {
  PhotonLight light = {(float3)(0.0f), (float3)(0.0f)};
  const DensityPlace place = findDensityPlace(maps, at.surface.position, side, at.surface.triangle, PRELIGHT_WHOLE_REGION);
  if (place.photons.count == 0u) return light;
  const float r2 = radius * radius;
  for (uint leaf = photonLeafFrom(maps, place, 1u, r2); leaf > 0u; leaf = photonLeafAfter(maps, place, leaf, r2)) {
    __global const PhotonBlock* block = photonBlockOf(maps, place, leaf);
    float within[8], closer[8];
    vstore8(photonWeights(maps, place, block, r2), 0, within);
    vstore8(photonWeights(maps, place, block, 0.5f * r2), 0, closer);
    for (uint i = 0; i < 8; ++i) {
      if (!(within[i] > 0.0f)) continue;
      const float3 power = (float3)(block->red[i], block->green[i], block->blue[i]);
      const float3 scattered = power * scatteredPhoton(at, unpackDirection(block->direction[i]));
      light.within += within[i] * scattered;
      light.closer += closer[i] * scattered;
    }
  }
  if (!(largest(light.within) > 0.0f)) return light;
  light.within /= fmax(densityArea(maps, place, radius), PRELIGHT_LEAST_AREA * r2);
  light.closer /= fmax(densityArea(maps, place, radius * M_SQRT1_2_F), 0.5f * PRELIGHT_LEAST_AREA * r2);
  return light;
}

// One work-item per ray. maps: photon maps of the pass; radius in m. Adds photon light to the paths' radiance, and to
// blurs [path] the bias that the radius is likely to cause in it. The bias is proportional to the radius squared, so it
// is twice the difference between the full disc and half the disc.
__kernel void addPhotonLight(__constant const ReferenceParameters* p, const PathStep step,
                             __global const SurfaceLine* surfaceLines, __global const ShadingLine* shadingLines,
                             __constant const DensityParameters* density, __global const DensityLine* maps, const float radius,
                             __global const Ray* rays, __global const Hit* hits, __global const uint* numbers,
                             __global PathState* paths, __global float* blurs) {
  const size_t i = get_global_id(0);
  if (i >= step.count || hits[i].triangle == PRELIGHT_NO_TRIANGLE) return;
  const uint number = numbers[i];
  const PathState path = paths[number];
  // Counts the camera's segment and the fewest that a caustic has: from the light to a mirror and from there to the
  // surface.
  if (segmentsBefore(step.depth, path) + 3u > p->mostSegments) return;
  const PathScene s = shadedSurfaceOf(&p->scene, surfaceLines, shadingLines);
  const PathPoint at = dispersedAt(p, s, pathPointAt(s, loadInteraction(s, rays[i], hits[i]), number), path);
  if (!isDiffuse(at.bsdf) && !isGlossy(at.bsdf)) return;
  const DensityMaps photons = densityMapsOf(density, maps);
  PhotonLight light = photonLight(photons, at, at.surface.geometric, radius);
#if defined(PRELIGHT_TRANSLUCENT) || defined(PRELIGHT_ROUGH_GLASS)
  const PhotonLight beyond = photonLight(photons, at, -at.surface.geometric, radius);
  light.within += beyond.within;
  light.closer += beyond.closer;
#endif
  const float3 throughput = vload3(0, path.throughput);
  const float3 blur = 2.0f * throughput * (light.within - light.closer), caustic = throughput * light.within;
  vstore3(vload3(0, path.radiance) + caustic, 0, paths[number].radiance);
  if (keepsParts(p)) {
    const uint part = partOfArriving(partsOf(p->parts, paths, number)->way, PRELIGHT_PART_CAUSTIC);
    keepPart(p->parts, paths, number, part, caustic);
  }
  blurs[number] += dot(blur, (float3)(0.2126f, 0.7152f, 0.0722f));
}

// One work-item per pixel of the block. blurs [pixel][samplesPerPass] -> the w of means [pixel] of averageSamples.
__kernel void averageBlurs(__constant const ReferenceParameters* p, __global const float* blurs, __global float4* means) {
  const size_t i = get_global_id(0);
  const uint n = p->samplesPerPass;
  if (i >= p->pathCount / n) return;
  float sum = 0.0f;
  for (uint k = 0; k < n; ++k) sum += blurs[i * n + k];
  means[i].w = sum / (float)n;
}
