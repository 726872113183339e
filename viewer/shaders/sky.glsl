// The sky's radiance; needs frame.glsl and variant.glsl.
#include "core/ringing_funcs.cl"
uniform sampler2D skyLobes;  // LobeMap of viewer/lights/lobe_map.h
uniform sampler2D skyMap;  // equirectangular: centre looks along -Z, u grows towards +X, row 0 is +Y

vec2 placeInSky(vec3 world) {
  vec3 w = mat3(skyFromWorld) * world;
  return vec2(atan(w.x, -w.z) / (2.0 * pi) + 0.5, atan(length(w.xz), w.y) / pi);
}

vec3 skyRadiance(vec3 world, float level) {
  if (!hasSkyLight) return vec3(0.0);
  if (!hasSkyMap) return texelFetch(skyMap, ivec2(0), 0).rgb;
  return textureLod(skyMap, placeInSky(world), level).rgb;
}

const int skyLobeCount = 8;
const float widestSpread = 1.0 / 3.0;

// Lobe 0 is the narrowest; each is twice as spread as the one before.
vec3 skyLobe(vec2 place, int lobe) {
  float rim = 1.0 / float(256 >> (lobe / 2));  // half a row of a lobe
  float row = 0.5 * (clamp(place.y, rim, 1.0 - rim) + float(lobe % 2));
  return textureLod(skyLobes, vec2(place.x, row), float(lobe / 2)).rgb;
}

// Mean radiance in a lobe of a spread, which is 1 less the mean cosine with the lobe's axis. Between two lobes of the map, and
// between the narrowest and the sky itself, their mix has this spread.
vec3 skyInLobe(vec3 axis, float spread) {
  if (hasSkyMap) {
    vec2 place = placeInSky(axis);
    float lobe = log2(max(spread / widestSpread, 1e-9)) + float(skyLobeCount - 1);
    if (lobe < 0.0) {
      float blur = max(0.5 * log2(max(2.0 * spread, 1e-9)) - 1.5 - skyLevels.x, 0.0);
      return mix(textureLod(skyMap, place, blur).rgb, skyLobe(place, 0), exp2(lobe));
    }
    int narrow = min(int(lobe), skyLobeCount - 2);
    return mix(skyLobe(place, narrow), skyLobe(place, narrow + 1), clamp(exp2(lobe - float(narrow)) - 1.0, 0.0, 1.0));
  }
  return skyRadiance(axis, 0.0);
}

// Spread of a lobe seen along the normal: lobeSpread() of basis/sky_lobes.h within 5 %.
float spreadOfRoughness(float roughness) {
  float alpha = clamp(roughness * roughness, 1e-4, 1.0), square = alpha * alpha;
  return 1.303 * square * log(1.0 + 3.298 / square) / (1.0 + 6.435 * alpha - 1.94 * square);
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
