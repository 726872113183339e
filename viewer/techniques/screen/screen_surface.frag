#version 410 core
// Surface of a pixel for screen_space.glsl: xyz: its unit normal on the visible side, in camera space; w its
// depth, m, negative where it is a back.
#include "frame.glsl"
#include "variant.glsl"
#include "material.glsl"
#include "shading_normal.glsl"

in vec3 vPosition;
in vec3 vNormal;
in vec4 vTexCoords;
in vec4 vColor;

uniform sampler2D screenInput;  // the layer in front of this one
uniform int layer;              // 0: the nearest

out vec4 outSurface;

void main() {
  FragmentMaterial m = readMaterial(vTexCoords, vColor);
  if (hasCutouts && m.alpha < surfaceFactors.w) discard;
  float depth = dot(vPosition - eye.xyz, forward.xyz);
  // Surfaces that lie on one another are one.
  if (layer > 0 && depth <= abs(texelFetch(screenInput, ivec2(gl_FragCoord.xy), 0).w) * (1.0 + 1e-4)) discard;
  vec3 n = shadingNormal(vNormal);
  vec3 inCamera = vec3(dot(n, normalize(pixelRight.xyz)), dot(n, normalize(pixelUp.xyz)), dot(n, forward.xyz));
  outSurface = vec4(inCamera, gl_FrontFacing ? depth : -depth);
}
