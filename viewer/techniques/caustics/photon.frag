#version 410 core
// Adds a photon to the pixel whose surface it lies on.
#include "frame.glsl"
#include "surface_places.glsl"

flat in vec3 vPhoton;
flat in vec3 vPower;
flat in float vPlace;

uniform sampler2D surfacePlaces;

out vec4 outPower;  // rgb: W, a: photons

void main() {
  vec4 place = texelFetch(surfacePlaces, ivec2(gl_FragCoord.xy), 0);
  if (place.w == 0.0) discard;
  vec3 n = normalOfPlace(vPlace);
  bool together = dot(n, normalOfPlace(place.w)) > 0.5;
  if (!together || abs(dot(n, place.xyz - vPhoton)) > widthOfPixel(place.xyz)) discard;
  outPower = vec4(vPower, 1.0);
}
