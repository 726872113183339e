// Albedos of anisotropic GGX microfacets at their first bounce, by direction, from a table that
// host/gpu/anisotropic_table.h computes. OpenCL C and GLSL. Directions are in a frame whose x axis runs along the wider
// of two widths and whose z axis is the normal.
//
// Total: stretching a direction by the widths gives a direction along which a half sphere is as visible as the
// microfacets are (Heitz 2018). The total that leaves is a smooth function of that direction's height and azimuth,
// however narrow the lobe. The rows are at equal steps of the arc sine of the root of the height; over the cosine of
// twice the azimuth, a parabola runs through the values at 1, 0 and -1.
//
// Rise of Schlick's term: it follows from the cosine with an effective facet that would show this rise. Facets tilt
// most in the plane of the wider width, so the amount by which that cosine lies above the direction's own varies with
// the direction's reach, its length in this plane, and with its height there. The table holds that amount as a share of
// its bound, which is the reach or, where that is small, the narrower width; the share is smooth. Rows are at equal
// steps of the root of the height, and within a row at equal steps of the root of the reach.
//
// Texels: the totals at 1, 0 and -1, then the shares, three steps of the reach and the next one per texel. Narrower
// widths are cubes of equal steps; the excess of the wider ones, as a share of the greatest possible, are squares of
// equal steps.
#ifndef PRELIGHT_TRANSPORT_ANISOTROPIC_ALBEDO_FUNCS_CL
#define PRELIGHT_TRANSPORT_ANISOTROPIC_ALBEDO_FUNCS_CL

#include "core/dialect.h"
#include "shared/albedo_types.h"

// Interpolates between four texels: that at `at`, the next by `step`, and the two that follow these by `row`.
vec4 betweenFour(TEXELS table, int at, int step, int row, float x, float y) {
  vec4 first = mix(FETCH(table, at), FETCH(table, at + step), x);
  vec4 second = mix(FETCH(table, at + row), FETCH(table, at + row + step), x);
  return mix(first, second, y);
}

// The first texel for a pair of widths and a height, and the position between it and the next ones.
STRUCT_NAME(AnisotropicCell)
struct AnisotropicCell {
  int at;
  float across;
  float stretch;
  float height;
};

AnisotropicCell anisotropicCell(float along, float across, float height) {
  AnisotropicCell cell;
  cell.across = exp2(log2(clamp(across, 1e-9f, 1.0f)) * 0.333333333f) * TO_FLOAT(PRELIGHT_ANISOTROPIC_ACROSS - 1);
  cell.stretch = sqrt(clamp((along - across) / max(1.0f - across, 1e-6f), 0.0f, 1.0f)) * TO_FLOAT(PRELIGHT_ANISOTROPIC_STRETCHES - 1);
  cell.height = clamp(height, 0.0f, 1.0f) * TO_FLOAT(PRELIGHT_ANISOTROPIC_HEIGHTS - 1);
  int a = min(TO_INT(cell.across), PRELIGHT_ANISOTROPIC_ACROSS - 2);
  int s = min(TO_INT(cell.stretch), PRELIGHT_ANISOTROPIC_STRETCHES - 2);
  int h = min(TO_INT(cell.height), PRELIGHT_ANISOTROPIC_HEIGHTS - 2);
  cell.at = PRELIGHT_ANISOTROPIC_FIRST + PRELIGHT_ANISOTROPIC_TEXELS * ((a * PRELIGHT_ANISOTROPIC_STRETCHES + s) * PRELIGHT_ANISOTROPIC_HEIGHTS + h);
  cell.across = cell.across - TO_FLOAT(a);
  cell.stretch = cell.stretch - TO_FLOAT(s);
  cell.height = cell.height - TO_FLOAT(h);
  return cell;
}

vec4 betweenCells(TEXELS table, AnisotropicCell cell, int texel) {
  int row = PRELIGHT_ANISOTROPIC_TEXELS * PRELIGHT_ANISOTROPIC_HEIGHTS;
  int at = cell.at + texel;
  vec4 narrower = betweenFour(table, at, PRELIGHT_ANISOTROPIC_TEXELS, row, cell.height, cell.stretch);
  vec4 wider =
      betweenFour(table, at + PRELIGHT_ANISOTROPIC_STRETCHES * row, PRELIGHT_ANISOTROPIC_TEXELS, row, cell.height, cell.stretch);
  return mix(narrower, wider, cell.across);
}

// Returns 1 - the cosine with the effective facet for a direction.
float anisotropicGrazing(TEXELS table, vec3 w, float along, float across) {
  float cosine = clamp(w.z, 0.0f, 1.0f);
  float reach2 = min(w.x * w.x + cosine * cosine, 1.0f);
  float reach = sqrt(reach2);
  float place = sqrt(reach) * TO_FLOAT(PRELIGHT_ANISOTROPIC_REACHES - 1);
  int step = min(TO_INT(place), PRELIGHT_ANISOTROPIC_REACHES - 2);
  float part = place - TO_FLOAT(step);
  int texel = step / 3;
  AnisotropicCell cell = anisotropicCell(along, across, sqrt(min(cosine / max(reach, 1e-6f), 1.0f)));
  vec4 shares = betweenCells(table, cell, 1 + texel);
  float share = step == 3 * texel       ? mix(shares.x, shares.y, part)
                : step == 3 * texel + 1 ? mix(shares.y, shares.z, part)
                                        : mix(shares.z, shares.w, part);
  return clamp(1.0f - cosine - share * sqrt(reach2 + across * across * (1.0f - reach2)), 0.0f, 1.0f);
}

// Returns the albedos for a direction above the surface, with the widths along x and y; the first is the larger one.
vec4 anisotropicAlbedo(TEXELS table, vec3 w, float along, float across) {
  float x2 = w.x * w.x;
  float y2 = w.y * w.y;
  x2 = x2 * along * along;
  y2 = y2 * across * across;
  float square = x2 + y2;
  float turn = square > 1e-20f ? (x2 - y2) / square : 0.0f;
  float up = clamp(w.z * INVERSE_SQRT(max(square + w.z * w.z, 1e-20f)), 0.0f, 1.0f);
  vec4 sums = betweenCells(table, anisotropicCell(along, across, 0.636619772f * asin(sqrt(up))), 0);
  float all = sums.x * (0.5f * turn * (turn + 1.0f)) + sums.y * (1.0f - turn * turn) + sums.z * (0.5f * turn * (turn - 1.0f));
  all = clamp(all, 0.0f, 1.0f);  // the parabola may overshoot between its nodes
  float grazing = anisotropicGrazing(table, w, along, across);
  float rise = grazing * grazing * grazing * grazing * grazing;
  return VEC4(all * (1.0f - rise), all * rise, 0.0f, 0.0f);
}

// Returns their cosine-weighted mean over directions.
vec4 meanAnisotropicAlbedo(TEXELS table, float along, float across) {
  AnisotropicCell cell = anisotropicCell(along, across, 0.0f);
  int row = (cell.at - PRELIGHT_ANISOTROPIC_FIRST) / (PRELIGHT_ANISOTROPIC_TEXELS * PRELIGHT_ANISOTROPIC_HEIGHTS);
  int first = PRELIGHT_ANISOTROPIC_FIRST + PRELIGHT_ANISOTROPIC_TEXELS * PRELIGHT_ANISOTROPIC_HEIGHTS * PRELIGHT_ANISOTROPIC_ROWS;
  return betweenFour(table, first + row, 1, PRELIGHT_ANISOTROPIC_STRETCHES, cell.stretch, cell.across);
}

#endif
