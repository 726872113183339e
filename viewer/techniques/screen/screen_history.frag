#version 410 core
// Joins what was found of a picture with what was found of those before it: each place is looked for where the last picture has
// it (Scherzer et al., "A survey on temporal coherence methods in real-time rendering", 2011), and what it has there counts where
// it is of the same surface. Where the scene moves, it counts as far as it lies within what the pixels around have now (Karis,
// "High-quality temporal supersampling", 2014), as more than places may have changed.
#include "frame.glsl"
#include "screen_space.glsl"
#include "screen_variant.glsl"
#include "screen_likeness.glsl"

uniform sampler2D now[3];
uniform sampler2D past[3];
uniform sampler2D pastSurface;  // xy: unit normal in the past camera's space, whose z is negative; z: depth, m; w: pictures joined, 0: nothing seen
uniform mat4 pastClipFromScene;
uniform vec4 pastEye, pastForward, pastRight, pastUp;  // as those of Frame
uniform vec4 pastScreen;                               // xy: size of the past layers; z: the past picture's corner in them
uniform int most;                                      // pictures that are joined; 1: there is no past
uniform int moves;                                     // 1: the scene does

layout(location = 0) out vec4 outJoined[4];  // after what was found: as pastSurface

const float mostMoving = 4.0;  // pictures that count while the scene moves

// Values of earlier pictures at a place.
struct Past {
  vec4 found[3];
  float pictures;  // 0: nothing of this surface
};

// In the past camera's space.
vec3 toPast(vec3 scene) {
  return vec3(dot(scene, normalize(pastRight.xyz)), dot(scene, normalize(pastUp.xyz)), dot(scene, pastForward.xyz));
}

// 1 where the past pixel shows a place, m, with a normal, both in its camera's space.
float isSame(ivec2 at, vec3 place, vec3 normal, float pixel) {
  if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, textureSize(pastSurface, 0)))) return 0.0;
  vec4 surface = texelFetch(pastSurface, at, 0);
  if (surface.w < 0.5) return 0.0;
  vec3 n = vec3(surface.xy, -sqrt(max(1.0 - dot(surface.xy, surface.xy), 0.0)));
  // A neighbour lies on the same plane, a pixel beside.
  float slope = max(abs(normal.z), 0.1);
  return dot(n, normal) > 0.9 && abs(surface.z - place.z) < 2.0 * pixel / slope ? 1.0 : 0.0;
}

Past pastOf(Seen here, float pixel) {
  Past none = Past(vec4[3](vec4(0.0), vec4(0.0), vec4(0.0)), 0.0);
  vec3 scene = eye.xyz + toScene(here.place);
  vec4 clip = pastClipFromScene * vec4(scene, 1.0);
  if (clip.w <= 0.0) return none;
  vec2 at = 0.5 * (clip.xy / clip.w + 1.0) * pastScreen.xy - pastScreen.z - 0.5;
  // A picture that stands still is not to be blurred by rounding.
  vec2 whole = floor(at + 0.5);
  if (all(lessThan(abs(at - whole), vec2(0.01)))) at = whole;
  vec3 place = toPast(scene - pastEye.xyz), normal = toPast(toScene(here.normal));
  ivec2 first = ivec2(floor(at));
  vec2 between = at - vec2(first);
  float weights = 0.0;
  Past sum = none;
  for (int i = 0; i < 4; ++i) {
    ivec2 tap = ivec2(i & 1, i >> 1);
    vec2 share = mix(1.0 - between, between, vec2(tap));
    float weight = share.x * share.y * isSame(first + tap, place, normal, pixel);
    ivec2 inside = clamp(first + tap, ivec2(0), textureSize(pastSurface, 0) - 1);
    for (int k = 0; k < outputs; ++k) sum.found[k] += weight * texelFetch(past[k], inside, 0);
    sum.pictures += weight * texelFetch(pastSurface, inside, 0).w;
    weights += weight;
  }
  if (weights < 0.1) return none;
  for (int k = 0; k < outputs; ++k) sum.found[k] /= weights;
  sum.pictures /= weights;
  return sum;
}

// The past within what 3 x 3 pixels of the surface have now.
void cutToNow(Seen here, ivec2 middle, float pixel, inout Past before) {
  ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(now[0], 0) - 1;
  vec4 least[3], greatest[3];
  for (int k = 0; k < outputs; ++k) least[k] = greatest[k] = texelFetch(now[k], at, 0);
  for (int i = 0; i < 9; ++i) {
    ivec2 beside = ivec2(i % 3, i / 3) - 1;
    if (likeness(here, seenIn(firstLayer, middle + beside), pixel) < 0.5) continue;
    for (int k = 0; k < outputs; ++k) {
      vec4 value = texelFetch(now[k], clamp(at + beside, ivec2(0), last), 0);
      least[k] = min(least[k], value);
      greatest[k] = max(greatest[k], value);
    }
  }
  for (int k = 0; k < outputs; ++k) before.found[k] = clamp(before.found[k], least[k], greatest[k]);
  before.pictures = min(before.pictures, mostMoving - 1.0);
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  ivec2 middle = at + corner.xy;
  Seen here = seenIn(firstLayer, middle);
  for (int k = 0; k < outputs; ++k) outJoined[k] = texelFetch(now[k], at, 0);
  outJoined[outputs] = vec4(here.normal.xy, here.place.z, 0.0);
  if (!here.there) return;
  float pixel = distance(here.place, placeOf(vec2(middle) + vec2(1.5, 0.5), here.place.z));
  Past before = Past(vec4[3](vec4(0.0), vec4(0.0), vec4(0.0)), 0.0);
  if (most > 1) before = pastOf(here, pixel);
  if (moves != 0) cutToNow(here, middle, pixel, before);
  float pictures = min(before.pictures + 1.0, float(most));
  if (before.pictures > 0.0)
    for (int k = 0; k < outputs; ++k) outJoined[k] = mix(before.found[k], outJoined[k], 1.0 / pictures);
  outJoined[outputs].w = pictures;
}
