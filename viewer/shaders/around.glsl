// Nothing is known here of the surroundings of a reflecting surface. Where a cube map shows them, cubes/local_reflections.glsl takes the
// place of this text.

// Returns how much is known of what a point sees, 0..1.
float aroundKnown(vec3 point) { return 0.0; }

// Returns the share of a lamp's light that reaches a point past what lies around.
float lampAround(Light light, vec3 point) { return 1.0; }

// Returns the mean radiance that arrives at a point in a lobe of a spread about a direction.
vec3 radianceAround(vec3 point, vec3 direction, float spread) { return vec3(0.0); }
