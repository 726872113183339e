// Reflection of lights and sky off rough surfaces.
// [1] Walter et al., "Microfacet models for refraction through rough surfaces", 2007 (GGX).
// [2] Heitz, "Understanding the masking-shadowing function", 2014 (height-correlated Smith).
// [3] Karis, "Physically based shading on mobile", 2014 (fit of the reflectance of a uniform sky).

vec3 fresnel(vec3 f0, float cosine) {
  return f0 + (vec3(1.0) - f0) * pow(clamp(1.0 - cosine, 0.0, 1.0), 5.0);
}

// BRDF value. A light of no extent would make a mirror's lobe infinitely small: roughness is kept above 0.045.
vec3 specularBrdf(vec3 f0, float roughness, vec3 n, vec3 toEye, vec3 toLight) {
  vec3 h = normalize(toEye + toLight);
  float nl = max(dot(n, toLight), 0.0);
  float nv = max(dot(n, toEye), 1e-4);
  float nh = max(dot(n, h), 0.0);
  float alpha = max(roughness * roughness, 0.002);
  float a2 = alpha * alpha;
  float d = nh * nh * (a2 - 1.0) + 1.0;
  float distribution = a2 / (pi * d * d);  // [1] Eq. 33
  float visibility = 0.5 / max(nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2), 1e-6);  // [2]
  return fresnel(f0, max(dot(toEye, h), 0.0)) * distribution * visibility;
}

vec3 skyReflectance(vec3 f0, float roughness, float nv) {  // [3]
  vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  float a = min(r.x * r.x, exp2(-9.28 * nv)) * r.x + r.y;
  vec2 ab = vec2(-1.04, 1.04) * a + r.zw;
  return f0 * ab.x + ab.y;
}
