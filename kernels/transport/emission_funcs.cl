// Emission of light: emitLight draws the start of a photon on the lights that transport/light_funcs.cl samples from the
// receiving side.
// Options: those of transport/light_table_funcs.cl.
#ifndef PRELIGHT_TRANSPORT_EMISSION_FUNCS_CL
#define PRELIGHT_TRANSPORT_EMISSION_FUNCS_CL

#include "shared/photon_path_types.h"
#include "transport/light_funcs.cl"

// The start of a photon.
typedef struct Emission {
  float3 origin;
  float3 direction;  // unit
  float3 power;      // W; power of the source if this were its only photon
  uint triangle;     // triangle that it leaves, or PRELIGHT_NO_TRIANGLE
} Emission;

// Returns a direction around an axis. With cells the frame is the one in which the host has chosen them.
PRELIGHT_INLINE float3 around(PhotonSource s, float3 axis, float cosine, float turns) {
  float3 x, y;
  makeFrame(axis, &x, &y);
  if (s.cellCount != 0u) {
    x = vload3(0, s.tangent);
    y = cross(axis, x);
  }
  const float sine = sqrt(fmax(1.0f - cosine * cosine, 0.0f));
  return normalize(sine * cospi(2.0f * turns) * x + sine * sinpi(2.0f * turns) * y + cosine * axis);
}

// Starts directional light and the sky on a disc that covers the scene.
PRELIGHT_INLINE void startAfar(__constant const PhotonParameters* p, float3 direction, float2 u, Emission* e) {
  float3 x, y;
  makeFrame(direction, &x, &y);
  const float radius = p->radius * sqrt(u.x);
  e->origin = vload3(0, p->centre) + radius * (cospi(2.0f * u.y) * x + sinpi(2.0f * u.y) * y) - p->distance * direction;
  e->direction = direction;
  e->power *= M_PI_F * p->radius * p->radius;
  e->triangle = PRELIGHT_NO_TRIANGLE;
}

#ifdef PRELIGHT_PROFILES
// Draws a direction in proportion to the lamp's intensities between neighbouring angles, uniformly between these.
PRELIGHT_INLINE void emitByProfile(Lights l, __global const PunctualLight* light, uint2 bits, Emission* e) {
  const int first = (int)light->profile;
  const float4 size = l.profiles[first];
  const uint columns = (uint)size.x, rows = (uint)size.y;
  float ofColumn, ofRow, u, v;
  const uint column = chooseEntry(l.tables + light->profileTable, columns, bits.x, &ofColumn, &u);
  const uint row = chooseEntry(l.tables + light->profileTable + columns + column * rows, rows, bits.y, &ofRow, &v);
  __global const float4* heights = l.profiles + first + 1;
  __global const float4* turns = heights + rows + 1u;
  const float left = turns[column].x, width = turns[column + 1u].x - left;
  const float low = heights[row].x, high = heights[row + 1u].x;
  // (1 - cosine) / 2, for which equal steps are equal solid angles.
  const float from = sin(0.5f * low) * sin(0.5f * low), to = sin(0.5f * high) * sin(0.5f * high);
  const float part = clamp(mix(from, to, v), 0.0f, 1.0f);
  const float height = clamp(2.0f * asin(sqrt(part)), low, high), turn = left + u * width + light->profileStart;
  const float3 pole = vload3(0, light->direction), across = acrossPole(pole);
  const float sine = 2.0f * sqrt(part * (1.0f - part));
  e->direction = normalize((1.0f - 2.0f * part) * pole + sine * (cos(turn) * across + sin(turn) * cross(across, pole)));
  const float4 corners = turns[columns + 1u + column * rows + row];
  e->power *= betweenCorners(corners, u, clamp((height - low) / max(high - low, 1e-9f), 0.0f, 1.0f)) * (2.0f * width * (to - from) / (ofColumn * ofRow));
}
#endif

#ifdef PRELIGHT_PUNCTUAL
PRELIGHT_INLINE Emission emitFromPunctual(__constant const PhotonParameters* p, Lights l, uint2 bits) {
  __global const PunctualLight* light = l.punctual + p->source.light;
  const float2 u = (float2)(unitFloat(bits.x), unitFloat(bits.y));
  Emission e;
  e.power = vload3(0, light->intensity);
  if (light->kind == PRELIGHT_DIRECTIONAL_LIGHT) {
    startAfar(p, vload3(0, light->direction), u, &e);
    return e;
  }
  e.origin = vload3(0, light->position);
  e.triangle = PRELIGHT_NO_TRIANGLE;
#ifdef PRELIGHT_PROFILES
  if (light->kind == PRELIGHT_PROFILED_LIGHT && p->source.cellCount == 0u) {
    emitByProfile(l, light, bits, &e);
    return e;
  }
#endif
  // Larsen 6.3 with the polar angle acos(1 - 2 r); spots use only their cone.
  const float least = light->kind == PRELIGHT_SPOT_LIGHT ? clamp(-light->coneOffset / light->coneScale, -1.0f, 1.0f) : -1.0f;
  const float cosine = 1.0f - (1.0f - least) * u.y;
  e.direction = around(p->source, vload3(0, light->direction), cosine, u.x);
  e.power *= 2.0f * M_PI_F * (1.0f - least);
  if (light->kind == PRELIGHT_SPOT_LIGHT) {
    const float angular = clamp(cosine * light->coneScale + light->coneOffset, 0.0f, 1.0f);
    e.power *= angular * angular;
  }
#ifdef PRELIGHT_PROFILES
  if (light->kind == PRELIGHT_PROFILED_LIGHT)
    e.power *= profileIntensity(l.profiles, (int)light->profile, vload3(0, light->direction), light->profileStart, e.direction);
#endif
  return e;
}
#endif

#ifdef PRELIGHT_EMITTERS
// Emits from a surface. choice.y selects the side of an emitter that has two.
PRELIGHT_INLINE Emission emitFromSurface(__constant const PhotonParameters* p, Lights l, PathScene s, uint2 choice, float2 u,
                                         float2 place) {
  const bool all = p->source.light == PRELIGHT_ALL_EMITTERS;
  EmitterPoint at;
  if (all)
    at = sampleEmitterPoint(l, allEmitters(&p->scene.lights), s, choice.x, place);
  else if (p->source.emitters == 1u)
    at = pointOnEmitter(l, s, p->source.light, 1.0f, place);
  else
    at = sampleEmitterAmong(l, &p->scene.lights, s, p->source.light, p->source.emitters, choice.x, place);
  const bool twoSided = (s.materials[materialAt(s.surface, at.triangle)].flags & PRELIGHT_DOUBLE_SIDED) != 0u;
  const bool front = !twoSided || choice.y < 0x80000000u;
  const float3 normal = at.normal * (front ? 1.0f : -1.0f);
  Emission e;
  e.direction = around(p->source, normal, sqrt(1.0f - u.y), u.x);  // density cos/pi
  e.origin = offsetOrigin(at.position, at.error, normal, e.direction);
  e.triangle = at.triangle;
  e.power = emittedRadiance(s, at.triangle, at.at.x, at.at.y, front, e.direction) * (M_PI_F * at.area * (twoSided ? 2.0f : 1.0f) / at.chance);
  e.power *= surfaceCoverage(s.surface, at.triangle, at.at.x, at.at.y);
  return e;
}
#endif

#ifdef PRELIGHT_SKY
PRELIGHT_INLINE Emission emitFromSky(__constant const PhotonParameters* p, Lights l, uint2 bits, float2 place) {
  LightSample a;
  sampleSky(l, &p->scene.lights, bits, &a);
  Emission e;
  e.power = a.radiance / a.pdf;
  startAfar(p, -a.direction, place, &e);
  return e;
}
#endif

// Emits an importon, which leaves the eye through a uniformly chosen point of the picture.
PRELIGHT_INLINE Emission emitFromEye(Eye eye, float2 u) {
  const float3 forward = vload3(0, eye.forward);
  const float3 across = (2.0f * u.x - 1.0f) * vload3(0, eye.right) + (1.0f - 2.0f * u.y) * vload3(0, eye.up);
  const float3 way = eye.perspective != 0u ? forward + across : forward;
  Emission e;
  e.origin = vload3(0, eye.position) + eye.zNear * way + (eye.perspective != 0u ? (float3)(0.0f) : across);
  e.direction = normalize(way);
  e.power = (float3)(1.0f);
  e.triangle = PRELIGHT_NO_TRIANGLE;
  return e;
}

// Random bits with which a photon of p->source starts: for its direction, for its place on the light or on the disc of
// a distant light, and for the choice of the emitter and its side.
typedef struct EmissionPoint {
  uint2 direction;
  uint2 place;
  uint2 choice;
} EmissionPoint;

PRELIGHT_INLINE Emission emitLight(__constant const PhotonParameters* p, Lights l, PathScene s, EmissionPoint point) {
  const float2 u = (float2)(unitFloat(point.direction.x), unitFloat(point.direction.y));
  const float2 place = (float2)(unitFloat(point.place.x), unitFloat(point.place.y));
  Emission e;
  if (p->source.kind == PRELIGHT_SOURCE_EYE) e = emitFromEye(p->eye, u);
#ifdef PRELIGHT_PUNCTUAL
  if (p->source.kind == PRELIGHT_SOURCE_PUNCTUAL) e = emitFromPunctual(p, l, point.direction);
#endif
#ifdef PRELIGHT_EMITTERS
  if (p->source.kind == PRELIGHT_SOURCE_EMITTERS) e = emitFromSurface(p, l, s, point.choice, u, place);
#endif
#ifdef PRELIGHT_SKY
  if (p->source.kind == PRELIGHT_SOURCE_SKY)  // the sky's cells are of places
    e = p->source.cellCount == 0u ? emitFromSky(p, l, point.direction, place) : emitFromSky(p, l, point.place, u);
#endif
  return e;
}

#endif
