// Reflections of the surroundings of a surface, by the cube map of its node (viewer/cubes/surroundings.h); needs sky.glsl and
// lights.glsl.
#include "surroundings.glsl"
#include "lamp_reach.glsl"
uniform samplerCubeArray reflections;  // LobeCubes: [cube][narrower, wider] rgb: radiance of surfaces times alpha, a: share of the lobe

// Returns how much is known of what a point sees: nothing where something stands between it and the middle of the cube.
float aroundKnown(vec3 point) {
  if (cube < 0) return 0.0;
  vec3 from = point - cubeCenter;
  return smoothstep(0.94, 0.98, distanceSeen(surroundings, from) / max(length(from), 1e-20));
}

// Returns the share of a lamp's light that reaches a point past what lies around.
float lampAround(Light light, vec3 point) { return reachesNode(light, point) ? 1.0 : 0.0; }

// Lobe 0 is the narrowest.
vec4 surfacesInLobe(vec3 way, int lobe) { return textureLod(reflections, vec4(way, float(2 * cube + lobe % 2)), float(lobe / 2)); }

// Surfaces in a lobe of a spread as the middle of the cube sees them: as `reflections`. Between two lobes, and between the narrowest
// and the map itself, their mix has this spread.
vec4 surfacesAbout(vec3 way, float spread) {
  int count = 2 * int(log2(float(textureSize(reflections, 0).x)) - 1.5);  // two for each level down to a side of 8
  float place = log2(max(spread / widestSpread, 1e-9)) + float(count - 1);
  int narrow = clamp(int(place), 0, count - 2);
  vec4 filtered = surfacesInLobe(way, narrow);
  if (place >= 0.0) return mix(filtered, surfacesInLobe(way, narrow + 1), clamp(exp2(place - float(narrow)) - 1.0, 0.0, 1.0));
  vec4 sharp = textureLod(surroundings, vec4(way, float(cube)), 0.0);
  sharp = sharp.a < beyondScene ? vec4(sharp.rgb, 1.0) : vec4(0.0);
  return mix(sharp, filtered, exp2(place));
}

// Returns the mean radiance that arrives at a point in a lobe of a spread about a direction.
vec3 radianceAround(vec3 point, vec3 direction, float spread) {
  vec3 from = point - cubeCenter;
  float along = distanceAlong(surroundings, from, direction);
  vec3 seen = direction;
  float spreadSeen = spread;
  if (along < beyondScene) {  // what is near is a small part of the middle's view
    seen = from + along * direction;
    spreadSeen *= along * along / max(dot(seen, seen), 1e-30);
  }
  vec4 surfaces = surfacesAbout(seen, min(spreadSeen, widestSpread));
  return surfaces.rgb + (1.0 - surfaces.a) * skyInLobe(direction, spread);
}
