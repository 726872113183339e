// How much of the sky a place sees, and around which direction.
#ifndef OPENNESS_GLSL
#define OPENNESS_GLSL

struct Openness {
  float accessibility;
  vec3 direction;  // no length: the surface's own normal
};

// Albedos of a surface's diffuse body.
struct Body {
  vec3 albedo;
  vec3 through;  // of light that leaves on the other side
};

// Whether light comes through the surface, of which transfer knows what arrives on either side.
bool passesKnownLight() { return hasTranslucency && translucency.a > 0.0 && knowsThrough != 0; }

#ifndef KNOWS_PASSAGE
// Returns the share of the light on a body's other side that passes through it. A technique that knows it defines KNOWS_PASSAGE.
vec3 passageHere() { return vec3(1.0); }
#endif

#endif
