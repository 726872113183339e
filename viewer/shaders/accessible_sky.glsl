// The sky above a surface over the share of it that is accessible; needs sky.glsl, parts.glsl and cones.glsl.
// [1] Akenine-Moller et al., "Real-Time Rendering", 4th edition, 2018, 11.3.
// [2] Jimenez et al., "Practical real-time strategies for accurate indirect occlusion", 2016: a fit to traced scenes.
#include "openness.glsl"
#include "cones.glsl"

const int correctionNone = 0;
const int correctionByCrease = 1;
const int correctionByCubic = 2;

// Accessibility with the light that surfaces nearby send on, taken to be of the same albedo ([1] Eq. 11.13, [2]).
vec3 correctedAccessibility(float accessibility, vec3 albedo) {
  if (aoCorrection == correctionByCubic) {
    vec3 cubic = 2.0404 * albedo - 0.3324, square = 0.6417 - 4.7951 * albedo, linear = 2.7552 * albedo + 0.6903;
    vec3 fitted = ((cubic * accessibility + square) * accessibility + linear) * accessibility;
    return clamp(fitted, vec3(accessibility), vec3(1.0));  // [2] clamps below
  }
  if (aoCorrection != correctionByCrease) return vec3(accessibility);
  return vec3(accessibility) / max(vec3(1.0) - albedo * (1.0 - accessibility), vec3(1e-6));
}

// Reflections show what hides the sky as surfaces that are as open and reflect half of the sky's mean light.
vec3 hiddenHere(vec3 n, float ofSky) { return 0.5 * ofSky * (1.0 - ofSky) * 0.282094792 * ambient[0].rgb; }

const int filterCone = 0;

// The sky's mean over what is accessible; n: with bumps, for where no direction is known. The filter's middle is the bent
// normal, and its size depends on the accessibility ([1] 11.3.7).
vec3 accessibleSky(Openness open, vec3 n) {
  if (dot(open.direction, open.direction) <= 1e-12) return ambientAround(n);
  vec3 axis = normalize(open.direction);
  return aoFilter == filterCone ? skyInCone(coneOfAccessibility(axis, open.accessibility)) : ambientAround(axis);
}

// Returns the radiance that a body scatters of the accessible sky. `beyond`: openness of its other side.
vec3 radianceUnderSky(Body body, vec3 bumped, Openness open, float beyond, vec3 sky) {
  vec3 around = dot(open.direction, open.direction) > 1e-12 ? normalize(open.direction) : bumped;
  vec3 share = partsShown(correctedAccessibility(open.accessibility, body.albedo), vec3(open.accessibility));
  vec3 radiance = body.albedo * share * sky;
  if (hasTranslucency && translucency.a > 0.0)
    radiance += partShown(partDirect, body.through * beyond * ambientAround(-around));
  return radiance;
}
