#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/picture.h"

/// Functions of directions that transfer and lights are stored in: docs/conventions.md has axes, signs and
/// indices, docs/bases.md and docs/wavelets.md the rest. Order n means bands 0 to n - 1, n^2 coefficients, 1
/// to 32. All throw UsageError for an order or a face size out of range and for values that are too few or
/// not finite.
namespace prelight {

/// Spherical or "cpherical" harmonics.
enum class HarmonicBasis : std::uint8_t { Sh, Ch };

/// Values of all functions in every direction (of any length but 0): [direction][i].
std::vector<double> basisValues(HarmonicBasis basis, std::span<const glm::dvec3> directions, int order);

/// A rule that integrates over the sphere.
struct SphereRule {
  std::vector<glm::dvec3> directions;  ///< unit
  std::vector<double> weights;         ///< of sum 4 pi
};

/// Exact for polynomials in (x, y, z) of a degree, 0 to 1024.
SphereRule sphereRule(int degree);

/// SH coefficients of a sky's radiance: [channel][i]. Exact for texels of constant radiance.
std::vector<double> projectSky(const Environment& sky, int order);

/// Coefficients of rotated functions f'(w) = f(R^-1 w): one or several functions of order^2 coefficients, one
/// behind the other. `rotation` is orthonormal; it may mirror.
std::vector<double> rotateHarmonics(HarmonicBasis basis, std::span<const double> coefficients, int order,
                                    const glm::dmat3& rotation);

/// CH coefficients a with sum a_i C_i = sum y_i Y_i of one or several functions, and back.
std::vector<double> chFromSh(std::span<const double> sh, int order);
std::vector<double> shFromCh(std::span<const double> ch, int order);

/// Moments <f, C_i> of functions that are given in SH: what a light must be for transfer in CH.
std::vector<double> chMomentsFromSh(std::span<const double> sh, int order);

/// A sky as mean radiance of the texels of a cube map: [face][row][column]; faces and axes are those of
/// docs/wavelets.md. The face size is a power of two, 1 to 1024.
std::vector<glm::vec3> cubeOfSky(const Environment& sky, int faceSize);

/// Unit directions of the texels' centres: [face][row][column].
std::vector<glm::dvec3> cubeDirections(int faceSize);

/// Haar wavelets of one or several cube maps of 6 faceSize^2 values each, in place, and back.
void haarForward(std::span<float> values, int faceSize);
void haarInverse(std::span<float> values, int faceSize);

/// Texels of a rotated cube map, as means over the texels that they overlap: keeps flux. One or several maps.
std::vector<float> rotateCube(std::span<const float> texels, int faceSize, const glm::dmat3& rotation);

/// The fewest coefficients whose relative L2 error is at most `relativeError`, 0..1: indices, ascending.
std::vector<std::uint32_t> haarKept(std::span<const float> coefficients, double relativeError);

}  // namespace prelight
