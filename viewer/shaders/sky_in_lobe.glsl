// Radiance that arrives about a direction in a lobe of a roughness and a spread: the sky's, past what skyVisibility() knows.
vec3 radianceFrom(Visibility seen, vec3 direction, float roughness, float spread) {
  return skyVisibility(seen, direction, roughness) * skyInLobe(direction, spread);
}

// The sky's radiance that comes through a surface from behind it, as blurred as by a lobe of a roughness, and `known`: how much of
// what lies there is the sky. Nothing is known of what lies behind but how open the surface is on its own side.
vec3 radianceBehind(Visibility seen, vec3 direction, float roughness, out float known) {
  known = hasSkyLight ? seen.ofSky : 0.0;
  return known * skyInLobe(direction, spreadOfRoughness(roughness));
}
