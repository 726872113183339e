// How a surface scatters light, as kernels/transport/bsdf_funcs.cl has it; needs material.glsl.
// [1] Walter et al., "Microfacet models for refraction through rough surfaces", 2007 (GGX).
// [2] Heitz, "Understanding the masking-shadowing function", 2014 (height-correlated Smith).
// [3] Karis, "Physically based shading on mobile", 2014 (fit of the reflectance of a uniform sky).
uniform float glassIor;  // 0: infinite
uniform int solidGlass;  // 1: glass with an inside, 0: a sheet

const float smoothBelow = 0.05;  // roughness of mirrors
const float narrowBelow = 0.25;  // of lobes that show what is there
const float meanRise = 1.0 / 21.0;  // of Schlick's term, over the cosine

struct Scattering {
  vec3 diffuse;  // albedo
  vec3 transmitted;  // the same for light that leaves on the other side
  vec3 metal;    // reflectance
  vec3 f0;       // of the dielectric's layer
  float f90;
  float layer;   // share of the surface that the layer covers
  float glass;   // share that is glass
  float roughness;
};

float largest(vec3 v) { return max(v.r, max(v.g, v.b)); }

// Schlick's term, its mean over the cosine.
vec3 meanLayer(Scattering s) { return s.f0 + (vec3(s.f90) - s.f0) * meanRise; }

Scattering scatteringOf(FragmentMaterial m) {
  Scattering s;
  float opaque = (1.0 - m.metallic) * (1.0 - m.glass);
  s.diffuse = opaque * m.base * (hasTranslucency ? 1.0 - translucency.a : 1.0);
  s.metal = m.metallic * m.base;
  s.f0 = hasLayer ? m.dielectric : vec3(0.0);
  s.f90 = hasLayer ? m.f90 : 0.0;
  s.layer = s.f90 > 0.0 ? opaque : 0.0;
  s.glass = m.transmission;
  s.roughness = m.roughness;
  s.transmitted = m.through / max(1.0 - largest(meanLayer(s)), 1e-6);
  return s;
}

vec3 schlick(Scattering s, float cosine) {
  float k = clamp(1.0 - cosine, 0.0, 1.0);
  return s.f0 + (vec3(s.f90) - s.f0) * (k * k * k * k * k);
}

// Share that the body reflects of what arrives from everywhere alike, over pi: light passes the layer twice.
vec3 diffuseOfIrradiance(Scattering s, float nv) {
  return s.diffuse / pi * (1.0 - largest(schlick(s, nv))) * (1.0 - largest(meanLayer(s)));
}

vec3 diffuseOfLight(Scattering s, float nv, float nl) {
  return s.diffuse / pi * (1.0 - largest(schlick(s, nv))) * (1.0 - largest(schlick(s, nl)));
}

// The same of light on the other side.
vec3 transmittedOfIrradiance(Scattering s, float nv) {
  float enters = 1.0 - 0.5 * (largest(s.f0) + largest(meanLayer(s)));  // as transmitIrradiance() of the kernels
  return s.transmitted / pi * (1.0 - largest(schlick(s, nv))) * enters;
}

vec3 transmittedOfLight(Scattering s, float nv, float nl) {
  s.diffuse = s.transmitted;
  return diffuseOfLight(s, nv, nl);
}

vec3 glossyOfLight(Scattering s, vec3 n, vec3 toEye, vec3 toLight) {
  vec3 h = normalize(toEye + toLight);
  float nl = max(dot(n, toLight), 1e-4);
  float nv = max(dot(n, toEye), 1e-4);
  float a2 = s.roughness * s.roughness;
  a2 *= a2;
  float nh = max(dot(n, h), 0.0);
  float d = nh * nh * (a2 - 1.0) + 1.0;
  float distribution = a2 / (pi * d * d);  // [1] Eq. 33
  float visible = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));  // [2]
  return (s.metal + s.layer * schlick(s, dot(toEye, h))) * distribution * visible;
}

// Share that metal and layer reflect of surroundings of one radiance.
vec3 reflectanceOfSurroundings(Scattering s, float nv) {
  if (s.roughness < smoothBelow) return s.metal + s.layer * schlick(s, nv);
  vec4 r = s.roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);  // [3]
  float a = min(r.x * r.x, exp2(-9.28 * nv)) * r.x + r.y;
  vec2 ab = vec2(-1.04, 1.04) * a + r.zw;
  return s.metal * (ab.x + ab.y) + s.layer * (s.f0 * ab.x + s.f90 * ab.y);
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
