#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace prelight::viewer {

/// Visibility of single directions at a receiver, by its glossy matrix, M_ij = integral of V cos / pi Y_i
/// Y_j. With the values y_i of the functions in a direction, y M y / (y y) is the mean of V cos / pi over a
/// kernel: the square of the narrowest function of the bands about the direction. It knows twice the bands of
/// M's rows, is nowhere negative, and rings little.
class MatrixVisibility {
 public:
  explicit MatrixVisibility(int order);

  /// Returns the mean from M y, [i] per channel, and y.
  static glm::dvec3 mean(std::span<const glm::dvec3> rows, std::span<const double> basis);

  /// Returns the mean of an open receiver in a direction at an angle of this cosine to its normal.
  double open(double cosine) const;

 private:
  std::vector<double> factors_;  ///< [band], of Legendre polynomials of the cosine
};

}  // namespace prelight::viewer
