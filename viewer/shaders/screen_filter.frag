#version 410 core
// Averages what pixels of one surface found, over each place of their pattern of 4 x 4 once: a bilateral filter whose weights
// are of depths and normals (Tomasi and Manduchi 1998; Petschnigg et al. 2004).
#include "frame.glsl"
#include "screen_space.glsl"

uniform sampler2D openness;
uniform int reach;     // of the filter, pixels
uniform int averages;  // 0: leaves all as it is

out vec4 outOpenness;

// Of a place that is no farther from the plane of another than a pixel is wide, with a normal like its own.
float likeness(Seen a, Seen b, float pixel) {
  if (!b.there) return 0.0;
  float away = abs(dot(a.normal, b.place - a.place)) / pixel;
  return max(1.0 - 0.5 * away, 0.0) * smoothstep(0.8, 0.95, dot(a.normal, b.normal));
}

void main() {
  ivec2 middle = ivec2(gl_FragCoord.xy) + corner.xy;
  Seen here = seenIn(firstLayer, middle);
  ivec2 inInput = ivec2(gl_FragCoord.xy) + reach;
  vec4 own = texelFetch(openness, inInput, 0);
  outOpenness = own;
  if (!here.there || averages == 0) return;
  float pixel = distance(here.place, placeOf(vec2(middle) + vec2(1.5, 0.5), here.place.z));
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      float border = (abs(x) == reach ? 0.5 : 1.0) * (abs(y) == reach ? 0.5 : 1.0);
      float weight = border * likeness(here, seenIn(firstLayer, middle + ivec2(x, y)), pixel);
      sum += weight * texelFetch(openness, inInput + ivec2(x, y), 0);
      weights += weight;
    }
  outOpenness = weights > 0.0 ? sum / weights : own;
}
