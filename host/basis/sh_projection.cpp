#include "basis/sh_projection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "basis/quadrature.h"
#include "basis/sh_evaluate.h"
#include "prelight/error.h"

namespace prelight::sh {

std::vector<double> project(const DirectionFunction& f, int degree, int order) {
  checkOrder(order, "projection");
  if (degree < 0) throw UsageError("projection", "expected a degree >= 0, got " + std::to_string(degree));
  std::vector<double> values(coefficientCount(order));
  std::vector<double> sum(values.size(), 0.0);
  for (const SphereSample& s : sphereQuadrature(degree + order - 1)) {
    const double value = f(s.direction);
    if (!std::isfinite(value)) {
      throw Error(ExitCode::RuntimeFailure, "projection",
                  "the function is not finite in direction (" + std::to_string(s.direction.x) + ", " +
                      std::to_string(s.direction.y) + ", " + std::to_string(s.direction.z) + ")");
    }
    evaluate(s.direction, order, values);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += s.weight * value * values[i];
  }
  return sum;
}

Projection projectWithin(const DirectionFunction& f, double tolerance, int order, int largestDegree) {
  checkOrder(order, "projection");
  if (!(tolerance > 0.0)) {
    throw UsageError("projection", "expected a tolerance > 0, got " + std::to_string(tolerance));
  }
  int degree = std::min(2 * order, largestDegree);
  Projection result{project(f, degree, order), std::numeric_limits<double>::infinity(), degree};
  while (result.error > tolerance && 2 * degree <= largestDegree) {
    degree *= 2;
    std::vector<double> finer = project(f, degree, order);
    double change = 0.0;
    for (std::size_t i = 0; i < finer.size(); ++i) {
      change = std::max(change, std::abs(finer[i] - result.coefficients[i]));
    }
    result = {std::move(finer), change, degree};
  }
  return result;
}

}  // namespace prelight::sh
