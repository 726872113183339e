// Reflection of lights and sky off rough surfaces.
// [1] Walter et al., "Microfacet models for refraction through rough surfaces", 2007 (GGX).
// [2] Heitz, "Understanding the masking-shadowing function", 2014 (height-correlated Smith).
#include "transport/albedo_table_funcs.cl"
uniform TEXELS albedos;  // of rough lobes

// The modified Phong BRDF of phongExponent() in viewer/techniques/glossy/specular_lobes.h.
vec3 phongBrdf(FragmentMaterial m, vec3 n, vec3 toEye, vec3 toLight) {
  float alpha = max(m.roughness * m.roughness, 0.002);
  float exponent = 2.0 / (alpha * alpha) - 2.0;
  float cosine = clamp(dot(reflect(-toEye, n), toLight), 1e-6, 1.0);
  return m.f0 * (exponent + 2.0) / (2.0 * pi) * pow(cosine, exponent);
}

// BRDF value. A light of no extent would make a mirror's lobe infinitely small: roughness is kept above 0.045.
vec3 specularBrdf(FragmentMaterial m, vec3 n, vec3 toEye, vec3 toLight) {
  if (phongLobe) return phongBrdf(m, n, toEye, toLight);
  vec3 h = normalize(toEye + toLight);
  float nl = max(dot(n, toLight), 0.0);
  float nv = max(dot(n, toEye), 1e-4);
  float nh = max(dot(n, h), 0.0);
  float alpha = max(m.roughness * m.roughness, 0.002);
  float a2 = alpha * alpha;
  float d = nh * nh * (a2 - 1.0) + 1.0;
  float distribution = a2 / (pi * d * d);  // [1] Eq. 33
  float visibility = 0.5 / max(nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2), 1e-6);  // [2]
  float rise = pow(clamp(1.0 - dot(toEye, h), 0.0, 1.0), 5.0);  // Schlick 1994
  return mix(m.f0, vec3(m.grazing), rise) * distribution * visibility;
}

// Share that is reflected of a sky of one radiance, at all bounces between microfacets.
vec3 skyReflectance(FragmentMaterial m, float nv) {
  vec2 first = lobeAlbedo(albedos, nv, m.roughness).xy;
  vec2 mean = meanLobeAlbedo(albedos, m.roughness).xy;
  vec3 later = laterReflectance(m.f0, vec3(m.grazing), max(1.0 - mean.x - mean.y, 0.0));
  return m.f0 * first.x + m.grazing * first.y + later * (1.0 - first.x - first.y);
}
