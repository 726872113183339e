#version 410 core
// Averages what pixels of one surface found, over each place of their pattern of 4 x 4 once: a bilateral filter whose weights
// are of depths and normals (Tomasi and Manduchi 1998; Petschnigg et al. 2004). Where occlusion was not looked for at every pixel
// it is brought to all of them by the same weights (Kopf et al. 2007).
#include "frame.glsl"
#include "screen_space.glsl"
#include "screen_variant.glsl"
#include "screen_likeness.glsl"

uniform sampler2D found[3];
uniform int averages;  // 0: takes the nearest

layout(location = 0) out vec4 outFiltered[3];

const float reach = 2.5;       // of the filter, pixels of what was found
const float leastLike = 1e-4;  // what is of another surface counts only where nothing else is

void main() {
  ivec2 middle = ivec2(gl_FragCoord.xy) + corner.xy;
  Seen here = seenIn(firstLayer, middle);
  vec2 inFound = vec2(middle - corner.zw) / float(stride);
  ivec2 last = textureSize(found[0], 0) - 1;
  ivec2 nearest = clamp(ivec2(inFound + 0.5), ivec2(0), last);
  for (int k = 0; k < outputs; ++k) outFiltered[k] = texelFetch(found[k], nearest, 0);
  if (!here.there || averages == 0) return;
  float pixel = distance(here.place, placeOf(vec2(middle) + vec2(1.5, 0.5), here.place.z));
  vec4 sum[3] = vec4[3](vec4(0.0), vec4(0.0), vec4(0.0));
  float weights = 0.0;
  ivec2 from = ivec2(ceil(inFound)) - 2, to = ivec2(inFound) + 2;
  for (int y = from.y; y <= to.y; ++y)
    for (int x = from.x; x <= to.x; ++x) {
      vec2 border = clamp(reach - abs(vec2(x, y) - inFound), 0.0, 1.0);
      Seen there = seenIn(firstLayer, stride * ivec2(x, y) + corner.zw);
      float weight = border.x * border.y * max(likeness(here, there, pixel), there.there ? leastLike : 0.0);
      for (int k = 0; k < outputs; ++k) sum[k] += weight * texelFetch(found[k], clamp(ivec2(x, y), ivec2(0), last), 0);
      weights += weight;
    }
  if (weights <= 0.0) return;
  for (int k = 0; k < outputs; ++k) outFiltered[k] = sum[k] / weights;
}
