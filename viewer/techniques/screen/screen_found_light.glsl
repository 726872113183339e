// The sky and lamps that screen_ssdo.frag finds to arrive; needs isSender and findsBounce.
#include "accessible_sky.glsl"
#include "lamp_shadow.glsl"

uniform sampler2D screenInput;                 // rgb: the sky's irradiance over pi, a: openness of every sample
uniform sampler2D screenLamps, screenBounce;  // as screen_ssdo.frag writes them

const bool shadowsSamples = false;

struct Visibility {
  vec4 ofLamps;  // the first four
  float ofSky;
};

Openness opennessHere() { return Openness(texelFetch(screenInput, ivec2(gl_FragCoord.xy), 0).w, vec3(0.0)); }

Visibility visibilityHere(vec3 n, Openness open) {
  return Visibility(texelFetch(screenLamps, ivec2(gl_FragCoord.xy), 0), open.accessibility);
}

float lampVisibility(Visibility seen, int k, Light light, vec3 toLight, float radius) {
  return k < 4 ? seen.ofLamps[k] : isOfSky(light) ? seen.ofSky : 1.0;
}

float skyVisibility(Visibility seen, vec3 direction, float roughness) { return seen.ofSky; }

#include "sky_in_lobe.glsl"

// n: without bumps, which turn the sky's light alone.
vec3 ambientRadiance(Body body, vec3 n, vec3 bumped, Openness open, Visibility seen) {
  vec3 found = texelFetch(screenInput, ivec2(gl_FragCoord.xy), 0).rgb;
  if (hasNormalTexture) found *= ambientAround(bumped) / max(ambientAround(n), vec3(1e-6));
  vec3 arriving = found;
  if (aoCorrection != correctionNone)
    arriving *= correctedAccessibility(open.accessibility, body.albedo) / max(open.accessibility, 1e-6);
  if (findsBounce) arriving += texelFetch(screenBounce, ivec2(gl_FragCoord.xy), 0).rgb;
  vec3 radiance = body.albedo * partsShown(arriving, found);
  if (hasTranslucency && translucency.a > 0.0)
    radiance += partShown(partDirect, body.through * open.accessibility * ambientAround(-bumped));
  return radiance;
}
