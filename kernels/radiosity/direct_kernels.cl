// Direct light of punctual lights, emissive triangles and the sky at points of elements. Every point sends one ray to
// each punctual light, then some to emissive triangles and to the sky: see DirectRays.
// Options: those of transport/light_funcs.cl; PRELIGHT_FEW_EMITTERS (all emitters are summed at every point).
#include "core/sampling_funcs.cl"
#include "core/shadow_share_funcs.cl"
#include "radiosity/direct_rays_funcs.cl"
#include "shared/cast_types.h"
#include "shared/radiosity_types.h"
#include "transport/open_emitter_funcs.cl"
#include "transport/scene_funcs.cl"
#include "transport/shadow_ray_funcs.cl"

// Number of terms that are summed in a run of their own. A million equal terms in one sum would be off by a hundredth.
#define PRELIGHT_SUM_RUN 1024u

#ifdef PRELIGHT_SKY
// Samples the sky with every other sample and the cosine with the rest; the balance heuristic combines both (Veach
// 1997). The density is that of all samples together.
PRELIGHT_INLINE bool sampleSkyOrCosine(Lights l, __constant const LightLayout* layout, uint sample, uint samples, uint2 bits,
                                       float3 normal, LightSample* a) {
  if ((sample & 1u) != 0u) {
    if (!sampleSky(l, layout, bits, a)) return false;
  } else {
    a->direction = sampleCosineHemisphere((float2)(unitFloat(bits.x), unitFloat(bits.y)), normal);
    a->distance = MAXFLOAT;
    a->surface = a->punctual = false;
  }
  const float2 uv = skyCoordinates(layout, a->direction);
  a->radiance = evalSky(l, layout, uv);
  a->pdf = (float)((samples + 1u) / 2u) * dot(a->direction, normal) * M_1_PI_F + (float)(samples / 2u) * pdfSky(l, layout, uv);
  return true;
}
#endif

// Samples the light of one ray of a receiver. The density is the sum over all of the receiver's rays of that kind (lamp,
// emitter or sky).
PRELIGHT_INLINE bool sampleDirect(DirectRays counts, Scene scene, __constant const LightLayout* layout, Receiver r, uint ray,
                                  LightSample* a) {
  bool arrives = false;
#ifdef PRELIGHT_PUNCTUAL
  if (ray < counts.punctual) {
    const uint2 place = sampleSobolBits(r.firstSample, hashInteger(r.seed ^ hashInteger(ray + 0x5bd1e995u)));
    arrives = samplePunctual(scene.lights, ray, vload3(0, r.position), (float2)(unitFloat(place.x), unitFloat(place.y)), a);
  }
#endif
#ifdef PRELIGHT_EMITTERS
  if (ray >= counts.punctual && ray < counts.punctual + counts.emitterSamples) {
    const uint index = r.firstSample * counts.emitterSamples + ray - counts.punctual;
    const uint2 choice = sampleSobolBits(index, hashInteger(r.seed ^ 0x68bc21ebu));
    const uint2 place = samplePaddedBits(index, hashInteger(r.seed ^ 0x02e5be93u));
    arrives = sampleEmitter(scene.lights, layout, scene.surface, vload3(0, r.position), choice.x,
                            (float2)(unitFloat(place.x), unitFloat(place.y)), a);
    if (arrives) a->pdf *= (float)counts.emitterSamples;
  }
#endif
#ifdef PRELIGHT_SKY
  if (ray >= counts.punctual + counts.emitterSamples) {
    const uint sample = ray - counts.punctual - counts.emitterSamples;
    const uint count = (sample & 1u) != 0u ? counts.skySamples / 2u : (counts.skySamples + 1u) / 2u;
    const uint2 bits = sampleSobolBits(r.firstSample * count + sample / 2u,
                                       hashInteger(r.seed ^ (0x967a889bu + (sample & 1u))));
    arrives = sampleSkyOrCosine(scene.lights, layout, sample, counts.skySamples, bits, vload3(0, r.normal), a);
  }
#endif
  return arrives;
}

// One work-item per shadow ray. receivers [point] -> rays [point][ray]; values [point][ray][3], the light that each
// brings if unoccluded. A ray that cannot bring light has value 0 and is made to hit nothing. Next: traceShadows.
__kernel void aimAtLights(const DirectRays counts, __global const Receiver* receivers,
                          __constant const SceneLayout* layout, __global const SurfaceLine* surfaceLines,
                          __global const ShadingLine* shadingLines, __global const LightLine* lightLines,
                          __global Ray* rays, __global float* values) {
  const uint rayCount = raysOf(counts);
  const size_t i = get_global_id(0);
  if (i >= (size_t)counts.points * rayCount) return;
  __global const Receiver* r = receivers + i / rayCount;
  const Scene scene = sceneOf(layout, surfaceLines, shadingLines, lightLines);
  LightSample a;
  float cosine = 0.0f;
  if (sampleDirect(counts, scene, &layout->lights, *r, (uint)(i % rayCount), &a))
    cosine = dot(a.direction, vload3(0, r->normal));
  const float3 value = cosine > 0.0f ? a.radiance * (cosine / a.pdf) : (float3)(0.0f);
  rays[i] = shadowRay(r, a, largest(value) > 0.0f);
  vstore3(value, i, values);
}

// One work-item per point. hits, values [point][ray] of the rays above -> irradiance [point][2], rgb: of punctual
// lights and the sky, and of emitters. With few emitters, their unoccluded light is computed exactly, and the samples
// only determine the share of it that arrives.
__kernel void sumLights(const DirectRays counts, __constant const SceneLayout* layout,
                        __global const SurfaceLine* surfaceLines, __global const ShadingLine* shadingLines,
                        __global const LightLine* lightLines, __global const Receiver* receivers,
                        __global const Hit* hits, __global const float* values, __global float4* irradiance) {
  const size_t point = get_global_id(0);
  if (point >= counts.points) return;
  const uint rayCount = raysOf(counts);
  float3 sum = (float3)(0.0f), run = (float3)(0.0f), open = (float3)(0.0f), all = (float3)(0.0f);
  for (uint s = 0; s < rayCount; ++s) {
    const size_t at = point * rayCount + s;
    const float3 value = vload3(at, values);
    const bool emitter = s >= counts.punctual && s < counts.punctual + counts.emitterSamples;
    const float3 arrives = lightArrives(hits[at]) ? shadowShare(hits[at]) * value : (float3)(0.0f);
    if (emitter) {
      open += arrives;
      all += value;
    } else {
      run += arrives;
    }
    if ((s + 1u) % PRELIGHT_SUM_RUN != 0u) continue;
    sum += run;
    run = (float3)(0.0f);
  }
  sum += run;
#ifdef PRELIGHT_FEW_EMITTERS
  if (all.x + all.y + all.z > 0.0f) {
    const Scene scene = sceneOf(layout, surfaceLines, shadingLines, lightLines);
    const Receiver r = receivers[point];
    const float3 exact = openIrradiance(scene.lights, allEmitters(&layout->lights), scene.surface,
                                        vload3(0, r.position), vload3(0, r.normal));
    open = exact * (open / fmax(all, 1e-30f));
  } else {
    open = (float3)(0.0f);
  }
#endif
  irradiance[2 * point] = (float4)(sum, 0.0f);
  irradiance[2 * point + 1] = (float4)(open, 0.0f);
}
