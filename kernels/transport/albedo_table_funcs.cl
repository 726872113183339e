// Albedos of rough lobes by direction, from a table that host/gpu/albedo_table.h computes. OpenCL C and GLSL.
// In a texel, x and y are what GGX microfacets reflect at their first bounce, for the constant part of Schlick's
// reflectance and for its rise: f0 x + f90 y. z is what sheen of colour 1 reflects (transport/layer_funcs.cl).
#ifndef PRELIGHT_TRANSPORT_ALBEDO_TABLE_FUNCS_CL
#define PRELIGHT_TRANSPORT_ALBEDO_TABLE_FUNCS_CL

#include "core/dialect.h"
#include "shared/albedo_types.h"

// Interpolates between the entries of a table [roughness][cosine] that begins at `first`; cosine and roughness are in
// [0,1].
vec4 betweenAlbedos(TEXELS table, int first, int cosines, int roughnesses, float cosine, float roughness) {
  float column = sqrt(clamp(cosine, 0.0f, 1.0f)) * TO_FLOAT(cosines - 1);
  float row = sqrt(clamp(roughness, 0.0f, 1.0f)) * TO_FLOAT(roughnesses - 1);
  int c = min(TO_INT(column), cosines - 2);
  int r = min(TO_INT(row), roughnesses - 2);
  int at = first + r * cosines + c;
  float x = column - TO_FLOAT(c);
  vec4 smoother = mix(FETCH(table, at), FETCH(table, at + 1), x);
  vec4 rougher = mix(FETCH(table, at + cosines), FETCH(table, at + cosines + 1), x);
  return mix(smoother, rougher, row - TO_FLOAT(r));
}

// Returns the albedos for a direction of this cosine.
vec4 lobeAlbedo(TEXELS table, float cosine, float roughness) {
  return betweenAlbedos(table, 0, PRELIGHT_ALBEDO_COSINES, PRELIGHT_ALBEDO_ROUGHNESSES, cosine, roughness);
}

// Returns how lobes lie about the mirrored direction of the eye's, of light that leaves at the first bounce: x, of the
// constant part of Schlick's reflectance, is the albedo less the integral of the cosine with that direction, and y the
// integral of the cosine with the direction at right angles to it that leans to the normal. z, w: of the rise.
vec4 lobeLean(TEXELS table, float cosine, float roughness) {
  return betweenAlbedos(table, PRELIGHT_LEANS_FIRST, PRELIGHT_ALBEDO_COSINES, PRELIGHT_ALBEDO_ROUGHNESSES, cosine, roughness);
}

// Returns their cosine-weighted mean over directions.
vec4 meanLobeAlbedo(TEXELS table, float roughness) {
  float row = sqrt(clamp(roughness, 0.0f, 1.0f)) * TO_FLOAT(PRELIGHT_ALBEDO_ROUGHNESSES - 1);
  int r = min(TO_INT(row), PRELIGHT_ALBEDO_ROUGHNESSES - 2);
  int at = PRELIGHT_ALBEDO_ROUGHNESSES * PRELIGHT_ALBEDO_COSINES + r;
  return mix(FETCH(table, at), FETCH(table, at + 1), row - TO_FLOAT(r));
}

// Returns the reflectance of the light that one bounce has not let out: it bounces on among microfacets until it is
// absorbed or leaves. `mean`: the microfacets' mean reflectance over all directions; `missing`: mean share that stays
// inside at a bounce. Hill's correction of [1].
// [1] Kulla and Conty 2017, "Revisiting Physically Based Shading at Imageworks".
vec3 laterOfMean(vec3 mean, float missing) { return mean * mean * (1.0f - missing) / (VEC3(1.0f) - mean * missing); }

// Returns laterOfMean for microfacets with Schlick's reflectance.
vec3 laterReflectance(vec3 f0, vec3 f90, float missing) { return laterOfMean(f0 + (f90 - f0) * (1.0f / 21.0f), missing); }

#endif
