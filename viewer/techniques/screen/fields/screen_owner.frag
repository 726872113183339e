#version 410 core
// Whose surface a pixel sees: x the number of its object plus 1, y how open it is among nothing but that object.
#include "frame.glsl"
#include "variant.glsl"
#include "material.glsl"

in vec3 vPosition;
in vec4 vTexCoords;
in vec4 vColor;
in float vAccessibility;

uniform samplerBuffer owners;  // [triangle]

out vec4 outOwner;

void main() {
  FragmentMaterial m = readMaterial(vTexCoords, vColor);
  if (hasCutouts && m.alpha < surfaceFactors.w) discard;
  outOwner = vec4(texelFetch(owners, firstTriangle + gl_PrimitiveID).x + 1.0, clamp(vAccessibility, 0.0, 1.0), 0.0, 1.0);
}
