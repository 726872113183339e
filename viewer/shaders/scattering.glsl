// How a surface scatters light, as kernels/transport/bsdf_funcs.cl has it; needs material.glsl.
// [1] Walter et al., "Microfacet models for refraction through rough surfaces", 2007 (GGX).
// [2] Heitz, "Understanding the masking-shadowing function", 2014 (height-correlated Smith).
#include "transport/albedo_table_funcs.cl"
uniform samplerBuffer albedos;  // of rough lobes
uniform float glassIor;  // 0: infinite
uniform int solidGlass;  // 1: glass with an inside, 0: a sheet

const float smoothBelow = 0.05;  // roughness of mirrors
const float narrowBelow = 0.25;  // of lobes that show what is there

struct Scattering {
  vec3 diffuse;  // albedo of the body
  vec3 transmitted;  // the same for light that leaves on the other side
  // Of metal and layer, times their shares of the surface: along the normal, at grazing angles, and of what does not leave
  // microfacets at the first bounce.
  vec3 f0;
  vec3 f90;
  vec3 later;
  vec3 layer;      // the same three of the layer where it covers the body, by its largest channel
  float bodyGain;  // 1 over the mean share that passes the layer
  float missing;   // mean share of light that does not leave microfacets at the first bounce
  float glass;     // share that is glass
  float roughness;
};

float largest(vec3 v) { return max(v.r, max(v.g, v.b)); }

float schlickRise(float cosine) {
  float k = clamp(1.0 - cosine, 0.0, 1.0);
  return k * k * k * k * k;
}

// What microfacets reflect at the first bounce, of light along a direction of this cosine: of f0 and of f90.
vec2 firstBounce(Scattering s, float cosine) {
  if (s.roughness >= smoothBelow) return lobeAlbedo(albedos, cosine, s.roughness).xy;
  float rise = schlickRise(cosine);
  return vec2(1.0 - rise, rise);
}

// Share of the light along a direction that passes the layer, given what that reflects at the first bounce.
float passedLayer(Scattering s, vec2 first) {
  return max(1.0 - dot(s.layer, vec3(first, 1.0 - first.x - first.y)), 0.0);
}

float passage(Scattering s, float cosine) { return hasLayer ? passedLayer(s, firstBounce(s, cosine)) : 1.0; }

Scattering scatteringOf(FragmentMaterial m) {
  Scattering s;
  float opaque = (1.0 - m.metallic) * (1.0 - m.glass);
  s.diffuse = opaque * m.base * (hasTranslucency ? 1.0 - translucency.a : 1.0);
  s.transmitted = m.through;
  s.glass = m.transmission;
  s.roughness = m.roughness;
  vec2 mean = vec2(20.0, 1.0) / 21.0;
  if ((hasGloss || hasLayer) && s.roughness >= smoothBelow) mean = meanLobeAlbedo(albedos, s.roughness).xy;
  s.missing = s.roughness >= smoothBelow ? max(1.0 - mean.x - mean.y, 0.0) : 0.0;
  vec3 layerF0 = hasLayer ? m.dielectric : vec3(0.0);
  float layerF90 = hasLayer ? m.f90 : 0.0;
  float share = layerF90 > 0.0 ? opaque : 0.0;
  vec3 layerLater = laterReflectance(layerF0, vec3(layerF90), s.missing);
  s.f0 = m.metallic * m.base + share * layerF0;
  s.f90 = vec3(m.metallic + share * layerF90);
  s.later = m.metallic * laterReflectance(m.base, vec3(1.0), s.missing) + share * layerLater;
  s.layer = share > 0.0 ? vec3(largest(layerF0), layerF90, largest(layerLater)) : vec3(0.0);
  s.bodyGain = hasLayer ? 1.0 / max(passedLayer(s, mean), 1e-6) : 1.0;
  return s;
}

// Share that the body reflects of what arrives from everywhere alike, over pi.
vec3 diffuseOfIrradiance(Scattering s, float nv) { return s.diffuse / pi * passage(s, nv); }

// Light passes the layer twice.
vec3 diffuseOfLight(Scattering s, float nv, float nl) {
  return s.diffuse / pi * s.bodyGain * passage(s, nv) * passage(s, nl);
}

// The same of light on the other side.
vec3 transmittedOfIrradiance(Scattering s, float nv) {
  float enters = 0.5 * (1.0 + passage(s, 1.0) * s.bodyGain);  // as transmitIrradiance() of the kernels
  return s.transmitted / pi * passage(s, nv) * enters;
}

vec3 transmittedOfLight(Scattering s, float nv, float nl) {
  s.diffuse = s.transmitted;
  return diffuseOfLight(s, nv, nl);
}

// Distribution and masking of microfacets over 4 cos cos; a2: square of the lobe's width.
float microfacets(float nl, float nv, float nh, float a2) {
  float d = nh * nh * (a2 - 1.0) + 1.0;
  float distribution = a2 / (pi * d * d);  // [1] Eq. 33
  return distribution * 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));  // [2]
}

vec3 glossyOfLight(Scattering s, vec3 n, vec3 toEye, vec3 toLight) {
  vec3 h = normalize(toEye + toLight);
  float nl = max(dot(n, toLight), 1e-4);
  float nv = max(dot(n, toEye), 1e-4);
  float a2 = s.roughness * s.roughness;
  a2 *= a2;
  float nh = max(dot(n, h), 0.0);
  float rise = schlickRise(dot(toEye, h));
  vec2 from = firstBounce(s, nv);
  vec2 to = firstBounce(s, nl);
  float later = (1.0 - from.x - from.y) * (1.0 - to.x - to.y) / max(s.missing, 1e-6);
  return (s.f0 * (1.0 - rise) + s.f90 * rise) * microfacets(nl, nv, nh, a2) + s.later * later / pi;
}

// Share that metal and layer reflect of surroundings of one radiance.
vec3 reflectanceOfSurroundings(Scattering s, float nv) {
  vec2 first = firstBounce(s, nv);
  return s.f0 * first.x + s.f90 * first.y + s.later * (1.0 - first.x - first.y);
}

// Share of unpolarised light that glass reflects; eta: ior beyond over that here.
float fresnelDielectric(float cosine, float eta) {
  float sine2 = (1.0 - cosine * cosine) / (eta * eta);
  if (sine2 >= 1.0) return 1.0;
  float beyond = sqrt(1.0 - sine2);
  float s = (cosine - eta * beyond) / (cosine + eta * beyond);
  float p = (eta * cosine - beyond) / (eta * cosine + beyond);
  return 0.5 * (s * s + p * p);
}
