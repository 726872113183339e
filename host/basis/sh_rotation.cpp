#include "basis/sh_rotation.h"

#include <cassert>

#include "basis/quadrature.h"
#include "basis/sh_evaluate.h"

namespace prelight::sh {

std::vector<double> rotate(std::span<const double> coefficients, int order, const glm::dmat3& rotation) {
  assert(coefficients.size() == static_cast<std::size_t>(coefficientCount(order)));
  const int count = coefficientCount(order);
  const glm::dmat3 inverse = glm::transpose(rotation);
  std::vector<double> basis(count);
  std::vector<double> result(count, 0.0);
  for (const SphereSample& sample : sphereQuadrature(2 * order - 2)) {
    evaluate(inverse * sample.direction, order, basis);
    double value = 0.0;
    for (int i = 0; i < count; ++i) value += coefficients[i] * basis[i];
    evaluate(sample.direction, order, basis);
    for (int i = 0; i < count; ++i) result[i] += sample.weight * value * basis[i];
  }
  return result;
}

}  // namespace prelight::sh
