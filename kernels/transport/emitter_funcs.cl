// Emissive triangles as lights; triangles with uneven emission are divided into parts, each an emitter of its own.
// Options: those of transport/light_table_funcs.cl, PRELIGHT_MEAN_EMISSION (shading reads no textures, and parts have
// their mean radiance).
#ifndef PRELIGHT_TRANSPORT_EMITTER_FUNCS_CL
#define PRELIGHT_TRANSPORT_EMITTER_FUNCS_CL

#include "transport/light_table_funcs.cl"
#include "transport/material_funcs.cl"

#ifdef PRELIGHT_EMITTERS
// A sampled point of an emitter.
typedef struct EmitterPoint {
  uint emitter;
  uint triangle;
  float2 at;  // weights of vertices 1 and 2
  float3 position;
  float3 error;   // bound of the position's rounding
  float3 normal;  // unit normal of the front
  float area;     // m2, of the emitter
  float chance;   // probability with which the emitter was chosen
} EmitterPoint;

// Returns the emitter at a point of a triangle, or PRELIGHT_NO_EMITTER.
PRELIGHT_INLINE uint emitterAt(Lights l, uint triangle, float u, float v) {
#ifdef PRELIGHT_EMITTER_PARTS
  uint at = l.emitterRoots[triangle];
  while ((at & PRELIGHT_EMITTER_LEAF) == 0u) {  // the bit is set in PRELIGHT_NO_EMITTER, too
    const uint part = 1.0f - u - v >= 0.5f ? 0u : (u >= 0.5f ? 1u : (v >= 0.5f ? 2u : 3u));
    at = l.emitterNodes[4u * at + part];
    u = part == 3u ? 1.0f - 2.0f * u : 2.0f * u - (part == 1u ? 1.0f : 0.0f);
    v = part == 3u ? 1.0f - 2.0f * v : 2.0f * v - (part == 2u ? 1.0f : 0.0f);
  }
  return at == PRELIGHT_NO_EMITTER ? at : at & ~PRELIGHT_EMITTER_LEAF;
#else
  return PRELIGHT_NO_EMITTER;  // without parts, emitters are found by their triangle
#endif
}

// Returns true when some part of a triangle emits light.
PRELIGHT_INLINE bool isEmitter(Lights l, uint triangle) {
#ifdef PRELIGHT_EMITTER_PARTS
  return l.emitterRoots[triangle] != PRELIGHT_NO_EMITTER;
#else
  return l.emitterDensities[triangle] > 0.0f;
#endif
}

// Returns the density, 1/m2, with which a point of a triangle is drawn.
PRELIGHT_INLINE float emitterDensity(Lights l, uint triangle, float u, float v) {
#ifdef PRELIGHT_EMITTER_PARTS
  const uint emitter = emitterAt(l, triangle, u, v);
  return emitter == PRELIGHT_NO_EMITTER ? 0.0f : l.emitterDensities[emitter];
#else
  return l.emitterDensities[triangle];
#endif
}

PRELIGHT_INLINE EmitterPoint pointOnEmitter(Lights l, PathScene s, uint entry, float chance, float2 place) {
  EmitterPoint e;
  e.emitter = entry;
  e.triangle = l.emitters[entry];
  e.chance = chance;
  const DeviceTriangle t = triangleAt(s.surface, e.triangle);
  const float3 p = vertexPosition(s, t.vertex[0]), q = vertexPosition(s, t.vertex[1]), r = vertexPosition(s, t.vertex[2]);
  e.at = sampleTriangle(place);
  float share = 1.0f;  // share of the triangle
#ifdef PRELIGHT_EMITTER_PARTS
  const float4 part = l.emitterParts[entry];
  e.at = clamp(part.xy + part.z * e.at, 0.0f, 1.0f);
  share = part.z * part.z;
#endif
  e.position = pointOnTriangle(p, q, r, e.at.x, e.at.y);
  e.error = pointError(p, q, r, e.at.x, e.at.y);
  e.normal = frontNormal(p, q, r);
  e.area = 0.5f * length(cross(q - p, r - p)) * share;
  return e;
}

// Samples a point of one emitter of a range, chosen by power.
PRELIGHT_INLINE EmitterPoint sampleEmitterPoint(Lights l, EmitterRange range, PathScene s, uint bits, float2 place) {
  float probability, remainder;
  const uint entry = range.first + chooseEntry(l.tables + range.table, range.count, bits, &probability, &remainder);
  return pointOnEmitter(l, s, entry, probability, place);
}

// As sampleEmitterPoint, from only two random numbers, so that few samples are evenly distributed over all emitters:
// the rest of the first number, after the choice, determines the place.
PRELIGHT_INLINE EmitterPoint sampleEmitterPointByPair(Lights l, EmitterRange range, PathScene s, uint2 bits) {
  float probability, remainder;
  const uint entry = range.first + chooseEntry(l.tables + range.table, range.count, bits.x, &probability, &remainder);
  return pointOnEmitter(l, s, entry, probability, (float2)(remainder, unitFloat(bits.y)));
}

// Samples a point of one of `count` emitters from `first` on, chosen by power. `bounds`: intervals of all emitters.
PRELIGHT_INLINE EmitterPoint sampleEmitterAmong(Lights l, __constant const LightLayout* layout, PathScene s, uint first, uint count,
                                                uint bits, float2 place) {
  __global const uint* bounds = l.tables + layout->emitterTable;
  const uint lower = bounds[first], end = first + count;
  const uint width = (end < layout->emitterCount ? bounds[end] : 0u) - lower;  // 0: all of 2^32
  float probability, remainder;
  const uint entry = chooseEntry(bounds, layout->emitterCount, lower + (width == 0u ? bits : mul_hi(bits, width)), &probability, &remainder);
  return pointOnEmitter(l, s, entry, probability / (width == 0u ? 1.0f : (float)width * 2.3283064e-10f), place);
}

// Returns the density, 1/sr, of a direction that meets an emitter at a distance under |cosine|, given the density of
// its points.
PRELIGHT_INLINE float pdfEmitter(float density, float distance, float cosine) {
  return density * distance * distance / fmax(fabs(cosine), 1e-9f);
}

// Fills a light sample, except for its radiance, for a point of an emitter as seen from `point`; front: the visible
// side. Returns false when neither side is visible.
PRELIGHT_INLINE bool seeEmitter(Lights l, EmitterPoint e, float3 point, LightSample* a, bool* front) {
  const float3 way = e.position - point;
  const float distance = length(way);
  if (!(distance > 1e-9f)) return false;
  a->direction = way / distance;
  a->distance = distance;
  const float cosine = -dot(a->direction, e.normal);
  if (fabs(cosine) < 1e-7f) return false;
#ifdef PRELIGHT_EMITTER_PARTS
  a->pdf = pdfEmitter(l.emitterDensities[e.emitter], distance, cosine);
#else
  a->pdf = pdfEmitter(l.emitterDensities[e.triangle], distance, cosine);
#endif
  a->target = offsetOrigin(e.position, e.error, e.normal, -a->direction);
  a->punctual = false;
  a->surface = true;
  *front = cosine > 0.0f;
  return true;
}

// Returns the radiance that leaves a point of an emitter along a direction.
PRELIGHT_INLINE float3 emitterRadiance(Lights l, PathScene s, EmitterPoint e, bool front, float3 direction) {
#if defined(PRELIGHT_EMITTER_PARTS) && defined(PRELIGHT_MEAN_EMISSION)
  const bool emits = emitsOn(s.materials + materialAt(s.surface, e.triangle), front);
  return emits ? l.emitterRadiances[e.emitter].xyz : (float3)(0.0f);
#else
  // Rays to the emitter's own surface do not test its coverage.
  return emittedRadiance(s, e.triangle, e.at.x, e.at.y, front, direction) * surfaceCoverage(s.surface, e.triangle, e.at.x, e.at.y);
#endif
}

PRELIGHT_INLINE bool sampleEmitter(Lights l, __constant const LightLayout* layout, PathScene s, float3 point, uint bits,
                                   float2 place, LightSample* a) {
  const EmitterPoint e = sampleEmitterPoint(l, allEmitters(layout), s, bits, place);
  bool front;
  if (!seeEmitter(l, e, point, a, &front)) return false;
  a->radiance = emitterRadiance(l, s, e, front, a->direction);
  return true;
}
#endif

#endif
