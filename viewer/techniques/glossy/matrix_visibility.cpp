#include "viewer/techniques/glossy/matrix_visibility.h"

#include <numbers>

#include "basis/quadrature.h"
#include "basis/sh_zonal.h"

namespace prelight::viewer {

MatrixVisibility::MatrixVisibility(int order) : factors_(static_cast<std::size_t>(2 * order - 1), 0.0) {
  std::vector<double> bands(static_cast<std::size_t>(order));
  for (std::size_t l = 0; l < bands.size(); ++l) bands[l] = 2.0 * static_cast<double>(l) + 1.0;
  std::vector<double> polynomial(factors_.size(), 0.0);
  double whole = 0.0;
  for (const LineSample& node : gaussLegendre(2 * order)) {
    const double kernel = sh::legendreSum(bands, node.position);
    whole += node.weight * kernel * kernel;
    for (std::size_t l = 0; l < factors_.size(); ++l) {
      polynomial.assign(factors_.size(), 0.0);
      polynomial[l] = 1.0;
      factors_[l] += node.weight * kernel * kernel * sh::legendreSum(polynomial, node.position);
    }
  }
  for (std::size_t l = 0; l < factors_.size(); ++l)
    factors_[l] *= sh::clampedCosine(static_cast<int>(l)) * (2.0 * static_cast<double>(l) + 1.0) /
                   (4.0 * std::numbers::pi * whole);
}

glm::dvec3 MatrixVisibility::mean(std::span<const glm::dvec3> rows, std::span<const double> basis) {
  glm::dvec3 sum(0.0);
  double square = 0.0;
  for (std::size_t i = 0; i < basis.size(); ++i) {
    sum += basis[i] * rows[i];
    square += basis[i] * basis[i];
  }
  return sum / square;
}

double MatrixVisibility::open(double cosine) const { return sh::legendreSum(factors_, cosine); }

}  // namespace prelight::viewer
