// Records of an irradiance cache: the rays of a receiver, stratified in both angles, yield the gradients of irradiance
// around it as well (Ward and Heckbert 1992).
//   [generateRecordRays -> trace -> storeDistances, and gather_kernels.cl] -> sumRecords
#include "core/inline.h"
#include "core/sampling_funcs.cl"
#include "shared/cast_types.h"
#include "shared/gather_types.h"
#include "shared/ray_types.h"

// Returns the number of strata of the polar angle for a power of two of rays: about a third as many as of the azimuth.
uint polarStrata(uint rays) { return 1u << ((30u - clz(rays)) / 2u); }

// One work-item per ray. A receiver's rays are ordered by [azimuth][polar angle] stratum, each with one ray, because
// the points are a (0,2)-net. rays [receiver][raysPerReceiver], cosine-weighted around the shading normal.
__kernel void generateRecordRays(__constant const GatherParameters* p, __global const Receiver* receivers,
                                 __global Ray* rays) {
  const size_t i = get_global_id(0);
  const uint count = p->raysPerReceiver;
  if (i >= (size_t)p->receiverCount * count) return;
  __global const Receiver* r = receivers + i / count;
  const uint polar = polarStrata(count);
  const float2 u = sampleSobol(r->firstSample + (uint)(i % count), r->seed);
  const float3 d = sampleCosineHemisphere(u, vload3(0, r->normal));
  Ray ray;
  vstore3(vload3(0, r->position), 0, ray.origin);
  vstore3(d, 0, ray.direction);
  ray.sourceTriangle = dot(d, vload3(0, r->geometricNormal)) > 0.0f ? r->triangle : PRELIGHT_NO_TRIANGLE;
  ray.tMax = MAXFLOAT;
  rays[i / count * count + (uint)(u.y * (float)(count / polar)) * polar + (uint)(u.x * (float)polar)] = ray;
}

// One work-item per ray. hits [count] -> distances [count] to the first surface, m; MAXFLOAT where there is none.
__kernel void storeDistances(const uint count, __global const Hit* hits, __global float* distances) {
  const size_t i = get_global_id(0);
  if (i < count) distances[i] = hits[i].triangle == PRELIGHT_NO_TRIANGLE ? MAXFLOAT : hits[i].t;
}

// Sums of vectors in the tangent plane of a receiver, one per colour channel.
typedef struct ChannelVectors {
  float2 of[3];
} ChannelVectors;

PRELIGHT_INLINE void addVectors(float3 values, float2 direction, ChannelVectors* sums) {
  sums->of[0] += values.x * direction;
  sums->of[1] += values.y * direction;
  sums->of[2] += values.z * direction;
}

// Stores the vectors in world space, scaled; vectors that are not finite (from a surface at distance 0) become 0.
PRELIGHT_INLINE void storeVectors(ChannelVectors v, float scale, float3 tangent, float3 bitangent, __global float* out) {
  for (uint c = 0u; c < 3u; ++c) {
    const float3 g = scale * (v.of[c].x * tangent + v.of[c].y * bitangent);
    const bool finite = isfinite(g.x) && isfinite(g.y) && isfinite(g.z);
    vstore3(finite ? g : (float3)(0.0f), c, out);
  }
}

PRELIGHT_INLINE float2 azimuth(float turns) { return (float2)(cospi(2.0f * turns), sinpi(2.0f * turns)); }

// Returns 1 / the smaller distance.
PRELIGHT_INLINE float nearness(float a, float b) { return 1.0f / fmin(a, b); }

// Adds one azimuth's part of the translational gradient: strata are treated as walls of uniform radiance, at the
// distance of their ray, that move against one another (Ward and Heckbert 1992).
PRELIGHT_INLINE void addTranslation(__global const float* radiances, __global const float* distances, uint k, uint polar,
                                    uint azimuths, ChannelVectors* sums) {
  const uint at = k * polar, before = (k + azimuths - 1u) % azimuths * polar;
  const float2 outwards = azimuth(((float)k + 0.5f) / (float)azimuths), edge = azimuth((float)k / (float)azimuths);
  const float2 across = (float2)(-edge.y, edge.x);
  for (uint j = 0u; j < polar; ++j) {
    const float low = (float)j / (float)polar, sine = sqrt(low);  // squared sine of the lower edge
    const float3 here = vload3(at + j, radiances);
    const float width = sqrt((float)(j + 1u) / (float)polar) - sine;
    addVectors(width * nearness(distances[at + j], distances[before + j]) * (here - vload3(before + j, radiances)), across,
               sums);
    if (j == 0u) continue;
    const float weight = 2.0f * M_PI_F / (float)azimuths * sine * (1.0f - low);
    addVectors(weight * nearness(distances[at + j], distances[at + j - 1u]) * (here - vload3(at + j - 1u, radiances)), outwards,
               sums);
  }
}

// One work-item per receiver. radiances [receiver][azimuth][polar angle][3], distances [receiver][azimuth][polar angle]
// -> records [receiver].
__kernel void sumRecords(__constant const GatherParameters* p, __global const Receiver* receivers,
                         __global const float* radiances, __global const float* distances, __global GatherRecord* records) {
  const size_t i = get_global_id(0);
  if (i >= p->receiverCount) return;
  const uint rays = p->raysPerReceiver, polar = polarStrata(rays), azimuths = rays / polar;
  radiances += 3u * (size_t)rays * i;
  distances += (size_t)rays * i;
  float3 sum = (float3)(0.0f);
  float closeness = 0.0f, nearest = MAXFLOAT;
  ChannelVectors translation, rotation;
  for (uint c = 0u; c < 3u; ++c) translation.of[c] = rotation.of[c] = (float2)(0.0f);
  for (uint k = 0u; k < azimuths; ++k) {
    const float2 outwards = azimuth(((float)k + 0.5f) / (float)azimuths);
    for (uint j = 0u; j < polar; ++j) {
      const uint at = k * polar + j;
      const float3 radiance = vload3(at, radiances);
      const float squaredSine = ((float)j + 0.5f) / (float)polar;
      sum += radiance;
      closeness += 1.0f / distances[at];
      nearest = fmin(nearest, distances[at]);
      addVectors(sqrt(squaredSine / (1.0f - squaredSine)) * radiance, (float2)(-outwards.y, outwards.x), &rotation);
    }
    addTranslation(radiances, distances, k, polar, azimuths, &translation);
  }
  const float share = 1.0f / (float)rays;
  __global GatherRecord* record = records + i;
  vstore3(sum * (M_PI_F * share), 0, record->irradiance);
  record->closeness = fmin(closeness * share, MAXFLOAT);
  record->nearest = nearest;
  float3 tangent, bitangent;
  makeFrame(vload3(0, receivers[i].normal), &tangent, &bitangent);
  storeVectors(translation, 1.0f, tangent, bitangent, &record->translation[0][0]);
  storeVectors(rotation, M_PI_F * share, tangent, bitangent, &record->rotation[0][0]);
}
