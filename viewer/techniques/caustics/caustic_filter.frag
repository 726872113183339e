#version 410 core
// Irradiance of the photons around a pixel: their weighted power over the weighted area of the pixels that they may lie
// in, both by an Epanechnikov kernel of the distance on the surface. Dividing by the sum of the kernel over what is seen
// of the surface (Larsen 2004, Eq. 12.1 leaves it out) keeps brightness under zoom, slant and at silhouettes.
// The radius is that which holds about k photons, within bounds, and a length in the scene. A window of texels covers it
// at the finest level where it spans no more than the window does; levels are filtered from coarse to fine.
#include "frame.glsl"
#include "surface_places.glsl"

uniform sampler2D finestPlaces;   // places of level 0
uniform sampler2D surfacePlaces;  // places of the level
uniform sampler2D photonPower;    // rgb: W, a: photons
uniform ivec4 level;              // xy: pixels from the level's corner to that of level 0, z: log2 of the pixels of a texel's side
uniform vec4 radii;               // greatest and least, m; k; greatest in texels

out vec4 outIrradiance;

const int steps = 8;  // radii that are told apart, each of half the area of the one before

// Radius within which k photons lie, of what a window of texels holds. Photons between two steps count as spread evenly.
float radiusOfPhotons(ivec2 texel, ivec2 window, vec4 here, float most) {
  float counts[steps];
  for (int s = 0; s < steps; ++s) counts[s] = 0.0;
  for (int y = -window.y; y <= window.y; ++y)
    for (int x = -window.x; x <= window.x; ++x) {
      float photons = texelFetch(photonPower, texel + ivec2(x, y), 0).a;
      if (photons == 0.0) continue;
      vec3 way = texelFetch(surfacePlaces, texel + ivec2(x, y), 0).xyz - here.xyz;
      float share = dot(way, way) / (most * most);
      if (share >= 1.0) continue;
      counts[min(int(-log2(max(share, 1e-9))), steps - 1)] += photons;
    }
  float inside = 0.0;
  for (int s = steps - 1; s >= 0; --s) {
    float inner = s == steps - 1 ? 0.0 : exp2(-float(s + 1));
    if (inside + counts[s] >= radii.z)
      return most * sqrt(mix(inner, exp2(-float(s)), (radii.z - inside) / counts[s]));
    inside += counts[s];
  }
  return most;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 here = texelFetch(finestPlaces, pixel, 0);
  if (here.w == 0.0) discard;
  vec3 n = normalOfPlace(here.w);
  ivec2 texel = (pixel + level.xy) >> level.z;
  float finest = widthOfPixel(here.xyz);
  float side = exp2(float(level.z));
  float width = side * finest;
  float most = clamp(radii.x, 1.5 * finest, radii.w * width);
  ivec2 window = ivec2(min(ceil(most / width), radii.w));
  float r = clamp(radiusOfPhotons(texel, window, here, most), max(radii.y, 1.5 * finest), most);
  if (level.z > 0 && r <= 0.5 * radii.w * width) discard;  // a finer level covers it
  window = ivec2(min(ceil(r / width), radii.w));
  vec3 power = vec3(0.0);
  float area = 0.0;
  for (int y = -window.y; y <= window.y; ++y)
    for (int x = -window.x; x <= window.x; ++x) {
      vec4 there = texelFetch(surfacePlaces, texel + ivec2(x, y), 0);
      vec3 way = there.xyz - here.xyz;
      float weight = 1.0 - dot(way, way) / (r * r);
      if (there.w == 0.0 || weight <= 0.0) continue;
      vec3 m = normalOfPlace(there.w);
      if (dot(n, m) < 0.5 || abs(dot(m, way)) > 0.5 * r) continue;
      power += weight * texelFetch(photonPower, texel + ivec2(x, y), 0).rgb;
      area += weight * side * side * areaOfPixel(there.xyz, m);
    }
  outIrradiance = vec4(area > 0.0 ? power / area : vec3(0.0), 1.0);
}
