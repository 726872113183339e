#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace prelight {

/// A node of a quadrature rule on [-1, 1].
struct LineSample {
  double position = 0.0;
  double weight = 0.0;
};

/// Returns the Gauss-Legendre rule with `count` >= 1 nodes, ascending: exact for polynomials of degree 2
/// count - 1.
std::vector<LineSample> gaussLegendre(int count);

/// A direction of a quadrature rule on the sphere; the sum of the weights is 4 pi.
struct SphereSample {
  glm::dvec3 direction{0.0, 0.0, 1.0};
  double weight = 0.0;
};

/// Returns the product of Gauss-Legendre in z and equal steps in azimuth: exact for polynomials in (x, y, z)
/// of `degree` >= 0.
std::vector<SphereSample> sphereQuadrature(int degree);

}  // namespace prelight
