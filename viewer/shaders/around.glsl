// What lies around a reflecting surface: here nothing is known of it. Where a cube map shows it, cubes/local_reflections.glsl takes the
// place of this text.

// Returns how much is known of what a point sees, 0..1.
float aroundKnown(vec3 point) { return 0.0; }

// Returns the share of a lamp's light that reaches a point past what lies around.
float lampAround(Light light, vec3 point) { return 1.0; }

// Returns the mean radiance that arrives at a point in a lobe of a spread about a direction.
vec3 radianceAround(vec3 point, vec3 direction, float spread) { return vec3(0.0); }
