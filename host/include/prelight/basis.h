#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/picture.h"

/// Basis functions on the sphere that store transfer and lights. docs/conventions.md defines axes, signs and
/// indices; docs/notes/bases.md and docs/notes/wavelets.md explain the bases. Order n, 1 to 32, means bands 0
/// to n - 1, which have n^2 coefficients. All functions throw UsageError for an order or a face size out of
/// range and for values that are too few or not finite.
namespace prelight {

/// Spherical or "cpherical" harmonics.
enum class HarmonicBasis : std::uint8_t { Sh, Ch };

/// Returns the values of all basis functions in each direction, [direction][i]. Directions may have any
/// length but 0.
std::vector<double> basisValues(HarmonicBasis basis, std::span<const glm::dvec3> directions, int order);

/// A quadrature rule for the sphere.
struct SphereRule {
  std::vector<glm::dvec3> directions;  ///< unit
  std::vector<double> weights;         ///< their sum is 4 pi
};

/// Returns a rule that is exact for polynomials in (x, y, z) of the degree, 0 to 1024.
SphereRule sphereRule(int degree);

/// Returns the SH coefficients of a sky's radiance, [channel][i], exact for texels of constant radiance.
std::vector<double> projectSky(const Environment& sky, int order);

/// Returns the coefficients of rotated functions f'(w) = f(R^-1 w). `coefficients` holds one or several
/// functions of order^2 coefficients, one after the other. `rotation` is orthonormal and may be a reflection.
std::vector<double> rotateHarmonics(HarmonicBasis basis, std::span<const double> coefficients, int order,
                                    const glm::dmat3& rotation);

/// Converts one or several functions between the bases: sum a_i C_i = sum y_i Y_i for CH coefficients a and
/// SH coefficients y.
std::vector<double> chFromSh(std::span<const double> sh, int order);
std::vector<double> shFromCh(std::span<const double> ch, int order);

/// Returns the moments <f, C_i> of functions given in SH. Lights must have this form for transfer in CH.
std::vector<double> chMomentsFromSh(std::span<const double> sh, int order);

/// Returns the first `order` bands of the product of two functions in SH, of fOrder and gOrder bands,
/// exactly.
std::vector<double> multiplySh(std::span<const double> f, int fOrder, std::span<const double> g, int gOrder,
                               int order);

/// Returns the matrix [i][j] of multiplying functions of `order` bands by f, of fOrder bands, and cutting the
/// product to `order` bands: order^4 entries, symmetric.
std::vector<double> productMatrix(std::span<const double> f, int fOrder, int order);

/// Gamma_ijk = integral Y_i Y_j Y_k, one of the few that are not 0.
struct TripleProduct {
  std::uint32_t i = 0;
  std::uint32_t j = 0;
  std::uint32_t k = 0;
  double value = 0.0;
};

/// Returns all Gamma_ijk that are not 0 with i and j < order^2, i <= j, and k < kOrder^2, sorted by i, j, k.
std::vector<TripleProduct> tripleProducts(int order, int kOrder);

// Zonal functions depend only on the angle to an axis. They have one coefficient per band, z_l = integral f
// Y_l0, that of the function whose axis is z.

/// Returns z_l of max(cos, 0) / pi: the transfer of an open receiver, rotateZonal() to its normal.
std::vector<double> zonalClampedCosine(int order);

/// Returns z_l of the function that is 1 within `halfAngle`, 0 to pi radians, of the axis and 0 elsewhere.
std::vector<double> zonalCap(double halfAngle, int order);

/// Returns z_l of the lobe (exponent + 1) / (2 pi) max(cos, 0)^exponent, whose integral is 1; exponent >= 0.
std::vector<double> zonalCosinePower(double exponent, int order);

/// Returns the SH coefficients of a zonal function about an axis of any length but 0.
std::vector<double> rotateZonal(std::span<const double> zonal, const glm::dvec3& axis);

/// Returns one or several functions of zonal.size() bands in SH, convolved with a zonal function. The
/// irradiance at open receivers by their normal is pi x radiance convolved with zonalClampedCosine().
std::vector<double> convolveSh(std::span<const double> coefficients, std::span<const double> zonal);

/// Returns a sky as the mean radiance of each texel of a cube map, [face][row][column].
/// docs/notes/wavelets.md defines faces and axes. The face size is a power of two, 1 to 1024.
std::vector<glm::vec3> cubeOfSky(const Environment& sky, int faceSize);

/// Returns the unit directions of the texels' centres, [face][row][column].
std::vector<glm::dvec3> cubeDirections(int faceSize);

/// Transforms one or several cube maps of 6 faceSize^2 values to Haar wavelets and back, in place.
void haarForward(std::span<float> values, int faceSize);
void haarInverse(std::span<float> values, int faceSize);

/// Returns one or several rotated cube maps, whose texels are means over the texels that they overlap, so
/// that flux is kept.
std::vector<float> rotateCube(std::span<const float> texels, int faceSize, const glm::dmat3& rotation);

/// Returns the indices, ascending, of the fewest coefficients whose relative L2 error is at most
/// `relativeError`, 0..1.
std::vector<std::uint32_t> haarKept(std::span<const float> coefficients, double relativeError);

}  // namespace prelight
