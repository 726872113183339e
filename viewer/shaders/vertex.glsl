// Attributes of a vertex in surface.vert.
struct Vertex {
  vec3 position;
  vec3 normal;
  vec4 texCoords;  // the file's two sets
  vec3 openness;
  vec4 color;
  float accessibility;
  vec4 bentNormal;
  vec3 radiance;
  vec3 glow;
  vec4 chartCoord;
  vec3 reflected;  // or what arrives on the other side
  float highlight;
};

#ifdef GL_ES
// Fetched by corners of triangles, so that each triangle has vertices, and a number, of its own.
#include "core/dialect.h"
uniform UTEXELS triangleCorners;  // [triangle], vertices
uniform TEXELS cornerPositions;
uniform TEXELS vertexNormals;
uniform TEXELS vertexTexCoords;
uniform TEXELS vertexColors;
uniform TEXELS vertexOpen;       // bent normal, accessibility
uniform TEXELS vertexLight;      // [vertex][lightStride]: radiance and highlight, reflected and the bent normal's aperture
uniform TEXELS vertexGlow;
uniform TEXELS vertexLightNext;  // the same of the next key of an animation
uniform int lightStride;         // 0: there is none
uniform float lightShare;        // of the next key
uniform ivec4 vertexHas;         // x: texture coordinates, y: colours, z: a bent normal, w: glow
uniform TEXELS vertexCharts;
uniform int vertexHasCharts;

flat out int vTriangle;

Vertex readVertex() {
  vTriangle = gl_VertexID / 3;
  int v = int(FETCH(triangleCorners, vTriangle)[gl_VertexID % 3]);
  vec4 open = FETCH(vertexOpen, v);
  vec4 light = vec4(0.0, 0.0, 0.0, 1.0);
  if (lightStride > 0) light = mix(FETCH(vertexLight, v * lightStride), FETCH(vertexLightNext, v * lightStride), lightShare);
  vec4 last = lightStride > 1 ? FETCH(vertexLight, v * lightStride + lightStride - 1) : vec4(0.0);
  Vertex vertex;
  vertex.position = FETCH(cornerPositions, v).xyz;
  vertex.normal = FETCH(vertexNormals, v).xyz;
  vertex.texCoords = vertexHas.x != 0 ? FETCH(vertexTexCoords, v) : vec4(0.0);
  vertex.openness = vec3(1.0);
  vertex.color = vertexHas.y != 0 ? FETCH(vertexColors, v) : vec4(1.0);
  vertex.accessibility = open.w;
  vertex.bentNormal = vertexHas.z != 0 ? vec4(open.xyz, last.w) : vec4(0.0);
  vertex.radiance = light.rgb;
  vertex.glow = vertexHas.w != 0 ? FETCH(vertexGlow, v).rgb : vec3(1.0);
  vertex.chartCoord = vertexHasCharts != 0 ? FETCH(vertexCharts, v) : vec4(0.0);
  vertex.reflected = last.rgb;
  vertex.highlight = lightStride > 1 ? light.w : 1.0;
  return vertex;
}
#else
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 texCoords;
layout(location = 3) in vec3 openness;
layout(location = 4) in vec4 color;
layout(location = 5) in float accessibility;
layout(location = 6) in vec4 bentNormal;
layout(location = 7) in vec3 radiance;
layout(location = 8) in vec3 glow;
layout(location = 9) in vec4 chartCoord;
layout(location = 10) in vec3 reflected;
layout(location = 11) in float highlight;

Vertex readVertex() {
  return Vertex(position, normal, texCoords, openness, color, accessibility, bentNormal, radiance, glow, chartCoord, reflected,
                highlight);
}
#endif
