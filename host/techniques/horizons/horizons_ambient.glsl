// The transferred sky above horizons, which shadow lamps and reflections, too. Backs have the sky over their accessible share.
#include "accessible_sky.glsl"
#include "plain_openness.glsl"
#include "lamp_shadow.glsl"
#include "horizons.glsl"

const bool isSender = false;
const bool shadowsSamples = true;

struct Visibility {
  Horizons horizons;
  float ofSky;  // where there are none
};

Visibility visibilityHere(vec3 n, Openness open) {
  if (gl_FrontFacing) return Visibility(horizonsAt(triangleHere(), vPosition, n), open.accessibility);
  return Visibility(noHorizons(), open.accessibility);
}

float lampVisibility(Visibility seen, int k, Light light, vec3 toLight, float radius) {
  if (seen.horizons.there) return lampAboveHorizon(seen.horizons, light, toLight, radius);
  return isOfSky(light) ? seen.ofSky : 1.0;
}

float skyVisibility(Visibility seen, vec3 direction, float roughness) {
  if (seen.horizons.there) return lobeAboveHorizon(seen.horizons, roughness, direction);
  return seen.ofSky;
}

#include "sky_in_lobe.glsl"

// The sky that vertices have above their horizons; bumps turn it as they turn all of the sky.
vec3 ambientRadiance(Body body, vec3 n, vec3 bumped, Openness open, Visibility seen) {
  if (!gl_FrontFacing) return radianceUnderSky(body, bumped, open, open.accessibility, ambientAround(bumped));
  vec3 arriving = vTransferred;
  if (hasNormalTexture) arriving *= ambientAround(bumped) / max(ambientAround(n), vec3(1e-6));
  vec3 radiance = body.albedo * arriving;
  if (hasTranslucency && translucency.a > 0.0) radiance += body.through * open.accessibility * ambientAround(-bumped);
  return partShown(partDirect, radiance);
}
