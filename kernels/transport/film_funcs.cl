// A thin film over a reflecting surface (KHR_materials_iridescence, [1]): its effect on Fresnel's term, and the table
// of the albedos of dielectrics under it (made by host/gpu/film_table.h). OpenCL C and GLSL.
// [1] Belcour and Barla 2017, "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence".
#ifndef PRELIGHT_TRANSPORT_FILM_FUNCS_CL
#define PRELIGHT_TRANSPORT_FILM_FUNCS_CL

#include "core/dialect.h"
#include "transport/albedo_table_funcs.cl"

float filmSchlick(float f0, float cosine) {
  float k = clamp(1.0f - cosine, 0.0f, 1.0f);
  return f0 + (1.0f - f0) * k * k * k * k * k;
}

// Returns the reflectance along the normal between two indices of refraction.
float normalReflectance(float beyond, float here) {
  float root = (beyond - here) / (beyond + here);
  return root * root;
}

float filmGauss(float height, float centre, float variance, float phase, float shift) {
  return height * sqrt(6.28318531f * variance) * cos(centre * phase + shift) * exp(-variance * phase * phase);
}

// Returns the colour, in linear sRGB, of a reflectance that varies like a cosine of the phase of a path of so many nm
// ([1] section 4).
vec3 filmSeen(float path, vec3 shift) {
  float phase = 6.28318531e-9f * path;
  // The heights are those of the curves divided by their integral, 1.0685e-7.
  float x = filmGauss(5.13393e-6f, 1.6810e6f, 4.3278e9f, phase, shift.x) + filmGauss(9.12213e-7f, 2.2399e6f, 4.5282e9f, phase, shift.x);
  float y = filmGauss(4.13674e-6f, 1.7953e6f, 9.3046e9f, phase, shift.y);
  float z = filmGauss(4.91156e-6f, 2.2084e6f, 6.6121e9f, phase, shift.z);
  return VEC3(3.2404542f * x - 1.5371385f * y - 0.4985314f * z, -0.9692660f * x + 1.8760108f * y + 0.0415560f * z,
              0.0556434f * x - 0.2040259f * y + 1.0572252f * z);
}

// Returns the index of refraction of a material with this reflectance along its normal in air.
float iorOfReflectance(float below) {
  float root = sqrt(min(below + 1e-4f, 0.9999f));
  return (1.0f + root) / (1.0f - root);
}

// Returns the reflectance, between 0 and 1, for light from a direction of this cosine in air. outside: index of
// refraction above the film (of a clear coat); thickness: nm; below: reflectance along the normal of the surface under
// the film.
vec3 filmReflectance(float cosine, float outside, float ior, float thickness, vec3 below) {
  float sine2 = (1.0f - cosine * cosine) / (ior * ior);
  if (sine2 >= 1.0f) return VEC3(1.0f);
  float from = sqrt(max(1.0f - (1.0f - cosine * cosine) / (outside * outside), 0.0f));
  float within = sqrt(1.0f - sine2);
  float top = filmSchlick(normalReflectance(ior, outside), from);
  float enters = 1.0f - top;
  vec3 base = VEC3(iorOfReflectance(below.x), iorOfReflectance(below.y), iorOfReflectance(below.z));
  vec3 bottom = VEC3(filmSchlick(normalReflectance(base.x, ior), within), filmSchlick(normalReflectance(base.y, ior), within),
                     filmSchlick(normalReflectance(base.z, ior), within));
  vec3 both = clamp(top * bottom, VEC3(1e-5f), VEC3(0.9999f));
  vec3 more = enters * enters * bottom / (VEC3(1.0f) - both);
  float turned = ior < outside ? 0.0f : 3.14159265f;
  vec3 shift = VEC3(turned + (base.x < ior ? 3.14159265f : 0.0f), turned + (base.y < ior ? 3.14159265f : 0.0f),
                    turned + (base.z < ior ? 3.14159265f : 0.0f));
  float path = 2.0f * ior * thickness * within;
  vec3 pair = sqrt(both);
  vec3 waves = filmSeen(path, shift) + pair * filmSeen(2.0f * path, 2.0f * shift);
  return clamp(VEC3(top) + more + 2.0f * (more - VEC3(enters)) * pair * waves, VEC3(0.0f), VEC3(1.0f));
}

// Returns the cosine-weighted mean over directions: Gauss' rule with two points.
vec3 meanFilmReflectance(float outside, float ior, float thickness, vec3 below) {
  return 0.3639172f * filmReflectance(0.3550510f, outside, ior, thickness, below) +
         0.6360828f * filmReflectance(0.8449490f, outside, ior, thickness, below);
}

// Returns the albedo under the film, by its largest channel, from the table that begins at `first`; relative: thickness
// in its range.
float filmAlbedo(TEXELS table, int first, float relative, float cosine, float roughness) {
  float layer = clamp(relative, 0.0f, 1.0f) * TO_FLOAT(PRELIGHT_FILM_THICKNESSES - 1);
  int t = min(TO_INT(layer), PRELIGHT_FILM_THICKNESSES - 2);
  int size = PRELIGHT_FILM_ROUGHNESSES * PRELIGHT_FILM_COSINES;
  vec4 thinner = betweenAlbedos(table, first + t * size, PRELIGHT_FILM_COSINES, PRELIGHT_FILM_ROUGHNESSES, cosine, roughness);
  vec4 thicker = betweenAlbedos(table, first + (t + 1) * size, PRELIGHT_FILM_COSINES, PRELIGHT_FILM_ROUGHNESSES, cosine, roughness);
  return mix(thinner.x, thicker.x, layer - TO_FLOAT(t));
}

// Returns the cosine-weighted mean of filmAlbedo over directions.
float meanFilmAlbedo(TEXELS table, int first, float relative, float roughness) {
  float layer = clamp(relative, 0.0f, 1.0f) * TO_FLOAT(PRELIGHT_FILM_THICKNESSES - 1);
  int t = min(TO_INT(layer), PRELIGHT_FILM_THICKNESSES - 2);
  float row = sqrt(clamp(roughness, 0.0f, 1.0f)) * TO_FLOAT(PRELIGHT_FILM_ROUGHNESSES - 1);
  int r = min(TO_INT(row), PRELIGHT_FILM_ROUGHNESSES - 2);
  int at = first + PRELIGHT_FILM_THICKNESSES * PRELIGHT_FILM_ROUGHNESSES * PRELIGHT_FILM_COSINES + t * PRELIGHT_FILM_ROUGHNESSES + r;
  float thinner = mix(FETCH(table, at).x, FETCH(table, at + 1).x, row - TO_FLOAT(r));
  float thicker =
      mix(FETCH(table, at + PRELIGHT_FILM_ROUGHNESSES).x, FETCH(table, at + PRELIGHT_FILM_ROUGHNESSES + 1).x, row - TO_FLOAT(r));
  return mix(thinner, thicker, layer - TO_FLOAT(t));
}

#endif
