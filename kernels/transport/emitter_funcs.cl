// Emissive triangles as lights.
// Options: those of transport/light_table_funcs.cl.
#ifndef PRELIGHT_TRANSPORT_EMITTER_FUNCS_CL
#define PRELIGHT_TRANSPORT_EMITTER_FUNCS_CL

#include "transport/light_table_funcs.cl"
#include "transport/material_funcs.cl"

#ifdef PRELIGHT_EMITTERS
typedef struct EmitterPoint {
  uint triangle;
  float2 at;  // weights of vertices 1 and 2
  float3 position;
  float3 error;   // bound of the position's rounding
  float3 normal;  // of the front
  float area;     // m2, of the triangle
  float chance;   // with which the triangle was chosen
} EmitterPoint;

PRELIGHT_INLINE EmitterPoint pointOnEmitter(Lights l, PathScene s, uint entry, float chance, float2 place) {
  EmitterPoint e;
  e.triangle = l.emitters[entry];
  e.chance = chance;
  const DeviceTriangle t = triangleAt(s.surface, e.triangle);
  const float3 p = vertexPosition(s, t.vertex[0]), q = vertexPosition(s, t.vertex[1]), r = vertexPosition(s, t.vertex[2]);
  e.at = sampleTriangle(place);
  e.position = pointOnTriangle(p, q, r, e.at.x, e.at.y);
  e.error = pointError(p, q, r, e.at.x, e.at.y);
  e.normal = frontNormal(p, q, r);
  e.area = 0.5f * length(cross(q - p, r - p));
  return e;
}

// One of a range of emitters, chosen by power.
PRELIGHT_INLINE EmitterPoint sampleEmitterPoint(Lights l, EmitterRange range, PathScene s, uint bits, float2 place) {
  float probability, remainder;
  const uint entry = range.first + chooseEntry(l.tables + range.table, range.count, bits, &probability, &remainder);
  return pointOnEmitter(l, s, entry, probability, place);
}

// The same by two numbers alone, so that few samples spread evenly over all emitters: what choosing leaves of the first
// one tells the place.
PRELIGHT_INLINE EmitterPoint sampleEmitterPointByPair(Lights l, EmitterRange range, PathScene s, uint2 bits) {
  float probability, remainder;
  const uint entry = range.first + chooseEntry(l.tables + range.table, range.count, bits.x, &probability, &remainder);
  return pointOnEmitter(l, s, entry, probability, (float2)(remainder, unitFloat(bits.y)));
}

// 1/sr for a direction that meets an emitter at a distance under |cosine|.
PRELIGHT_INLINE float pdfEmitter(Lights l, uint triangle, float distance, float cosine) {
  return l.emitterDensities[triangle] * distance * distance / fmax(fabs(cosine), 1e-9f);
}

// The way from a point to that of an emitter, all of the sample but its radiance; front: the side that is seen. False: neither is.
PRELIGHT_INLINE bool seeEmitter(Lights l, EmitterPoint e, float3 point, LightSample* a, bool* front) {
  const float3 way = e.position - point;
  const float distance = length(way);
  if (!(distance > 1e-9f)) return false;
  a->direction = way / distance;
  a->distance = distance;
  const float cosine = -dot(a->direction, e.normal);
  if (fabs(cosine) < 1e-7f) return false;
  a->pdf = pdfEmitter(l, e.triangle, distance, cosine);
  a->target = offsetOrigin(e.position, e.error, e.normal, -a->direction);
  a->punctual = false;
  a->surface = true;
  *front = cosine > 0.0f;
  return true;
}

PRELIGHT_INLINE bool sampleEmitter(Lights l, __constant const LightLayout* layout, PathScene s, float3 point, uint bits,
                                   float2 place, LightSample* a) {
  const EmitterPoint e = sampleEmitterPoint(l, allEmitters(layout), s, bits, place);
  bool front;
  if (!seeEmitter(l, e, point, a, &front)) return false;
  // Rays to the emitter's own surface do not ask whether it is there.
  a->radiance = emittedRadiance(s, e.triangle, e.at.x, e.at.y, front, a->direction) * surfaceCoverage(s.surface, e.triangle, e.at.x, e.at.y);
  return true;
}
#endif

#endif
