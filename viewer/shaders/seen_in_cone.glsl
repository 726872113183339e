// What is seen through the cone of a Visibility (cone_visibility.glsl) with the members cone, normal and ofSky: suns have the share of
// all the sky, and only the shells of near lamps shadow lamps.
float lampVisibility(Visibility seen, int k, Light light, vec3 toLight, float radius) { return isOfSky(light) ? seen.ofSky : 1.0; }

float skyVisibility(Visibility seen, vec3 direction, float roughness) {
  return openShareOfLobe(seen.cone, seen.normal, roughness, direction);
}

#include "sky_in_lobe.glsl"
