#version 410 core
// Accessibility of a pixel by the fields of all objects but its own, and by what its own hides of itself. What several hide is
// multiplied, as Kontkanen and Laine, "Ambient occlusion fields", 2005, do.
#include "frame.glsl"
#include "screen_space.glsl"
#include "fields.glsl"

out vec4 outOpenness;  // xyz: mean open direction, scene; w: accessibility

void main() {
  ivec2 pixel = pixelHere();
  Seen here = seenIn(firstLayer, pixel);
  outOpenness = vec4(0.0, 0.0, 0.0, 1.0);
  if (!here.there) return;
  vec3 n = normalize(toScene(here.normal)), place = eye.xyz + toScene(here.place);
  vec4 owner = texelFetch(secondLayer, pixel, 0);
  // The mean direction of an open hemisphere, weighted by the cosine, is 2/3 n.
  vec3 open = 2.0 / 3.0 * n;
  float accessibility = owner.y;
  int count = textureSize(fieldPlaces) / 4;
  for (int o = 0; o < count; ++o) {
    if (o == int(owner.x + 0.5) - 1) continue;
    vec4 hidden = hiddenByObject(o, place, n);
    open -= hidden.w * hidden.xyz;
    accessibility *= 1.0 - hidden.w;
  }
  outOpenness = vec4(open * inversesqrt(max(dot(open, open), 1e-30)), clamp(accessibility, 0.0, 1.0));
}
