// Light that comes straight from punctual lights, emissive triangles and the sky to points of elements.
// Every point sends a ray to each punctual light, then some to emissive triangles and to the sky: DirectRays.
// Options: PRELIGHT_PUNCTUAL, PRELIGHT_SKY: the scene has such lights (transport/light_funcs.cl);
// PRELIGHT_RADIOSITY_EMITTERS: and emissive triangles; PRELIGHT_FEW_EMITTERS, when all of them are summed at every point.
#include "radiosity/direct_rays_funcs.cl"
#include "shared/cast_types.h"
#include "shared/radiosity_types.h"
#include "transport/aim_funcs.cl"
#include "transport/scene_funcs.cl"

// Terms of a sum that are added up by themselves. A million of one size in a row would be off by a hundredth.
#define PRELIGHT_SUM_RUN 1024u

// A triangle is far where it is this many times as far off as it is large: Lambert's formula loses digits with the square
// of that, as the parts of its edges cancel.
#define PRELIGHT_FAR_SIZES 32.0f

#ifdef PRELIGHT_RADIOSITY_EMITTERS
void loadCorners(uint triangle, Surface surface, __global const float* positions, float3 corner[3]) {
  const DeviceTriangle t = triangleAt(surface, triangle);
  for (int k = 0; k < 3; ++k) corner[k] = vload3(t.vertex[k], positions);
}

// A point of an emitter by area: an unbiased sample of the irradiance that all emitters would cause.
bool aimAtEmitter(Lights l, __constant const LightLayout* layout, __global const RadiosityEmitter* emitters,
                  Surface surface, __global const float* positions, uint bits, float2 place,
                  float samples, float3 point, float3 normal, Aim* aim) {
  float probability, remainder;
  const uint entry = chooseEntry(l.tables + layout->emitterTable, layout->emitterCount, bits, &probability, &remainder);
  const RadiosityEmitter e = emitters[entry];
  float3 corner[3];
  loadCorners(e.triangle, surface, positions, corner);
  const float3 p = pointBetween(corner[0], corner[1], corner[2], sampleTriangle(place));
  const float3 across = cross(corner[1] - corner[0], corner[2] - corner[0]);  // twice the area long
  const float3 way = p - point;
  const float squared = dot(way, way);
  if (!(squared > 1e-18f)) return false;
  const float cosine = dot(way, normal);
  const float facing = -dot(way, across);
  const float seen = e.twoSided != 0u ? fabs(facing) : facing;
  if (cosine <= 0.0f || seen <= 0.0f) return false;
  aim->way = way;
  aim->reach = PRELIGHT_SHADOW_REACH;
  aim->value = vload3(0, e.radiance) * (0.5f * cosine * seen / (squared * squared * probability * samples));
  return true;
}

// Integral of cosine / pi over the part of a triangle above the horizon of (point, normal): Lambert's formula, edge by
// edge of the clipped polygon. Positive, whichever way the triangle is wound.
float triangleFormFactor(float3 point, float3 normal, const float3 corner[3]) {
  float3 above[4];
  int count = 0;
  for (int k = 0; k < 3; ++k) {
    const float3 a = corner[k] - point, b = corner[(k + 1) % 3] - point;
    const float ha = dot(a, normal), hb = dot(b, normal);
    if (ha > 0.0f) above[count++] = a;
    if ((ha > 0.0f) != (hb > 0.0f) && count < 4) above[count++] = a + (ha / (ha - hb)) * (b - a);
  }
  float sum = 0.0f;
  for (int k = 0; k < count; ++k) {
    const float3 a = normalize(above[k]), b = normalize(above[k + 1 < count ? k + 1 : 0]);
    const float3 across = cross(a, b);
    const float sine = length(across), angle = atan2(sine, dot(a, b));
    if (sine > 1e-9f) sum += angle * dot(across, normal) / sine;
  }
  return fabs(sum) * (0.5f * M_1_PI_F);
}

// The same of a triangle that is far: Radon's rule of degree 5, whose error falls with the sixth power of the distance.
float farFormFactor(float3 point, float3 normal, const float3 corner[3]) {
  const float3 across = 0.5f * cross(corner[1] - corner[0], corner[2] - corner[0]);  // as long as the area
  const float3 middle = (corner[0] + corner[1] + corner[2]) * (1.0f / 3.0f);
  float sum = 0.0f;
  for (int k = 0; k < 7; ++k) {
    // From the middle towards the corners, and away from them.
    const float part = k < 3 ? 0.6961404781f : (k < 6 ? -0.4104261923f : 0.0f);
    const float share = k < 3 ? 0.1259391805f : (k < 6 ? 0.1323941527f : 0.225f);
    const float3 way = middle - point + part * (corner[k % 3] - middle);
    const float squared = dot(way, way);
    sum += share * (fmax(dot(way, normal), 0.0f) / squared) * (fabs(dot(way, across)) / squared);
  }
  return sum * M_1_PI_F;
}

bool isFar(float3 point, const float3 corner[3]) {
  const float3 a = corner[1] - corner[0], b = corner[2] - corner[1], c = corner[0] - corner[2], way = corner[0] - point;
  const float size2 = fmax(dot(a, a), fmax(dot(b, b), dot(c, c)));
  return PRELIGHT_FAR_SIZES * PRELIGHT_FAR_SIZES * size2 < dot(way, way);
}

// Irradiance of all emitters, were nothing in the way.
float3 openIrradiance(uint count, __global const RadiosityEmitter* emitters, Surface surface,
                      __global const float* positions, float3 point, float3 normal) {
  float3 sum = (float3)(0.0f);
  for (uint i = 0; i < count; ++i) {
    const RadiosityEmitter e = emitters[i];
    float3 corner[3];
    loadCorners(e.triangle, surface, positions, corner);
    const float facing = -dot(corner[0] - point, cross(corner[1] - corner[0], corner[2] - corner[0]));
    if (facing <= 0.0f && e.twoSided == 0u) continue;
    const float factor = isFar(point, corner) ? farFormFactor(point, normal, corner) : triangleFormFactor(point, normal, corner);
    sum += M_PI_F * factor * vload3(0, e.radiance);
  }
  return sum;
}
#endif

#ifdef PRELIGHT_SKY
// Every other sample by the cosine, the others by the sky; the balance heuristic weighs both (Veach 1997).
bool aimAtSky(Lights l, __constant const LightLayout* layout, uint sample, uint samples, uint2 bits, float3 normal,
              Aim* aim) {
  float3 direction;
  if ((sample & 1u) != 0u) {
    LightSample a;
    if (!sampleSky(l, layout, bits, &a)) return false;
    direction = a.direction;
  } else {
    direction = sampleCosineHemisphere((float2)(unitFloat(bits.x), unitFloat(bits.y)), normal);
  }
  const float cosine = dot(direction, normal);
  if (cosine <= 0.0f) return false;
  const float2 uv = skyCoordinates(layout, direction);
  const float density = (float)((samples + 1u) / 2u) * cosine * M_1_PI_F + (float)(samples / 2u) * pdfSky(l, layout, uv);
  aim->way = direction;
  aim->reach = MAXFLOAT;
  aim->value = evalSky(l, layout, uv) * (cosine / density);
  return true;
}
#endif

// A shadow ray a work-item. receivers [point] -> rays [point][ray]; values [point][ray][3], what each brings if it is
// open: 0 for a ray that cannot bring anything, which is made to hit nothing. Next: traceRays.
__kernel void aimAtLights(const DirectRays counts, __global const Receiver* receivers,
                          __constant const SceneLayout* layout, __global const SurfaceLine* surfaceLines,
                          __global const LightLine* lightLines, __global const RadiosityEmitter* emitters,
                          __global const float* positions, __global Ray* rays, __global float* values) {
  const uint rayCount = raysOf(counts);
  const size_t i = get_global_id(0);
  if (i >= (size_t)counts.points * rayCount) return;
  const Receiver r = receivers[i / rayCount];
  const uint ray = (uint)(i % rayCount);
  const float3 point = vload3(0, r.position), normal = vload3(0, r.normal);
  const Lights lights = lightsOf(layout, lightLines);
  Aim aim;
  bool arrives = false;
#ifdef PRELIGHT_PUNCTUAL
  if (ray < counts.punctual) {
    float share;
    arrives = aimAtPunctual(lights.punctual + ray, point, normal, &aim, &share);
    if (arrives) aim.value = share * vload3(0, lights.punctual[ray].intensity);
  }
#endif
#ifdef PRELIGHT_RADIOSITY_EMITTERS
  if (ray >= counts.punctual && ray < counts.punctual + counts.emitterSamples) {
    const uint index = r.firstSample * counts.emitterSamples + ray - counts.punctual;
    const uint2 choice = sampleSobolBits(index, hashInteger(r.seed ^ 0x68bc21ebu));
    const uint2 place = samplePaddedBits(index, hashInteger(r.seed ^ 0x02e5be93u));
    arrives = aimAtEmitter(lights, &layout->lights, emitters, surfaceOf(layout, surfaceLines), positions, choice.x,
                           (float2)(unitFloat(place.x), unitFloat(place.y)), (float)counts.emitterSamples, point, normal, &aim);
  }
#endif
#ifdef PRELIGHT_SKY
  if (ray >= counts.punctual + counts.emitterSamples) {
    const uint sample = ray - counts.punctual - counts.emitterSamples;
    const uint count = (sample & 1u) != 0u ? counts.skySamples / 2u : (counts.skySamples + 1u) / 2u;
    const uint2 bits = sampleSobolBits(r.firstSample * count + sample / 2u,
                                       hashInteger(r.seed ^ (0x967a889bu + (sample & 1u))));
    arrives = aimAtSky(lights, &layout->lights, sample, counts.skySamples, bits, normal, &aim);
  }
#endif
  rays[i] = shadowRay(receivers + i / rayCount, aim, arrives);
  vstore3(arrives ? aim.value : (float3)(0.0f), i, values);
}

// A point a work-item. hits, values [point][ray] of the rays above -> irradiance [point][2], rgb: of punctual lights
// and the sky, and of emitters. Where the emitters are few, what they would bring unhindered is exact, and the samples
// only tell which share of it arrives.
__kernel void sumLights(const DirectRays counts, uint emitterCount, __constant const SceneLayout* layout,
                        __global const SurfaceLine* surfaceLines, __global const Receiver* receivers,
                        __global const Hit* hits, __global const float* values,
                        __global const RadiosityEmitter* emitters, __global const float* positions,
                        __global float4* irradiance) {
  const size_t point = get_global_id(0);
  if (point >= counts.points) return;
  const uint rayCount = raysOf(counts);
  float3 sum = (float3)(0.0f), run = (float3)(0.0f), open = (float3)(0.0f), all = (float3)(0.0f);
  for (uint s = 0; s < rayCount; ++s) {
    const size_t at = point * rayCount + s;
    const float3 value = vload3(at, values);
    const bool emitter = s >= counts.punctual && s < counts.punctual + counts.emitterSamples;
    const float3 arrives = hits[at].triangle == PRELIGHT_NO_TRIANGLE ? value : (float3)(0.0f);
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
  const Receiver r = receivers[point];
  const float3 exact = openIrradiance(emitterCount, emitters, surfaceOf(layout, surfaceLines), positions,
                                     vload3(0, r.position), vload3(0, r.normal));
  open = all.x + all.y + all.z > 0.0f ? exact * (open / fmax(all, 1e-30f)) : (float3)(0.0f);
#endif
  irradiance[2 * point] = (float4)(sum, 0.0f);
  irradiance[2 * point + 1] = (float4)(open, 0.0f);
}
