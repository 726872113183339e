#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>

namespace prelight {

/// A normal at which encodings are fitted.
struct FitNormal {
  glm::dvec3 direction{0.0, 0.0, 1.0};  ///< relative to the frame, whose z axis is the surface's own normal
  /// Cosine-weighted, as normal maps rarely lean towards the horizon; all weights sum to 1.
  double weight = 0.0;
};

constexpr std::size_t fitNormalCount = 72;

/// A quadrature rule on the hemisphere over the surface, for the weight max(z, 0) / pi: exact for polynomials
/// of degree 10 in the direction.
const std::array<FitNormal, fitNormalCount>& fitNormals();

/// Irradiance, W/m2, [fit normal].
using FitIrradiance = std::array<glm::dvec3, fitNormalCount>;

/// Returns the irradiance due to the light that an encoding is given (Encoding::encode): its SH convolved
/// with a cosine.
FitIrradiance fitIrradiance(std::span<const float> incident, const glm::mat3& frame);

// Weighted least squares over the fit normals: finds colours for functions of the normal whose sum is closest
// to given irradiance.

/// Values of functions: [fit normal][function].
template <std::size_t count>
using FitFunctions = std::array<std::array<double, count>, fitNormalCount>;

/// Weighted products of functions, [function][function].
template <std::size_t count>
using GramMatrix = std::array<double, count * count>;

/// One colour per function.
template <std::size_t count>
using FitColours = std::array<glm::dvec3, count>;

/// Solves `matrix` x = `right` in the least-squares sense. The matrix is [n][n], symmetric and positive
/// semidefinite; functions that are linearly dependent on earlier ones get 0. All but the first `free`
/// entries of x are constrained to be >= 0 (Lawson and Hanson 1974, ch. 23). n <= mostFitFunctions.
void solveLeastSquares(std::span<const double> matrix, std::span<const double> right, std::span<double> x,
                       std::size_t free);

constexpr std::size_t mostFitFunctions = 24;

template <std::size_t count>
GramMatrix<count> gramMatrix(const FitFunctions<count>& functions) {
  GramMatrix<count> gram{};
  for (std::size_t n = 0; n < fitNormalCount; ++n)
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j <= i; ++j)
        gram[i * count + j] += fitNormals()[n].weight * functions[n][i] * functions[n][j];
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < i; ++j) gram[j * count + i] = gram[i * count + j];
  return gram;
}

template <std::size_t count>
FitColours<count> rightSide(const FitFunctions<count>& functions, const FitIrradiance& irradiance) {
  FitColours<count> right{};
  for (std::size_t n = 0; n < fitNormalCount; ++n)
    for (std::size_t i = 0; i < count; ++i)
      right[i] += fitNormals()[n].weight * functions[n][i] * irradiance[n];
  return right;
}

/// Solves for the colours, each channel by itself.
template <std::size_t count>
FitColours<count> solveColours(const GramMatrix<count>& gram, const FitColours<count>& right,
                               std::size_t free) {
  static_assert(count <= mostFitFunctions);
  FitColours<count> colours{};
  for (int channel = 0; channel < 3; ++channel) {
    std::array<double, count> b, x;
    for (std::size_t i = 0; i < count; ++i) b[i] = right[i][channel];
    solveLeastSquares(gram, b, x, free);
    for (std::size_t i = 0; i < count; ++i) colours[i][channel] = x[i];
  }
  return colours;
}

/// Returns the squared error of colours minus that of darkness, summed over channels. It serves to compare
/// fits of the same irradiance.
template <std::size_t count>
double relativeError(const GramMatrix<count>& gram, const FitColours<count>& right,
                     const FitColours<count>& colours) {
  double error = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    error -= 2.0 * glm::dot(right[i], colours[i]);
    for (std::size_t j = 0; j < count; ++j) error += gram[i * count + j] * glm::dot(colours[i], colours[j]);
  }
  return error;
}

/// Writes colours as [function][channel].
template <std::size_t count>
void storeColours(const FitColours<count>& colours, std::span<float> values) {
  for (std::size_t i = 0; i < count; ++i)
    for (int channel = 0; channel < 3; ++channel)
      values[3 * i + static_cast<std::size_t>(channel)] = static_cast<float>(colours[i][channel]);
}

/// A fit whose functions are the same at all places, so that its solution is one precomputed matrix.
template <std::size_t count>
class LinearFit {
 public:
  explicit LinearFit(const FitFunctions<count>& functions) {
    const GramMatrix<count> gram = gramMatrix<count>(functions);
    for (std::size_t n = 0; n < fitNormalCount; ++n) {
      std::array<double, count> right, column;
      for (std::size_t i = 0; i < count; ++i) right[i] = fitNormals()[n].weight * functions[n][i];
      solveLeastSquares(gram, right, column, count);
      for (std::size_t i = 0; i < count; ++i) inverse_[i][n] = column[i];
    }
  }

  FitColours<count> colours(const FitIrradiance& irradiance) const {
    FitColours<count> found{};
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t n = 0; n < fitNormalCount; ++n) found[i] += inverse_[i][n] * irradiance[n];
    return found;
  }

 private:
  std::array<std::array<double, fitNormalCount>, count> inverse_{};
};

/// Evaluates functions of a normal, relative to the frame, at all fit normals.
template <std::size_t count, typename Functions>
FitFunctions<count> fitFunctions(Functions functions) {
  FitFunctions<count> values;
  for (std::size_t n = 0; n < fitNormalCount; ++n) {
    const auto found = functions(glm::vec3(fitNormals()[n].direction));
    for (std::size_t i = 0; i < count; ++i) values[n][i] = found[i];
  }
  return values;
}

}  // namespace prelight
