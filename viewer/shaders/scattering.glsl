// How a surface scatters light, as kernels/transport/bsdf_funcs.cl has it; needs material.glsl and anisotropy.glsl. Directions
// `wo` and `wi` are in the frame of the surface (inFrame).
// [1] Walter et al., "Microfacet models for refraction through rough surfaces", 2007 (GGX).
// [2] Heitz, "Understanding the masking-shadowing function", 2014 (height-correlated Smith).
#include "transport/albedo_table_funcs.cl"
#include "transport/anisotropic_albedo_funcs.cl"
#include "transport/film_funcs.cl"
uniform samplerBuffer albedos;  // of rough lobes
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
const float narrowBelow = 0.25;  // of lobes that show what is there

// A thin film over metal and layer.
struct ThinFilm {
  float share;      // of the surface that has it
  float outside;    // index of refraction of what lies over it
  float thickness;  // nm
  float relative;   // the same in its range
  float metalShare, layerShare;  // of the surface
  vec3 metal, layer;             // reflectance along the normal of what lies below
};

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
  ThinFilm film;
};

float largest(vec3 v) { return max(v.r, max(v.g, v.b)); }

float schlickRise(float cosine) {
  float k = clamp(1.0 - cosine, 0.0, 1.0);
  return k * k * k * k * k;
}

bool isAnisotropic(Scattering s) { return hasAnisotropy && s.widths.x > s.widths.y; }

// A direction in the surface's frame. On isotropic surfaces its height is all that counts.
vec3 inFrame(Scattering s, vec3 n, vec3 w) {
  return isAnisotropic(s) ? vec3(dot(s.along, w), dot(s.across, w), dot(n, w)) : vec3(0.0, 0.0, dot(n, w));
}

// What microfacets reflect at the first bounce, of light along a direction above the surface: of f0 and of f90.
vec2 firstBounce(Scattering s, vec3 w) {
  if (isAnisotropic(s)) return anisotropicAlbedo(albedos, w, s.widths.x, s.widths.y).xy;
  if (s.roughness >= smoothBelow) return lobeAlbedo(albedos, w.z, s.roughness).xy;
  float rise = schlickRise(w.z);
  return vec2(1.0 - rise, rise);
}

// Share of the light along a direction that passes the layer, given what that reflects at the first bounce.
float passedLayer(Scattering s, vec2 first) {
  return max(1.0 - dot(s.layer, vec3(first, 1.0 - first.x - first.y)), 0.0);
}

// Share that passes a layer which lies under a film in part; under: what that part reflects at the first bounce.
float passedFilm(Scattering s, vec2 first, float under) {
  float bare = dot(s.layer.xy, first);
  return max(1.0 - mix(bare, under, s.film.share) - s.layer.z * (1.0 - first.x - first.y), 0.0);
}

float tableRoughness(Scattering s) { return s.roughness >= smoothBelow ? s.roughness : 0.0; }

float passage(Scattering s, vec3 w) {
  if (!hasLayer) return 1.0;
  vec2 first = firstBounce(s, w);
  if (hasFilm && s.film.share > 0.0 && s.film.layerShare > 0.0)
    return passedFilm(s, first, filmAlbedo(albedos, filmTable, s.film.relative, w.z, tableRoughness(s)));
  return passedLayer(s, first);
}

// What metal and layer reflect at a microfacet, of light under this cosine with its normal.
vec3 facetReflectance(Scattering s, float cosine) {
  float rise = schlickRise(cosine);
  vec3 reflected = s.f0 * (1.0 - rise) + s.f90 * rise;
  if (!hasFilm || s.film.share <= 0.0) return reflected;
  ThinFilm f = s.film;
  reflected *= 1.0 - f.share;
  if (f.metalShare > 0.0) reflected += f.share * f.metalShare * filmReflectance(cosine, f.outside, film.y, f.thickness, f.metal);
  if (f.layerShare > 0.0) reflected += f.share * f.layerShare * filmReflectance(cosine, f.outside, film.y, f.thickness, f.layer);
  return reflected;
}

// What a film makes of later bounces off what reflects `below`.
vec3 laterUnderFilm(Scattering s, vec3 below, vec3 bare) {
  return mix(bare, laterOfMean(meanFilmReflectance(s.film.outside, film.y, s.film.thickness, below), s.missing), s.film.share);
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
  s.film.metal = m.base;
  s.film.metalShare = m.metallic;
  s.film.layer = hasLayer ? m.dielectric : vec3(0.0);
  s.film.layerShare = hasLayer && m.f90 > 0.0 ? (1.0 - m.metallic) * (1.0 - m.glass) : 0.0;
  vec3 metalLater = laterUnderFilm(s, m.base, laterReflectance(m.base, vec3(1.0), s.missing));
  vec3 layerLater = laterUnderFilm(s, s.film.layer, bare);
  s.later = s.film.metalShare * metalLater + s.film.layerShare * layerLater;
  if (s.film.layerShare <= 0.0) return;
  s.layer.z = largest(layerLater);
  vec2 mean = vec2(20.0, 1.0) / 21.0;
  if (s.roughness >= smoothBelow) mean = meanLobeAlbedo(albedos, s.roughness).xy;
  if (isAnisotropic(s)) mean = meanAnisotropicAlbedo(albedos, s.widths.x, s.widths.y).xy;
  s.bodyGain = 1.0 / max(passedFilm(s, mean, meanFilmAlbedo(albedos, filmTable, s.film.relative, tableRoughness(s))), 1e-6);
}

Scattering scatteringOf(FragmentMaterial m, Stretch stretch) {
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
  s.film = ThinFilm(0.0, 1.0, 0.0, 0.0, 0.0, 0.0, vec3(0.0), vec3(0.0));
  vec2 mean = vec2(20.0, 1.0) / 21.0;
  if ((hasGloss || hasLayer) && s.roughness >= smoothBelow) mean = meanLobeAlbedo(albedos, s.roughness).xy;
  if ((hasGloss || hasLayer) && isAnisotropic(s)) mean = meanAnisotropicAlbedo(albedos, s.widths.x, s.widths.y).xy;
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
vec3 diffuseOfIrradiance(Scattering s, vec3 wo) { return s.diffuse / pi * passage(s, wo); }

// Light passes the layer twice.
vec3 diffuseOfLight(Scattering s, vec3 wo, vec3 wi) {
  return s.diffuse / pi * s.bodyGain * passage(s, wo) * passage(s, wi);
}

// Share that passes of light that arrives evenly on the other side, over pi.
vec3 transmittedOfIrradiance(Scattering s, vec3 wo) {
  float enters = 0.5 * (1.0 + passage(s, vec3(0.0, 0.0, 1.0)) * s.bodyGain);  // as transmitIrradiance() of the kernels
  return s.transmitted / pi * passage(s, wo) * enters;
}

vec3 transmittedOfLight(Scattering s, vec3 wo, vec3 wi) {
  s.diffuse = s.transmitted;
  return diffuseOfLight(s, wo, vec3(wi.xy, abs(wi.z)));
}

// Distribution and masking of microfacets over 4 cos cos; a2: square of the lobe's width.
float microfacets(float nl, float nv, float nh, float a2) {
  float d = nh * nh * (a2 - 1.0) + 1.0;
  float distribution = a2 / (pi * d * d);  // [1] Eq. 33
  return distribution * 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));  // [2]
}

// Distribution times visibility with widths along x and y; wo, wi, h in the frame.
float anisotropicFacets(vec3 wi, vec3 wo, vec3 h, vec2 widths) {
  vec3 slope = vec3(h.xy / widths, h.z);
  float q = dot(slope, slope);
  float toLight = length(vec3(widths * wi.xy, wi.z));
  float toEye = length(vec3(widths * wo.xy, wo.z));
  return 0.5 / (pi * widths.x * widths.y * q * q) / (wi.z * toEye + wo.z * toLight);
}

vec3 glossyOfLight(Scattering s, vec3 n, vec3 toEye, vec3 toLight) {
  vec3 h = normalize(toEye + toLight);
  float nl = max(dot(n, toLight), 1e-4);
  float nv = max(dot(n, toEye), 1e-4);
  float a2 = s.roughness * s.roughness;
  a2 *= a2;
  float nh = max(dot(n, h), 0.0);
  vec3 wo = vec3(inFrame(s, n, toEye).xy, nv);
  vec3 wi = vec3(inFrame(s, n, toLight).xy, nl);
  vec2 from = firstBounce(s, wo);
  vec2 to = firstBounce(s, wi);
  float later = (1.0 - from.x - from.y) * (1.0 - to.x - to.y) / max(s.missing, 1e-6);
  float lobe = isAnisotropic(s) ? anisotropicFacets(wi, wo, inFrame(s, n, h), s.widths) : microfacets(nl, nv, nh, a2);
  return facetReflectance(s, dot(toEye, h)) * lobe + s.later * later / pi;
}

// Share that metal and layer reflect of surroundings of one radiance.
vec3 reflectanceOfSurroundings(Scattering s, vec3 wo) {
  vec2 first = firstBounce(s, wo);
  if (hasFilm && s.film.share > 0.0) return facetReflectance(s, wo.z) * (first.x + first.y) + s.later * (1.0 - first.x - first.y);
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

// Share of the light of each channel that glass reflects where it is entered.
vec3 glassReflectance(Scattering s, float cosine) {
  if (glassIor <= 0.0) return vec3(1.0);
  float bare = fresnelDielectric(cosine, glassIor);
  float root = (glassIor - 1.0) / (glassIor + 1.0);
  float rise = clamp((bare - root * root) / max(1.0 - root * root, 1e-6), 0.0, 1.0);
  bool plain = s.glassF90 == 1.0 && largest(abs(s.glassF0 - vec3(root * root))) < 1e-6;  // as the index tells
  vec3 reflected = plain ? vec3(bare) : mix(s.glassF0, vec3(s.glassF90), rise);
  if (hasFilm && s.film.share > 0.0)
    reflected = mix(reflected, filmReflectance(cosine, s.film.outside, film.y, s.film.thickness, s.glassF0), s.film.share);
  return reflected;
}
