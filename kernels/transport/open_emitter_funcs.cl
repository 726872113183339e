// Irradiance of emissive triangles in closed form, without occlusion.
// Options: those of transport/light_table_funcs.cl.
#ifndef PRELIGHT_TRANSPORT_OPEN_EMITTER_FUNCS_CL
#define PRELIGHT_TRANSPORT_OPEN_EMITTER_FUNCS_CL

#include "transport/emitter_funcs.cl"

#ifdef PRELIGHT_EMITTERS
// Ratio of distance to size from which on a triangle counts as far: Lambert's formula loses digits with the square of
// the ratio, as the parts of its edges cancel.
#define PRELIGHT_FAR_SIZES 32.0f

// Returns the integral of cosine / pi over the part of a triangle above the horizon of (point, normal), by Lambert's
// formula, edge by edge of the clipped polygon. Positive for either winding of the triangle.
float nearFormFactor(float3 point, float3 normal, const float3 corner[3]) {
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

// Returns the integral for a far triangle by Radon's rule of degree 5, whose error falls with the sixth power of the
// distance.
float farFormFactor(float3 point, float3 normal, const float3 corner[3]) {
  const float3 across = 0.5f * cross(corner[1] - corner[0], corner[2] - corner[0]);  // its length is the area
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

// Returns the form factor of a triangle as seen by a receiver.
float triangleFormFactor(float3 point, float3 normal, const float3 corner[3]) {
  return isFar(point, corner) ? farFormFactor(point, normal, corner) : nearFormFactor(point, normal, corner);
}

// Writes the corners of an emitter and returns the radiance, taken as uniform, that it sends to a point.
PRELIGHT_INLINE float3 evenEmitter(Lights l, PathScene s, uint emitter, float3 point, float3 corner[3]) {
  const uint triangle = l.emitters[emitter];
  const DeviceTriangle t = triangleAt(s.surface, triangle);
  for (int k = 0; k < 3; ++k) corner[k] = vertexPosition(s, t.vertex[k]);
#ifdef PRELIGHT_EMITTER_PARTS
  const float4 part = l.emitterParts[emitter];
  const float3 along = corner[1] - corner[0], across = corner[2] - corner[0];
  corner[0] += part.x * along + part.y * across;
  corner[1] = corner[0] + part.z * along;
  corner[2] = corner[0] + part.z * across;
#endif
  const bool front = -dot(corner[0] - point, cross(corner[1] - corner[0], corner[2] - corner[0])) > 0.0f;
#ifdef PRELIGHT_EMITTER_PARTS
  const bool emits = emitsOn(s.materials + t.material, front);
  return emits ? l.emitterRadiances[emitter].xyz : (float3)(0.0f);
#else
  const float3 way = (corner[0] + corner[1] + corner[2]) * (1.0f / 3.0f) - point;
  return emittedRadiance(s, triangle, 1.0f / 3.0f, 1.0f / 3.0f, front, normalize(way));
#endif
}

// Returns the irradiance of the emitters of a range, whose radiance is taken as uniform over each.
PRELIGHT_INLINE float3 openIrradiance(Lights l, EmitterRange range, PathScene s, float3 point, float3 normal) {
  float3 sum = (float3)(0.0f);
  for (uint i = 0u; i < range.count; ++i) {
    float3 corner[3];
    const float3 radiance = evenEmitter(l, s, range.first + i, point, corner);
    if (largest(radiance) > 0.0f) sum += M_PI_F * triangleFormFactor(point, normal, corner) * radiance;
  }
  return sum;
}
#endif

#endif
