#version 410 core
// Accessibility of a pixel from the horizons of directions around it, without the cosine: Bavoil et al., "Image-space
// horizon-based ambient occlusion", 2008; Akenine-Moller et al., "Real-Time Rendering", 4th edition, 2018, Eq. 11.17.
#include "frame.glsl"
#include "screen_space.glsl"

uniform int slices;  // a direction and its opposite each
uniform int steps;   // of a direction

out vec4 outOpenness;  // xyz: none; w: accessibility

// Returns the occlusion along a direction, 0 to 1: each rise of the horizon counts by how near it is.
float occlusionAlong(vec2 start, Seen here, vec3 v, vec3 d, float shift) {
  vec3 tangent = d * dot(here.normal, v) - v * dot(here.normal, d);
  float horizon = dot(normalize(tangent), v);
  float sum = 0.0;
  Line line = lineAlong(start, here.place, d);
  for (int j = 0; j < steps; ++j) {
    float along = stepAlong(line, j, steps, shift);
    if (along > line.length + 0.5) break;
    Seen now = seenOn(firstLayer, line, along);
    if (!now.there) continue;
    vec3 way = now.place - here.place;
    float share = dot(way, way) / (screen.z * screen.z);
    float rise = dot(way, v) * inversesqrt(max(dot(way, way), tiny));
    if (share >= 1.0 || rise <= horizon) continue;
    sum += (1.0 - share) * (rise - horizon);
    horizon = rise;
  }
  return sum;
}

void main() {
  ivec2 pixel = pixelHere();
  ivec2 inPattern = placeInPattern();
  Seen here = seenIn(firstLayer, pixel);
  outOpenness = vec4(0.0, 0.0, 0.0, 1.0);
  if (!here.there) return;
  vec3 v = toEyeFrom(here.place);
  vec3 x, y;
  axesAround(v, x, y);
  float turn = turnOf(inPattern);
  float shift = shiftOf(inPattern);
  float sum = 0.0;
  for (int i = 0; i < 2 * slices; ++i) {
    float angle = pi * (float(i) + turn) / float(slices);
    sum += occlusionAlong(vec2(pixel) + 0.5, here, v, cos(angle) * x + sin(angle) * y, i < slices ? shift : 1.0 - shift);
  }
  outOpenness.w = clamp(1.0 - resolution(here) * sum / float(2 * slices), 0.0, 1.0);
}
