// How a surface scatters light, as kernels/transport/bsdf_funcs.cl has it; needs material.glsl, anisotropy.glsl and two
// constants: layerCovers, whether the dielectric's layer takes from the body's light what it reflects, and bouncesLater, whether light
// is looked at that leaves microfacets after several bounces. Directions `wo` and `wi` are in the frame of the surface (inFrame).
// [1] Walter et al., "Microfacet models for refraction through rough surfaces", 2007 (GGX).
#include "transport/anisotropic_albedo_funcs.cl"
#include "transport/lobe_math_funcs.cl"
uniform TEXELS albedos;  // of rough lobes
uniform float glassIor;  // 0: infinite
uniform int solidGlass;  // 1: glass with an inside, 0: a sheet
uniform vec4 film;       // of a thin film: share of the surface, index of refraction, nm where its texture is 0 and 1
uniform int filmTable;   // where its table begins in `albedos`
uniform sampler2D filmTexture;           // R
uniform sampler2D filmThicknessTexture;  // G
uniform vec4 filmU;
uniform vec4 filmV;
uniform vec4 filmThicknessU;
uniform vec4 filmThicknessV;

const float smoothBelow = 0.05;  // roughness of mirrors

struct Scattering {
  vec3 diffuse;  // albedo of the body
  vec3 transmitted;  // the same for light that leaves on the other side
  // Reflectance of metal and layer, times their shares of the surface: along the normal, at grazing angles, and of what does not leave
  // microfacets at the first bounce.
  vec3 f0;
  vec3 f90;
  vec3 later;
  vec3 layer;      // the same three of the layer where it covers the body, by its largest channel
  float bodyGain;  // 1 over the mean share that passes the layer
  float missing;   // mean share of light that does not leave microfacets at the first bounce
  float glass;     // share that is glass
  vec3 glassF0;    // its reflectance along the normal
  float glassF90;  // at grazing angles
  vec3 tint;       // of what passes a surface of it
  float roughness;
  vec2 widths;  // of the lobe along and across `along`
  vec3 along;   // unit, in the plane of the surface
  vec3 across;
  Film film;
};

bool isAnisotropic(Scattering s) { return hasAnisotropy && s.widths.x > s.widths.y; }

// A direction in the surface's frame. On isotropic surfaces its height is all that counts.
vec3 inFrame(Scattering s, vec3 n, vec3 w) {
  return isAnisotropic(s) ? vec3(dot(s.along, w), dot(s.across, w), dot(n, w)) : vec3(0.0, 0.0, dot(n, w));
}

// What microfacets reflect at the first bounce, of light along a direction above the surface: of f0 and of f90.
vec2 firstBounce(Scattering s, vec3 w) {
  if (isAnisotropic(s)) return anisotropicAlbedo(albedos, w, s.widths.x, s.widths.y).xy;
  if (s.roughness >= smoothBelow) return lobeAlbedo(albedos, w.z, s.roughness).xy;
  return smoothBounce(w.z);
}

float tableRoughness(Scattering s) { return s.roughness >= smoothBelow ? s.roughness : 0.0; }

float passage(Scattering s, vec3 w) {
  if (!layerCovers) return 1.0;
  vec2 first = firstBounce(s, w);
  if (hasFilm && s.film.share > 0.0 && s.film.layerShare > 0.0)
    return passedFilm(s.layer, s.film.share, first, filmAlbedo(albedos, s.film.table, s.film.relative, w.z, tableRoughness(s)));
  return passedLayer(s.layer, first);
}

// What metal and layer reflect at a microfacet, of light under this cosine with its normal.
vec3 facetReflectance(Scattering s, float cosine) {
  float rise = schlickRise(cosine);
  vec3 reflected = s.f0 * (1.0 - rise) + s.f90 * rise;
  return hasFilm && s.film.share > 0.0 ? filmedReflectance(s.film, cosine, reflected) : reflected;
}

// Adds a film, after all else. coat: share of the surface that has a clear coat.
void addFilm(vec4 texCoords, float coat, FragmentMaterial m, inout Scattering s) {
  vec3 bare = laterReflectance(hasLayer ? m.dielectric : vec3(0.0), vec3(m.f90), s.missing);
  s.film.share = film.x * texture(filmTexture, texturePlace(texCoords, filmU, filmV)).r;
  s.film.relative = texture(filmThicknessTexture, texturePlace(texCoords, filmThicknessU, filmThicknessV)).g;
  s.film.thickness = mix(film.z, film.w, s.film.relative);
  if (s.film.thickness <= 0.0) s.film.share = 0.0;
  if (s.film.share <= 0.0) return;
  s.film.outside = 1.0 + 0.5 * coat;
  s.film.ior = film.y;
  s.film.table = filmTable;
  s.film.metal = m.base;
  s.film.metalShare = m.metallic;
  s.film.layer = hasLayer ? m.dielectric : vec3(0.0);
  s.film.layerShare = hasLayer && m.f90 > 0.0 ? (1.0 - m.metallic) * (1.0 - m.glass) : 0.0;
  vec3 metalLater = laterUnderFilm(s.film, m.base, laterReflectance(m.base, vec3(1.0), s.missing), s.missing);
  vec3 layerLater = laterUnderFilm(s.film, s.film.layer, bare, s.missing);
  s.later = s.film.metalShare * metalLater + s.film.layerShare * layerLater;
  if (s.film.layerShare <= 0.0) return;
  s.layer.z = largest(layerLater);
  vec2 mean = vec2(20.0, 1.0) / 21.0;
  if (s.roughness >= smoothBelow) mean = meanLobeAlbedo(albedos, s.roughness).xy;
  if (isAnisotropic(s)) mean = meanAnisotropicAlbedo(albedos, s.widths.x, s.widths.y).xy;
  s.bodyGain = 1.0 / max(passedFilm(s.layer, s.film.share, mean, meanFilmAlbedo(albedos, s.film.table, s.film.relative, tableRoughness(s))), 1e-6);
}

// withLayer: false leaves out what the dielectric's layer reflects.
Scattering scatteringOf(FragmentMaterial m, Stretch stretch, bool withLayer) {
  Scattering s;
  float opaque = (1.0 - m.metallic) * (1.0 - m.glass);
  s.diffuse = opaque * m.base * (hasTranslucency ? 1.0 - translucency.a : 1.0);
  s.transmitted = m.through;
  s.glass = m.transmission;
  s.glassF0 = m.dielectric;
  s.glassF90 = m.f90;
  s.tint = m.base;
  s.roughness = hasAnisotropy && anisotropy.x > 0.0 ? max(m.roughness, smoothBelow) : m.roughness;
  s.widths = vec2(mix(s.roughness * s.roughness, 1.0, stretch.amount), s.roughness * s.roughness);
  s.along = stretch.along;
  s.across = stretch.across;
  s.film = Film(0.0, 1.0, 1.0, 0.0, 0.0, 0, 0.0, 0.0, vec3(0.0), vec3(0.0));
  vec2 mean = vec2(20.0, 1.0) / 21.0;
  if (bouncesLater && s.roughness >= smoothBelow) mean = meanLobeAlbedo(albedos, s.roughness).xy;
  if (bouncesLater && isAnisotropic(s)) mean = meanAnisotropicAlbedo(albedos, s.widths.x, s.widths.y).xy;
  s.missing = s.roughness >= smoothBelow ? max(1.0 - mean.x - mean.y, 0.0) : 0.0;
  vec3 layerF0 = withLayer ? m.dielectric : vec3(0.0);
  float layerF90 = withLayer ? m.f90 : 0.0;
  float share = layerF90 > 0.0 ? opaque : 0.0;
  vec3 layerLater = laterReflectance(layerF0, vec3(layerF90), s.missing);
  s.f0 = m.metallic * m.base + share * layerF0;
  s.f90 = vec3(m.metallic + share * layerF90);
  s.later = m.metallic * laterReflectance(m.base, vec3(1.0), s.missing) + share * layerLater;
  s.layer = share > 0.0 ? vec3(largest(layerF0), layerF90, largest(layerLater)) : vec3(0.0);
  s.bodyGain = layerCovers ? 1.0 / max(passedLayer(s.layer, mean), 1e-6) : 1.0;
  return s;
}

// Share that the body reflects of what arrives from everywhere alike, over pi.
vec3 diffuseOfIrradiance(Scattering s, vec3 wo) { return s.diffuse / pi * passage(s, wo); }

// Share of the light from a direction that reaches the body and leaves it for the eye: light passes the layer twice.
float passedTwice(Scattering s, vec3 wo, vec3 wi) { return s.bodyGain * passage(s, wo) * passage(s, wi); }

vec3 diffuseOfLight(Scattering s, vec3 wo, vec3 wi) { return s.diffuse / pi * passedTwice(s, wo, wi); }

// Share of light that arrives evenly on the other side which passes both layers.
float passedFromBehind(Scattering s, vec3 wo) {
  if (!layerCovers) return 1.0;
  return passage(s, wo) * 0.5 * (1.0 + passage(s, vec3(0.0, 0.0, 1.0)) * s.bodyGain);  // as transmitIrradiance() of the kernels
}

vec3 transmittedOfIrradiance(Scattering s, vec3 wo) { return s.transmitted / pi * passedFromBehind(s, wo); }

vec3 transmittedOfLight(Scattering s, vec3 wo, vec3 wi) {
  s.diffuse = s.transmitted;
  return diffuseOfLight(s, wo, vec3(wi.xy, abs(wi.z)));
}

// Distribution and masking of microfacets over 4 cos cos.
float microfacets(float nl, float nv, float nh, float alpha) {
  float a2 = alpha * alpha;
  float d = nh * nh * (a2 - 1.0) + 1.0;
  return a2 / (pi * d * d) * smithVisibility(nv, nl, alpha);  // [1] Eq. 33
}

// The same with widths along x and y; wo, wi, h in the frame.
float anisotropicFacets(vec3 wi, vec3 wo, vec3 h, vec2 widths) {
  return anisotropicDensity(h, widths) * 0.5 / (wo.z * anisotropicTerm(wi, widths) + wi.z * anisotropicTerm(wo, widths));
}

vec3 glossyOfLight(Scattering s, vec3 n, vec3 toEye, vec3 toLight) {
  vec3 h = normalize(toEye + toLight);
  float nl = max(dot(n, toLight), 1e-4);
  float nv = max(dot(n, toEye), 1e-4);
  float nh = max(dot(n, h), 0.0);
  vec3 wo = vec3(inFrame(s, n, toEye).xy, nv);
  vec3 wi = vec3(inFrame(s, n, toLight).xy, nl);
  float lobe = isAnisotropic(s) ? anisotropicFacets(wi, wo, inFrame(s, n, h), s.widths) : microfacets(nl, nv, nh, s.roughness * s.roughness);
  vec3 once = facetReflectance(s, dot(toEye, h)) * lobe;
  if (!bouncesLater) return once;
  vec2 from = firstBounce(s, wo);
  vec2 to = firstBounce(s, wi);
  float later = (1.0 - from.x - from.y) * (1.0 - to.x - to.y) / max(s.missing, 1e-6);
  return once + s.later * later / pi;
}

// Share that metal and layer reflect of surroundings of one radiance.
vec3 reflectanceOfSurroundings(Scattering s, vec3 wo) {
  vec2 first = firstBounce(s, wo);
  if (hasFilm && s.film.share > 0.0) return facetReflectance(s, wo.z) * (first.x + first.y) + s.later * (1.0 - first.x - first.y);
  return s.f0 * first.x + s.f90 * first.y + s.later * (1.0 - first.x - first.y);
}

// Share of the light of each channel that glass reflects where it is entered.
vec3 glassReflectance(Scattering s, float cosine) {
  if (glassIor <= 0.0) return vec3(1.0);
  float bare = fresnelDielectric(cosine, glassIor);
  float root = (glassIor - 1.0) / (glassIor + 1.0);
  bool plain = s.glassF90 == 1.0 && largest(abs(s.glassF0 - vec3(root * root))) < 1e-6;  // as the index tells
  vec3 reflected = plain ? vec3(bare) : mix(s.glassF0, vec3(s.glassF90), fresnelRise(bare, glassIor));
  if (hasFilm && s.film.share > 0.0)
    reflected = mix(reflected, filmReflectance(cosine, s.film.outside, s.film.ior, s.film.thickness, s.glassF0), s.film.share);
  return reflected;
}
