// The sky around the bent normal, over the accessible share that screen-space occlusion finds.
#include "accessible_sky.glsl"
#include "accessible_visibility.glsl"

uniform sampler2D screenInput;  // openness of every sample, as shaders of screen-space occlusion write it

Openness opennessHere() {
  vec4 seen = texelFetch(screenInput, ivec2(gl_FragCoord.xy), 0);
  return Openness(seen.w, seen.xyz);
}

vec3 ambientRadiance(Body body, vec3 n, vec3 bumped, Openness open, Visibility seen) {
  return radianceUnderSky(body, bumped, open, open.accessibility, accessibleSky(open, bumped));
}
