// Kernels that evaluate scattering and sampling of light, for tests.
// Options: those of the included files; PRELIGHT_PROBE_IMPORTANCE: importance instead of radiance; PRELIGHT_PROBE_BENT: the
// triangle's normal differs from the shading normal.
#include "transport/light_funcs.cl"

// values: diffuse 3, metal 3, its share, f0 3, f90, share of the layer, roughness, transmitted 3, normal of the triangle 3;
// with PRELIGHT_ROUGH_GLASS also share of glass, whether it is solid, index of refraction beyond over that here (its
// table follows the other);
// with PRELIGHT_LAYERS also (from 22 on) coat, its roughness, its normal 3, colour of sheen, its roughness;
// with PRELIGHT_ANISOTROPY also (29) the width along the frame's x; with PRELIGHT_FILM (30 on) the film's share, index of
// refraction, thickness in nm, entry of its table; with PRELIGHT_MEASURED (34 on) the entry of its table, in which it lies as
// floats, and the chance with which it is sampled by the cosine;
// albedos: see transport/albedo_table_funcs.cl.
Bsdf probeBsdf(__constant const float* values, __global const float4* albedos) {
  Bsdf b;
  b.diffuse = vload3(0, values);
  b.roughness = values[12];
  b.alpha = b.roughness * b.roughness;
  b.smooth = false;
  b.albedos = albedos;
  b.glass = 0.0f;
  b.tint = (float3)(1.0f);
  b.ior = 1.5f;
#ifdef PRELIGHT_ROUGH_GLASS
  b.glass = values[19];
  b.solid = values[20] > 0.5f;
  b.ior = b.eta = values[21];
  b.inside = b.eta < 1.0f;
  b.glassTable = PRELIGHT_ANISOTROPIC_END;
#endif
#ifdef PRELIGHT_LAYERS
  b.coat = values[22];
  b.coatRoughness = values[23];
  b.coatSmooth = b.coatRoughness < PRELIGHT_SMOOTH_BELOW;
  b.coatNormal = normalize(vload3(0, values + 24));
  b.sheen = (float3)(values[27]);
  b.sheenRoughness = fmax(values[28], PRELIGHT_LEAST_SHEEN_ROUGHNESS);
  b.sheenAlpha = b.sheenRoughness * b.sheenRoughness;
#endif
#ifdef PRELIGHT_TRANSLUCENT
  b.transmitted = vload3(0, values + 13);
#endif
#ifdef PRELIGHT_ANISOTROPY
  b.alphas = (float2)(values[29], b.alpha);
#endif
#ifdef PRELIGHT_FILM
  b.film.share = values[30];
  b.film.outside = 1.0f;
  b.film.ior = values[31];
  b.film.thickness = values[32];
  b.film.relative = 1.0f;
  b.film.table = (uint)values[33];
#endif
#ifdef PRELIGHT_MEASURED
  b.measured = (__global const float*)(albedos + (uint)values[34]);
  b.measuredShare = values[35];
#endif
#ifdef PRELIGHT_COLORED_GLASS
  b.glassF0 = vload3(0, values + 7);
  b.glassF90 = values[10];
#endif
  setReflectance(vload3(0, values + 3), values[6], vload3(0, values + 7), values[10], values[11], &b);
  return b;
}

#ifdef PRELIGHT_PROBE_IMPORTANCE
#define PRELIGHT_PROBE_MODE PRELIGHT_IMPORTANCE
#else
#define PRELIGHT_PROBE_MODE PRELIGHT_RADIANCE
#endif

// Returns the interaction of light from wo with a surface whose shading frame is that of the axes.
Interaction probeInteraction(__constant const float* values, float3 wo) {
  Interaction i;
  i.frame.x = (float3)(1.0f, 0.0f, 0.0f);
  i.frame.y = (float3)(0.0f, 1.0f, 0.0f);
  i.frame.z = (float3)(0.0f, 0.0f, 1.0f);
#ifdef PRELIGHT_PROBE_BENT
  i.geometric = vload3(0, values + 16);
#else
  i.geometric = i.frame.z;
#endif
  i.wo = wo;
  i.woLocal = toFrame(i.frame, wo);
  i.front = true;
  i.flags = 0u;
  return i;
}

// One work-item per pair of directions. wo, wi [pair] (w unused) -> reflections [pair][2]: diffuse and glossy part, 0 if no
// light can go there; densities [pair] of sampling wi.
__kernel void probeReflection(__constant const float* values, __global const float4* albedos, const uint count, __global const float4* wo,
                              __global const float4* wi, __global float4* reflections, __global float* densities) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const Bsdf b = probeBsdf(values, albedos);
  const Interaction surface = probeInteraction(values, wo[i].xyz);
  Scattered f = {(float3)(0.0f), (float3)(0.0f)};
  evalBsdf(surface, b, wi[i].xyz, PRELIGHT_PROBE_MODE, &f);
  reflections[2 * i] = (float4)(f.diffuse, 0.0f);
  reflections[2 * i + 1] = (float4)(f.glossy, 0.0f);
  densities[i] = pdfBsdf(surface, b, wi[i].xyz, PRELIGHT_LOBES_ALL);
}

// One work-item per sample -> samples [sample][2]: direction sampled from wo[0] with its density in w, and its weight. All
// are 0 if no light goes on.
__kernel void probeScatter(__constant const float* values, __global const float4* albedos, const uint count, __global const float4* wo,
                           __global float4* samples) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const Bsdf b = probeBsdf(values, albedos);
  const uint2 choice = samplePaddedBits((uint)i, 17u), place = samplePaddedBits((uint)i, 23u);
  const float2 u = (float2)(unitFloat(place.x), unitFloat(place.y));
  BsdfSample sample;
  const bool goesOn = sampleBsdf(probeInteraction(values, wo[0].xyz), b, PRELIGHT_LOBES_ALL, PRELIGHT_PROBE_MODE,
                                 unitFloat(choice.x), u, &sample);
  samples[2 * i] = goesOn ? (float4)(sample.direction, sample.pdf) : (float4)(0.0f);
  samples[2 * i + 1] = goesOn ? (float4)(carriedBy(sample, (float3)(1.0f)), 0.0f) : (float4)(0.0f);
}

#ifdef PRELIGHT_SKY
// One work-item per sample: directions [sample] sampled from the sky, w: their density; lookups [sample]: radiance and, in
// w, density that a ray in this direction finds.
__kernel void probeSky(__constant const LightLayout* p, const uint count, __global const uint* tables,
                       __global const float4* sky, __global float4* directions, __global float4* lookups) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const Lights lights = {tables, 0, 0, 0, sky};
  LightSample a;
  sampleSky(lights, p, samplePaddedBits((uint)i, 29u), &a);
  directions[i] = (float4)(a.direction, a.pdf);
  const float2 uv = skyCoordinates(p, a.direction);
  lookups[i] = (float4)(evalSky(lights, p, uv), pdfSky(lights, p, uv));
}
#endif
