// Lights: choosing one, a direction towards it, and the density with which that direction was drawn.
// Options: PRELIGHT_PUNCTUAL, PRELIGHT_EMITTERS, PRELIGHT_SKY: the scene has such lights.
#ifndef PRELIGHT_TRANSPORT_LIGHT_FUNCS_CL
#define PRELIGHT_TRANSPORT_LIGHT_FUNCS_CL

#include "core/punctual_funcs.cl"
#include "transport/material_funcs.cl"

typedef struct Lights {
  __global const uint* tables;             // lower bounds in 2^32: groups, emitters, sky rows, sky columns a row
  __global const uint* emitters;           // [emitter] triangle
  __global const float* emitterDensities;  // [triangle] 1/m2 with which a point of it is drawn; 0: no emitter
  __global const PunctualLight* punctual;
  __global const float4* sky;  // [row][column] radiance
} Lights;

// What arrives at a point from a light, were nothing in the way.
typedef struct Arrival {
  float3 direction;  // unit
  float distance;    // MAXFLOAT: from afar
  float3 target;     // where the light leaves, if it is a surface
  float3 radiance;   // of a punctual light: irradiance on a surface that faces it
  float density;     // 1/sr of the direction
  bool punctual;     // no ray can meet the light by chance
  bool surface;
} Arrival;

// The entry whose interval holds `bits`. Bounds ascend from 0; the last interval ends at 2^32; none is empty.
// remainder in (0,1): place within the interval.
uint chooseEntry(__global const uint* bounds, uint count, uint bits, float* probability, float* remainder) {
  uint low = 0u, high = count;
  while (high - low > 1u) {
    const uint middle = low + (high - low) / 2u;
    if (bounds[middle] <= bits)
      low = middle;
    else
      high = middle;
  }
  const uint width = (low + 1u < count ? bounds[low + 1u] : 0u) - bounds[low];  // 0: all of 2^32
  const float size = width == 0u ? 4294967296.0f : (float)width;
  *probability = size * 2.3283064e-10f;
  *remainder = fmin(((float)(bits - bounds[low]) + 0.5f) / size, 0.99999994f);
  return low;
}

float entryProbability(__global const uint* bounds, uint count, uint entry) {
  const uint width = (entry + 1u < count ? bounds[entry + 1u] : 0u) - bounds[entry];
  return width == 0u ? 1.0f : (float)width * 2.3283064e-10f;
}

#ifdef PRELIGHT_PUNCTUAL
bool arriveFromPunctual(__global const PunctualLight* light, float3 point, Arrival* a) {
  float falloff;
  if (!seePunctual(light, point, &a->direction, &a->distance, &falloff)) return false;
  a->punctual = true;
  a->surface = false;
  a->density = 1.0f;
  a->radiance = falloff * vload3(0, light->intensity);
  return true;
}
#endif

#ifdef PRELIGHT_EMITTERS
// 1/sr for a direction that meets an emitter at a distance under |cosine|.
float emitterDensity(Lights l, uint triangle, float distance, float cosine) {
  return l.emitterDensities[triangle] * distance * distance / fmax(fabs(cosine), 1e-9f);
}

bool arriveFromEmitter(Lights l, __constant const LightLayout* parameters, PathScene s, float3 point,
                       uint bits, float2 place, Arrival* a) {
  float probability, remainder;
  const uint entry = chooseEntry(l.tables + parameters->emitterTable, parameters->emitterCount, bits, &probability, &remainder);
  const uint triangle = l.emitters[entry];
  const DeviceTriangle t = s.surface.triangles[triangle];
  // Uniform over the area: the unit square folded along its diagonal by its square root.
  const float root = sqrt(place.x);
  const float u = root * (1.0f - place.y), v = root * place.y;
  const float3 p = vertexPosition(s, t.vertex[0]), q = vertexPosition(s, t.vertex[1]), r = vertexPosition(s, t.vertex[2]);
  const float3 normal = frontNormal(p, q, r);
  const float3 target = pointOnTriangle(p, q, r, u, v);
  const float3 way = target - point;
  const float distance = length(way);
  if (!(distance > 1e-9f)) return false;
  a->direction = way / distance;
  a->distance = distance;
  const float cosine = -dot(a->direction, normal);
  if (fabs(cosine) < 1e-7f) return false;
  a->radiance = emittedRadiance(s, triangle, u, v, cosine > 0.0f);
  a->density = emitterDensity(l, triangle, distance, cosine);
  a->target = offsetOrigin(target, pointError(p, q, r, u, v), normal, -a->direction);
  a->punctual = false;
  a->surface = true;
  return true;
}
#endif

#ifdef PRELIGHT_SKY
float4 skyTexel(Lights l, __constant const LightLayout* p, int x, int y) {
  const int w = (int)p->skyWidth, h = (int)p->skyHeight;
  const int column = x < 0 ? x + w : (x >= w ? x - w : x);
  return l.sky[(size_t)clamp(y, 0, h - 1) * w + column];
}

// Radiance at (u, v) in [0,1]^2 of the map: bilinear between the centres of texels.
float3 skyRadiance(Lights l, __constant const LightLayout* p, float2 uv) {
  const float2 at = uv * (float2)((float)p->skyWidth, (float)p->skyHeight) - 0.5f;
  const float2 base = floor(at);
  const float2 f = at - base;
  const int x = (int)base.x, y = (int)base.y;
  return mix(mix(skyTexel(l, p, x, y), skyTexel(l, p, x + 1, y), f.x),
             mix(skyTexel(l, p, x, y + 1), skyTexel(l, p, x + 1, y + 1), f.x), f.y).xyz;
}

// docs/conventions.md, "Sky". In [0,1).
float2 skyCoordinates(__constant const LightLayout* p, float3 d) {
  const float u = atan2pi(d.x, -d.z) * 0.5f + 0.5f + p->skyTurn;
  const float v = atan2pi(sqrt(d.x * d.x + d.z * d.z), d.y);
  return (float2)(u - floor(u), fmin(v, 0.99999994f));
}

// 1/sr: the texel's probability over its share of the map, over the sphere's area that (u, v) maps to there.
float skyDensity(Lights l, __constant const LightLayout* p, float2 uv) {
  const uint x = min((uint)(uv.x * (float)p->skyWidth), p->skyWidth - 1u);
  const uint y = min((uint)(uv.y * (float)p->skyHeight), p->skyHeight - 1u);
  const float row = entryProbability(l.tables + p->rowTable, p->skyHeight, y);
  const float column = entryProbability(l.tables + p->columnTable + (size_t)y * p->skyWidth, p->skyWidth, x);
  const float texels = (float)p->skyWidth * (float)p->skyHeight;
  return row * column * texels / (19.7392088f * fmax(sinpi(uv.y), 1e-9f));  // 2 pi^2
}

bool arriveFromSky(Lights l, __constant const LightLayout* p, uint2 bits, Arrival* a) {
  float probability, u, v;
  const uint y = chooseEntry(l.tables + p->rowTable, p->skyHeight, bits.x, &probability, &v);
  const uint x = chooseEntry(l.tables + p->columnTable + (size_t)y * p->skyWidth, p->skyWidth, bits.y, &probability, &u);
  const float2 uv = (float2)(fmin(((float)x + u) / (float)p->skyWidth, 0.99999994f),
                             fmin(((float)y + v) / (float)p->skyHeight, 0.99999994f));
  const float azimuth = 2.0f * (uv.x - p->skyTurn - 0.5f);  // in units of pi, from -Z towards +X
  const float ring = sinpi(uv.y);
  a->direction = (float3)(ring * sinpi(azimuth), cospi(uv.y), -ring * cospi(azimuth));
  a->distance = MAXFLOAT;
  a->radiance = skyRadiance(l, p, uv);
  a->density = skyDensity(l, p, uv);
  a->punctual = false;
  a->surface = false;
  return true;
}
#endif

#endif
