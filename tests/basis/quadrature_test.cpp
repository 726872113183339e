#include "basis/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace prelight {
namespace {

TEST(Quadrature, GaussLegendre_MonomialsUpToItsDegree_AreExact) {
  for (int count = 1; count <= 32; ++count) {
    for (int degree = 0; degree < 2 * count; ++degree) {
      double sum = 0.0;
      for (const LineSample& s : gaussLegendre(count)) sum += s.weight * std::pow(s.position, degree);
      EXPECT_NEAR(sum, degree % 2 == 0 ? 2.0 / (degree + 1.0) : 0.0, 1e-13) << count << " " << degree;
    }
  }
}

TEST(Quadrature, SphereQuadrature_AnyDegree_WeighsTheWholeSphereOnce) {
  for (const int degree : {0, 1, 2, 7, 14, 62}) {
    double area = 0.0;
    glm::dvec3 mean(0.0);
    for (const SphereSample& s : sphereQuadrature(degree)) {
      area += s.weight;
      mean += s.weight * s.direction;
      EXPECT_NEAR(glm::length(s.direction), 1.0, 1e-14);
    }
    EXPECT_NEAR(area, 4.0 * std::numbers::pi, 1e-12) << degree;
    EXPECT_LT(glm::length(mean), degree > 0 ? 1e-12 : 13.0) << degree;
  }
}

}  // namespace
}  // namespace prelight
