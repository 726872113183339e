// The sky as a light: a map of radiance whose texels are sampled by the light that they send.
// Options: those of transport/light_table_funcs.cl.
#ifndef PRELIGHT_TRANSPORT_SKY_FUNCS_CL
#define PRELIGHT_TRANSPORT_SKY_FUNCS_CL

#include "transport/light_table_funcs.cl"

#ifdef PRELIGHT_SKY
PRELIGHT_INLINE float4 skyTexel(Lights l, __constant const LightLayout* p, int x, int y) {
  const int w = (int)p->skyWidth, h = (int)p->skyHeight;
  const int column = x < 0 ? x + w : (x >= w ? x - w : x);
  return l.sky[(size_t)clamp(y, 0, h - 1) * w + column];
}

// Returns the radiance at (u, v) in [0,1]^2 of the map: bilinear between the centres of texels.
PRELIGHT_INLINE float3 evalSky(Lights l, __constant const LightLayout* p, float2 uv) {
  const float2 at = uv * (float2)((float)p->skyWidth, (float)p->skyHeight) - 0.5f;
  const float2 base = floor(at);
  const float2 f = at - base;
  const int x = (int)base.x, y = (int)base.y;
  return mix(mix(skyTexel(l, p, x, y), skyTexel(l, p, x + 1, y), f.x),
             mix(skyTexel(l, p, x, y + 1), skyTexel(l, p, x + 1, y + 1), f.x), f.y).xyz;
}

// Returns the coordinates, in [0,1), of a direction in the map (docs/conventions.md, "Sky").
PRELIGHT_INLINE float2 skyCoordinates(__constant const LightLayout* p, float3 d) {
  const float u = atan2pi(d.x, -d.z) * 0.5f + 0.5f + p->skyTurn;
  const float v = atan2pi(sqrt(d.x * d.x + d.z * d.z), d.y);
  return (float2)(u - floor(u), fmin(v, 0.99999994f));
}

// Returns the density of a direction, 1/sr: the texel's probability divided by its share of the map and by the sphere's
// area per area of the map there.
PRELIGHT_INLINE float pdfSky(Lights l, __constant const LightLayout* p, float2 uv) {
  const uint x = min((uint)(uv.x * (float)p->skyWidth), p->skyWidth - 1u);
  const uint y = min((uint)(uv.y * (float)p->skyHeight), p->skyHeight - 1u);
  const float row = entryProbability(l.tables + p->rowTable, p->skyHeight, y);
  const float column = entryProbability(l.tables + p->columnTable + (size_t)y * p->skyWidth, p->skyWidth, x);
  const float texels = (float)p->skyWidth * (float)p->skyHeight;
  return row * column * texels / (19.7392088f * fmax(sinpi(uv.y), 1e-9f));  // 2 pi^2
}

PRELIGHT_INLINE bool sampleSky(Lights l, __constant const LightLayout* p, uint2 bits, LightSample* a) {
  float probability, u, v;
  const uint y = chooseEntry(l.tables + p->rowTable, p->skyHeight, bits.x, &probability, &v);
  const uint x = chooseEntry(l.tables + p->columnTable + (size_t)y * p->skyWidth, p->skyWidth, bits.y, &probability, &u);
  const float2 uv = (float2)(fmin(((float)x + u) / (float)p->skyWidth, 0.99999994f),
                             fmin(((float)y + v) / (float)p->skyHeight, 0.99999994f));
  const float azimuth = 2.0f * (uv.x - p->skyTurn - 0.5f);  // in units of pi, from -Z towards +X
  const float ring = sinpi(uv.y);
  a->direction = (float3)(ring * sinpi(azimuth), cospi(uv.y), -ring * cospi(azimuth));
  a->distance = MAXFLOAT;
  a->radiance = evalSky(l, p, uv);
  a->pdf = pdfSky(l, p, uv);
  a->punctual = false;
  a->surface = false;
  return true;
}
#endif

#endif
