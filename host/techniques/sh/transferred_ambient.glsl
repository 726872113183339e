// The radiance that vertices have through a transfer, or charts where the surface has them: of SH, CH, Haar, glossy transfer, light
// groups, vector occluders and radiosity.
#include "openness.glsl"
#include "plain_visibility.glsl"
#include "light_map.glsl"

// Mean radiance that arrives on the side that is seen.
vec3 arrivingHere(vec3 n) {
  if (hasCharts) {
    if (vChartCoord.w > 0.5) return texture(lightMaps, vChartCoord.xyz).rgb;
  }
  return passesKnownLight() && !gl_FrontFacing ? vReflected : vTransferred;
}

#include "openness_of_light.glsl"

vec3 ambientRadiance(Body body, vec3 n, vec3 bumped, Openness open, Visibility seen) {
  if (hasCharts) {
    if (vChartCoord.w > 0.5) return partShown(partBaked, body.albedo * texture(lightMaps, vChartCoord.xyz).rgb);
  }
  if (!passesKnownLight()) return partShown(partBaked, body.albedo * vTransferred);
  return partShown(partBaked, gl_FrontFacing ? body.albedo * vTransferred + body.through * vReflected
                                             : body.albedo * vReflected + body.through * vTransferred);
}
