#version 410 core
// Accessibility of a pixel as the share of points around it that no surface hides from the eye: Mittring, "Finding next
// gen: CryEngine 2", 2007, with points above the surface alone (Akenine-Moller et al., "Real-Time Rendering", 4th edition,
// 2018, 11.3.6), as dense about the normal as its cosine.
#include "frame.glsl"
#include "screen_space.glsl"

uniform int samples;

out vec4 outOpenness;  // xyz: none; w: accessibility

// Position of point i: a direction of cosine density and a distance, mostly near the radius: what hides a point there hides most
// of what lies on the way to it.
vec3 pointOf(int i, float turn, float shift) {
  float share = (float(i) + turn) / float(samples);
  float azimuth = 2.0 * pi * (fract(0.618034 * float(i)) + shift);
  float r = sqrt(share);
  float far = sqrt(sqrt(fract(0.7548777 * float(i) + turn + 0.5 * shift)));
  return far * vec3(r * cos(azimuth), r * sin(azimuth), sqrt(1.0 - share));
}

// Behind a surface's plane, too, as a pixel's depth is that of its middle, and not so far behind that the surface has nothing
// to do with the point.
bool isHidden(vec3 place) {
  if (isPerspective() && place.z <= 0.0) return false;
  Seen seen = seenIn(firstLayer, ivec2(floor(pixelOf(place))));
  vec3 way = place - seen.place;
  return seen.there && way.z > 0.0 && way.z < screen.z && dot(way, seen.normal) < -1e-4 * screen.z;
}

void main() {
  ivec2 pixel = pixelHere();
  ivec2 inPattern = placeInPattern();
  Seen here = seenIn(firstLayer, pixel);
  outOpenness = vec4(0.0, 0.0, 0.0, 1.0);
  if (!here.there) return;
  vec3 x, y;
  axesAround(here.normal, x, y);
  float turn = turnOf(inPattern);
  float shift = shiftOf(inPattern);
  float hidden = 0.0;
  for (int i = 0; i < samples; ++i) {
    vec3 point = pointOf(i, turn, shift);
    vec3 place = here.place + screen.z * (point.x * x + point.y * y + point.z * here.normal);
    if (isHidden(place)) hidden += 1.0;
  }
  outOpenness.w = 1.0 - resolution(here) * hidden / float(samples);
}
