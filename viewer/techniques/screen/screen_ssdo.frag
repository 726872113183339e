#version 410 core
// Light that reaches a pixel past the surfaces around it and from them: the directional occlusion and the bounce of Ritschel,
// Grosch and Seidel, "Approximating dynamic global illumination in image space", 2009, whose points are replaced by the slices
// of screen_slices.glsl: what a slice leaves open lets the sky of its directions through, and what blocks it sends what it
// receives itself. The light of the whole sky is known, so that slices tell only which share of it arrives.
#include "frame.glsl"
#include "variant.glsl"
#include "sky.glsl"
#include "light_block.glsl"
#include "screen_space.glsl"
#include "screen_variant.glsl"
#include "screen_slices.glsl"

layout(location = 0) out vec4 outSky;     // rgb: irradiance of the sky over pi; w: accessibility
layout(location = 1) out vec4 outLamps;   // share of each of the first lamps that arrives
layout(location = 2) out vec4 outBounce;  // rgb: irradiance over pi from the surfaces seen

// The sky's radiance without lamps that are lights: the map holds them, the three bands do not.
vec3 radianceBetweenLamps(vec3 direction, float level) {
  return skyLevels.z > 0.5 ? ambientInCone(direction, 1.0) : skyRadiance(direction, level);
}

// The sky of a slice in sectors times radiance: what is open of it, and all.
void addSky(Slice s, uint open, float level, inout vec3 arriving, inout vec3 sky) {
  for (int i = 0; i < parts; ++i) {
    vec3 direction;
    uint part = partOf(s, i, direction);
    vec3 radiance = s.weight * radianceBetweenLamps(toScene(direction), level);
    arriving += float(bitCount(part & open)) * radiance;
    sky += float(bitCount(part)) * radiance;
  }
}

vec3 toCamera(vec3 direction) {
  return vec3(dot(direction, normalize(pixelRight.xyz)), dot(direction, normalize(pixelUp.xyz)), dot(direction, forward.xyz));
}

const int lampSteps = 4;  // as many times as many: one direction tells all of a lamp

// 0 where something within the radius, and no farther than the lamp, lies on the way to it: a slice of its own whose sectors are
// as narrow as its direction is to be told.
float arrivingFrom(Light light, vec2 start, Seen here, vec3 v, float shift) {
  bool isDirectional = int(light.positionKind.w + 0.5) == kindDirectional;
  vec3 path = isDirectional ? -light.directionArea.xyz : light.positionKind.xyz - eye.xyz - toScene(here.place);
  vec3 way = toCamera(normalize(path));
  vec3 aside = way - dot(way, v) * v;
  if (dot(way, here.normal) <= leastRise || dot(aside, aside) < 1e-8) return 1.0;
  Slice s = sliceOf(here.normal, v, normalize(aside), 0.0);
  vec2 at = vec2(dot(way, s.d), dot(way, s.v));
  s.range /= 16.0;
  s.first = massTo(quickAcos(at.y), at, s.n) - s.range * 17.0 / float(sectors);
  if (!isDirectional) s.radius = min(s.radius, length(path));
  vec3 received = vec3(0.0);
  return (blockedSectors(s, start, here, 1.0, lampSteps * steps, shift, received) & (1u << 16)) == 0u ? 1.0 : 0.0;
}

void main() {
  ivec2 pixel = pixelHere();
  ivec2 inPattern = placeInPattern();
  Seen here = seenIn(firstLayer, pixel);
  outSky = vec4(0.0, 0.0, 0.0, 1.0);
  outLamps = vec4(1.0);
  outBounce = vec4(0.0);
  if (!here.there) return;
  vec3 v = toEyeFrom(here.place);
  vec3 x, y;
  axesAround(v, x, y);
  float turn = turnOf(inPattern);
  float shift = shiftOf(inPattern);
  float level = levelOfSolidAngle(2.0 * pi / float(slices * parts));
  vec3 arriving = vec3(0.0), sky = vec3(0.0), received = vec3(0.0);
  float open = 0.0;
  float whole = 0.0;
  for (int i = 0; i < slices; ++i) {
    Slice s = sliceNumber(i, here, v, x, y, turn);
    if (!(s.weight > 1e-5)) continue;
    vec3 fromSlice = vec3(0.0);
    uint free = ~blockedSectors(s, vec2(pixel) + 0.5, here, shift, fromSlice);
    whole += s.weight;
    open += s.weight * float(bitCount(free)) / float(sectors);
    received += s.weight / float(sectors) * fromSlice;
    addSky(s, free, level, arriving, sky);
  }
  float known = resolution(here);
  vec3 share = whole > 0.0 ? mix(vec3(1.0), arriving / max(sky, vec3(1e-20)), known) : vec3(1.0);
  outSky = vec4(ambientAround(toScene(here.normal)) * share, whole > 0.0 ? mix(1.0, open / whole, known) : 1.0);
  for (int k = 0; k < shadowedLamps; ++k)
    outLamps[k] = mix(1.0, arrivingFrom(lights[k], vec2(pixel) + 0.5, here, v, shift), known);
  if (gathers && whole > 0.0) outBounce.rgb = known * received / whole;
}
