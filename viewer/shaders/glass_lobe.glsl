// Glass in the light of lamps, as kernels/transport/rough_glass_funcs.cl has it; needs scattering.glsl.
#include "core/wave_funcs.cl"
uniform vec3 absorption;   // of a body of glass, 1/m
uniform float dispersion;  // 20 over Abbe's number

const int waves = 6;  // lengths that light is looked at: their colours add up to white
const float laterCosine = 0.6;  // at which light that leaves a sheet after the first bounce divides between its sides

bool isRoughGlass(Scattering s) { return hasRoughGlass && s.glass > 0.0 && s.roughness >= smoothBelow; }

// Returns the reflectance of a facet of the material's glass: of one surface, or of both faces of a sheet.
vec3 facetOfGlass(Scattering s, float cosine) {
  vec3 reflected = glassReflectance(s, max(cosine, 1e-6));
  return solidGlass == 0 ? 2.0 * reflected / (1.0 + reflected) : reflected;
}

// Share of light that leaves thin glass after the first bounce between microfacets.
float laterInGlass(float cosine, float roughness) {
  vec2 first = lobeAlbedo(albedos, cosine, roughness).xy;
  return max(1.0 - first.x - first.y, 0.0);
}

// Share of a lamp's light, times the cosine, that glass reflects or that passes a rough sheet from its other side.
vec3 roughGlassOfLight(Scattering s, vec3 n, vec3 toEye, vec3 toLight) {
  bool passes = dot(n, toLight) < 0.0;
  if (passes && solidGlass != 0) return vec3(0.0);
  vec3 mirrored = passes ? toLight - 2.0 * dot(n, toLight) * n : toLight;
  vec3 h = normalize(toEye + mirrored);
  float alpha = s.roughness * s.roughness, nl = max(dot(n, mirrored), 1e-4), nv = max(dot(n, toEye), 1e-4);
  vec3 share = facetOfGlass(s, dot(toEye, h)), last = facetOfGlass(s, laterCosine);
  if (passes) share = (1.0 - largest(share)) * s.tint;
  if (passes) last = (1.0 - largest(last)) * s.tint;
  float later = 0.0;
  if (hasRoughGlass && solidGlass == 0) later = laterInGlass(nv, s.roughness) * laterInGlass(nl, s.roughness) / max(s.missing, 1e-6);
  return s.glass * nl * (share * microfacets(nl, nv, max(dot(n, h), 0.0), alpha) + last * later / pi);
}
