// The openness of techniques that may know nothing of the sky but the light that arrives: where vertices do not have it, it is the
// arriving light's share of that of an open sky. Needs sky.glsl, shading_normal.glsl and
// arrivingHere().
#include "openness.glsl"

// Mean radiance around n of the sky that arrives: lamps that are lights are not a part of it, but of the sky's lobes.
vec3 openSkyAround(vec3 n) { return skyLevels.z > 0.5 ? ambientAround(n) : skyInLobe(n, widestSpread); }

float shareOfSky(vec3 arriving, vec3 n) {
  const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
  if (!hasSkyLight) return 0.0;
  return clamp(dot(arriving, luminance) / max(dot(openSkyAround(n), luminance), 1e-6), 0.0, 1.0);
}

// Mean radiance of what hides the sky, times its share: what arrives that is not the sky's.
vec3 hiddenHere(vec3 n, float ofSky) { return max(arrivingHere(n) - ofSky * openSkyAround(n), vec3(0.0)); }

Openness opennessHere() {
  if (vAccessibility >= 0.0) return Openness(vAccessibility, vec3(0.0));
  vec3 n = shadingNormal(vNormal);
  return Openness(shareOfSky(arrivingHere(n), n), vec3(0.0));
}
