// Light that arrives at places of the surface, in an encoding; needs triangles.glsl. Layers of a light map then hold
// three numbers each.
#include "core/dialect.h"
#include "encoding.glsl"
#include "light_map.glsl"
#include "surface_frame.glsl"

uniform TEXELS encodedVertices;  // [vertex][number]

// Irradiance of texels where a normal map turns the unit normal n to m.
vec3 encodedMapIrradiance(int triangle, bool front, vec3 point, vec3 n, vec3 m) {
  LightMapPlace place;
  if (!findLightMapPlace(triangle, front, point, place)) return vec3(0.0);
  float values[encodedValueCount];
  for (int i = 0; i < encodedValueCount; i += 3) {
    vec3 layer = lightMapLayer(place, i / 3);
    for (int k = 0; k < 3 && i + k < encodedValueCount; ++k) values[i + k] = layer[k];
  }
  return encodedIrradiance(values, surfaceFrame(n), m);
}

// Light of vertices is that of their fronts.
vec3 encodedVertexIrradiance(int triangle, vec3 point, vec3 n, vec3 m) {
  ivec3 corners = ivec3(FETCH(triangleCorners, triangle).xyz);
  vec3 weights = max(weightsOfCorners(corners, point), vec3(0.0));
  weights /= weights.x + weights.y + weights.z;
  ivec3 first = encodedValueCount * corners;
  float values[encodedValueCount];
  for (int i = 0; i < encodedValueCount; ++i) {
    values[i] = weights.x * FETCH(encodedVertices, first.x + i).x + weights.y * FETCH(encodedVertices, first.y + i).x +
                weights.z * FETCH(encodedVertices, first.z + i).x;
  }
  return encodedIrradiance(values, surfaceFrame(n), m);
}
