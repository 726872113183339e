#version 410 core
// Irradiance of the photons around a pixel: their weighted power over the weighted area of the pixels that they may lie
// in, both by an Epanechnikov kernel of the distance on the surface. Dividing by the sum of the kernel over what is seen
// of the surface (Larsen 2004, Eq. 12.1 leaves it out) keeps brightness under zoom, slant and at silhouettes.
// The radius is that which holds about k photons, within bounds.
#include "frame.glsl"
#include "surface_places.glsl"

uniform sampler2D surfacePlaces;
uniform sampler2D photonPower;  // rgb: W, a: photons
uniform vec4 radii;             // greatest and least, m; k; greatest in pixels

out vec4 outIrradiance;

const int steps = 8;  // radii that are told apart, each of half the area of the one before

// Radius within which k photons lie, of what a window of pixels holds.
float radiusOfPhotons(ivec2 pixel, ivec2 window, vec4 here, float most) {
  float counts[steps];
  for (int s = 0; s < steps; ++s) counts[s] = 0.0;
  for (int y = -window.y; y <= window.y; ++y)
    for (int x = -window.x; x <= window.x; ++x) {
      float photons = texelFetch(photonPower, pixel + ivec2(x, y), 0).a;
      if (photons == 0.0) continue;
      vec3 way = texelFetch(surfacePlaces, pixel + ivec2(x, y), 0).xyz - here.xyz;
      float share = dot(way, way) / (most * most);
      if (share >= 1.0) continue;
      counts[min(int(-log2(max(share, 1e-9))), steps - 1)] += photons;
    }
  float inside = 0.0;
  for (int s = steps - 1; s >= 0; --s) {
    inside += counts[s];
    if (inside >= radii.z) return most * exp2(-0.5 * float(s));
  }
  return most;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 here = texelFetch(surfacePlaces, pixel, 0);
  if (here.w == 0.0) discard;
  vec3 n = normalOfPlace(here.w);
  float width = widthOfPixel(here.xyz);
  float most = clamp(radii.x, 1.5 * width, radii.w * width);
  ivec2 window = ivec2(min(ceil(most / width), radii.w));
  float r = clamp(radiusOfPhotons(pixel, window, here, most), max(radii.y, 1.5 * width), most);
  window = ivec2(min(ceil(r / width), radii.w));
  vec3 power = vec3(0.0);
  float area = 0.0;
  for (int y = -window.y; y <= window.y; ++y)
    for (int x = -window.x; x <= window.x; ++x) {
      vec4 there = texelFetch(surfacePlaces, pixel + ivec2(x, y), 0);
      vec3 way = there.xyz - here.xyz;
      float weight = 1.0 - dot(way, way) / (r * r);
      if (there.w == 0.0 || weight <= 0.0) continue;
      vec3 m = normalOfPlace(there.w);
      if (dot(n, m) < 0.5 || abs(dot(m, way)) > 0.5 * r) continue;
      power += weight * texelFetch(photonPower, pixel + ivec2(x, y), 0).rgb;
      area += weight * areaOfPixel(there.xyz, m);
    }
  outIrradiance = vec4(area > 0.0 ? power / area : vec3(0.0), 1.0);
}
