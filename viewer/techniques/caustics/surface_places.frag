#version 410 core
// Where the surface of every pixel is; see surface_places.glsl.
#include "frame.glsl"
#include "variant.glsl"
#include "material.glsl"

in vec3 vPosition;
in vec4 vTexCoords;
in vec4 vColor;

out vec4 outPlace;

void main() {
  FragmentMaterial m = readMaterial(vTexCoords, vColor);
  if (hasCutouts && m.alpha < surfaceFactors.w) discard;
  float number = float(firstTriangle + gl_PrimitiveID + 1);
  outPlace = vec4(vPosition, gl_FrontFacing ? number : -number);
}
