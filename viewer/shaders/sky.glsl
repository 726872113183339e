// The sky's radiance; needs frame.glsl and variant.glsl.
#include "core/ringing_funcs.cl"
uniform sampler2D skyMap;  // equirectangular: centre looks along -Z, u grows towards +X, row 0 is +Y

vec3 skyRadiance(vec3 world, float level) {
  if (!hasSkyLight) return vec3(0.0);
  if (!hasSkyMap) return texelFetch(skyMap, ivec2(0), 0).rgb;
  vec3 w = mat3(skyFromWorld) * world;
  float u = atan(w.x, -w.z) / (2.0 * pi) + 0.5;
  float v = atan(length(w.xz), w.y) / pi;
  return textureLod(skyMap, vec2(u, v), level).rgb;
}

// About the mip level whose texels are as wide as the lobe of a rough reflection.
float levelOfRoughness(float roughness) {
  float lobe = max(roughness * roughness * 1.2, 1e-4);  // radians
  return max(log2(lobe) - skyLevels.x, 0.0);
}

// About the mip level of the sky whose texels are as large as a solid angle.
float levelOfSolidAngle(float solidAngle) { return max(0.5 * log2(max(solidAngle, 1e-9)) - skyLevels.x, 0.0); }

// Three bands of SH at a direction; `bands` scales the first and the second.
vec3 harmonicsAround(vec4 c[9], vec3 n, vec2 bands) {
  vec3 e = c[0].rgb * 0.282094792;
  e += (c[1].rgb * n.y + c[2].rgb * n.z + c[3].rgb * n.x) * 0.488602512 * bands.x;
  e += (c[4].rgb * n.x * n.y + c[5].rgb * n.y * n.z + c[7].rgb * n.x * n.z) * 1.092548431 * bands.y;
  e += c[6].rgb * (0.946174696 * n.z * n.z - 0.315391565) * bands.y;
  e += c[8].rgb * 0.546274215 * (n.x * n.x - n.y * n.y) * bands.y;
  return e;
}

// Sky radiance times the cosine in a cone of a cosine of half its angle, as if all of the hemisphere were like it; RGB of ambient[] are
// premultiplied, W of the first is the strength of a smoothing without which the sky would be negative somewhere. The clamped cosine's
// zonal coefficients become those of the cosine within the cone, over its own mean.
vec3 ambientInCone(vec3 axis, float cosine) {
  if (!hasSkyLight) return vec3(0.0);
  vec2 narrowed = vec2((1.0 + cosine + cosine * cosine) / (1.0 + cosine), 1.0 + 3.0 * cosine * cosine);
  vec2 smoothing = vec2(1.0) / (vec2(1.0) + ambient[0].w * vec2(4.0, 36.0));
  return withoutRinging(harmonicsAround(ambient, axis, narrowed), harmonicsAround(ambient, axis, narrowed * smoothing));
}

// Sky radiance over pi times the cosine, gathered around a normal.
vec3 ambientAround(vec3 n) { return ambientInCone(n, 0.0); }
