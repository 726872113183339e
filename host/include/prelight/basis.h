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
