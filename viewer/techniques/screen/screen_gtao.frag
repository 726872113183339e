#version 410 core
// Accessibility of a pixel and its mean open direction from slices through the direction to the eye: Jimenez et al., "Practical
// real-time strategies for accurate indirect occlusion", 2016.
#include "frame.glsl"
#include "screen_space.glsl"
#include "screen_variant.glsl"
#include "screen_slices.glsl"

layout(location = 0) out vec4 outOpenness;  // xyz: mean open direction, scene; w: accessibility

// The open sectors' directions, times their share of the slice.
vec3 openDirection(Slice s, uint open) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < parts; ++i) {
    vec3 direction;
    uint part = partOf(s, i, direction);
    sum += float(bitCount(open & part)) * direction;
  }
  return sum / float(sectors);
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
  vec3 direction = vec3(0.0);
  vec3 received = vec3(0.0);  // nothing
  float open = 0.0;
  float whole = 0.0;
  for (int i = 0; i < slices; ++i) {
    Slice s = sliceNumber(i, here, v, x, y, turn);
    if (!(s.weight > 1e-5)) continue;
    uint free = ~blockedSectors(s, vec2(pixel) + 0.5, here, shift, received);
    whole += s.weight;
    open += s.weight * float(bitCount(free)) / float(sectors);
    direction += s.weight * openDirection(s, free);
  }
  if (whole > 0.0) outOpenness = vec4(toScene(direction / whole), mix(1.0, open / whole, resolution(here)));
}
