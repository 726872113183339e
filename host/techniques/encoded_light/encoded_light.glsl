// Light that arrives at places of the surface, in an encoding; needs triangles.glsl. Layers of a light map then hold
// three numbers each.
#include "core/dialect.h"
#include "encoding.glsl"
#include "light_map.glsl"
#include "surface_frame.glsl"

uniform TEXELS encodedVertices;  // [vertex][number]

// Numbers of a place, and the frame that they are relative to.
struct EncodedPlace {
  float values[encodedValueCount];
  mat3 frame;
  bool known;  // false: the surface has none, and they are 0
};

// Numbers of texels. n: the surface's unit normal of the side.
EncodedPlace encodedOfMap(int triangle, bool front, vec3 point, vec3 n) {
  EncodedPlace found;
  found.frame = surfaceFrame(n);
  for (int i = 0; i < encodedValueCount; ++i) found.values[i] = 0.0;
  LightMapPlace place;
  found.known = findLightMapPlace(triangle, front, point, place);
  if (!found.known) return found;
  for (int i = 0; i < encodedValueCount; i += 3) {
    vec3 layer = lightMapLayer(place, i / 3);
    for (int k = 0; k < 3 && i + k < encodedValueCount; ++k) found.values[i + k] = layer[k];
  }
  return found;
}

// Numbers of vertices, which are those of their fronts.
EncodedPlace encodedOfVertices(int triangle, vec3 point, vec3 n) {
  ivec3 corners = ivec3(FETCH(triangleCorners, triangle).xyz);
  vec3 weights = max(weightsOfCorners(corners, point), vec3(0.0));
  weights /= weights.x + weights.y + weights.z;
  ivec3 first = encodedValueCount * corners;
  EncodedPlace found;
  found.frame = surfaceFrame(n);
  found.known = true;
  for (int i = 0; i < encodedValueCount; ++i) {
    found.values[i] = weights.x * FETCH(encodedVertices, first.x + i).x + weights.y * FETCH(encodedVertices, first.y + i).x +
                      weights.z * FETCH(encodedVertices, first.z + i).x;
  }
  return found;
}

// Irradiance where a normal map turns the normal to m.
vec3 irradianceOfEncoded(EncodedPlace place, vec3 m) {
  return place.known ? encodedIrradiance(place.values, place.frame, m) : vec3(0.0);
}
