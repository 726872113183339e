// The reference renderer's samplers and densities one by one, for tests.
// Options: those of the included files.
#include "shade/light_funcs.cl"

// values: diffuse 3, metal 3, f0 3, f90, layer, alpha, transmitted 3.
Bsdf probeBsdf(__constant const float* values) {
  Bsdf b;
  b.diffuse = vload3(0, values);
  b.metal = vload3(0, values + 3);
  b.f0 = vload3(0, values + 6);
  b.f90 = values[9];
  b.layer = values[10];
  b.alpha = values[11];
  b.glass = 0.0f;
  b.tint = (float3)(1.0f);
  b.ior = 1.5f;
  b.smooth = false;
#ifdef PRELIGHT_TRANSLUCENT
  b.transmitted = vload3(0, values + 12);
#endif
  return b;
}

// A direction pair a work-item. wo, wi [pair] (w unused) -> reflections [pair][2] diffuse and glossy part,
// densities [pair] of wi as scattering draws it.
__kernel void probeReflection(__constant const float* values, const uint count, __global const float4* wo,
                              __global const float4* wi, __global float4* reflections, __global float* densities) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const Bsdf b = probeBsdf(values);
  const Reflection r = evaluateBsdf(b, wo[i].xyz, wi[i].xyz);
  reflections[2 * i] = (float4)(r.diffuse, 0.0f);
  reflections[2 * i + 1] = (float4)(r.glossy, 0.0f);
  densities[i] = scatterDensity(b, chooseLobes(b, wo[i].z, true, true), wo[i].xyz, wi[i].xyz);
}

// A sample a work-item: directions [sample] as scattering draws them from wo[0].
__kernel void probeScatter(__constant const float* values, const uint count, __global const float4* wo,
                           __global float4* directions) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const Bsdf b = probeBsdf(values);
  const LobeChoice lobes = chooseLobes(b, wo[0].z, true, true);
  const uint2 choice = samplePaddedBits((uint)i, 17u), place = samplePaddedBits((uint)i, 23u);
  float pick = unitFloat(choice.x);
  const bool through = picksTransmitted(lobes, &pick);
  float3 direction = sampleLobe(b, pick >= lobes.diffuse, (float2)(unitFloat(place.x), unitFloat(place.y)), wo[0].xyz);
  if (through) direction.z = -direction.z;
  directions[i] = (float4)(direction, 0.0f);
}

#ifdef PRELIGHT_SKY
// A sample a work-item: directions [sample] drawn from the sky, w: their density; lookups [sample] radiance and, in w,
// density that a ray of this direction finds.
__kernel void probeSky(__constant const LightLayout* p, const uint count, __global const uint* tables,
                       __global const float4* sky, __global float4* directions, __global float4* lookups) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const Lights lights = {tables, 0, 0, 0, sky};
  Arrival a;
  arriveFromSky(lights, p, samplePaddedBits((uint)i, 29u), &a);
  directions[i] = (float4)(a.direction, a.density);
  const float2 uv = skyCoordinates(p, a.direction);
  lookups[i] = (float4)(skyRadiance(lights, p, uv), skyDensity(lights, p, uv));
}
#endif
