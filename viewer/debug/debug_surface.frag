#version 410 core
// A surface in a colour that stands for data of it, unlit.
#include "frame.glsl"
#include "variant.glsl"
#include "material.glsl"
#include "triangles.glsl"
#include "normal_map.glsl"
#include "shading_normal.glsl"

in vec3 vPosition;
in vec3 vNormal;
in vec4 vTexCoords;
in vec4 vColor;

uniform int coloring;             // Coloring of debug/surface_colors.h
uniform int frontFaces;           // fronts of triangles, then their backs
uniform int mapWidth;             // texels
uniform float brightness;
uniform TEXELS lightMapCorners;   // [face][3] texels from the upper left; x < 0: the face has none
uniform TEXELS debugColors;       // [face] or [y][x]

out vec4 outRadiance;  // alpha: distance from the eye

const vec3 unknown = vec3(0.03);  // of what has no texels

vec3 colorOfCoordinates(vec2 uv) {
  ivec2 cell = ivec2(floor(8.0 * uv));
  return vec3(fract(uv), 0.1) * (((cell.x + cell.y) & 1) == 0 ? 1.0 : 0.5);
}

vec3 colorOfTexel(int face, int triangle) {
  vec2 first = FETCH(lightMapCorners, 3 * face).xy;
  if (first.x < 0.0) return unknown;
  vec3 weights = max(weightsOfCorners(ivec3(FETCH(triangleCorners, triangle).xyz), vPosition), vec3(0.0));
  weights /= weights.x + weights.y + weights.z;
  vec2 place = weights.x * first + weights.y * FETCH(lightMapCorners, 3 * face + 1).xy +
               weights.z * FETCH(lightMapCorners, 3 * face + 2).xy;
  return FETCH(debugColors, int(place.y) * mapWidth + int(place.x)).rgb;
}

vec3 colorHere(FragmentMaterial m) {
  int triangle = triangleHere();
  int face = gl_FrontFacing ? triangle : frontFaces + triangle;
  if (coloring == 0) return 0.5 + 0.5 * bumpedNormal(shadingNormal(vNormal), vPosition, triangle, vTexCoords);
  if (coloring == 1) return colorOfCoordinates(vTexCoords.xy);
  if (coloring == 2) return m.base;
  if (coloring == 3) return FETCH(debugColors, face).rgb;
  return colorOfTexel(face, triangle);
}

void main() {
  FragmentMaterial m = readMaterial(vTexCoords, vColor);
  if (hasCutouts && m.alpha < surfaceFactors.w) discard;
  outRadiance = vec4(brightness * colorHere(m), distance(eye.xyz, vPosition));
}
