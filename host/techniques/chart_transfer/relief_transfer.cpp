#include "techniques/chart_transfer/relief_transfer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "basis/sh_evaluate.h"
#include "scene/surface/relief.h"

namespace prelight {

void hiddenByRelief(const ReliefPoint& point, const glm::dvec3& bumped, int order, std::span<double> hidden) {
  using std::numbers::pi;
  constexpr int heights = 3;
  std::vector<double> basis(hidden.size());
  std::fill(hidden.begin(), hidden.end(), 0.0);
  for (int k = 0; k < Relief::azimuths; ++k) {
    const double most = double(point.horizon[k]), turn = 2.0 * pi * k / Relief::azimuths;
    const glm::dvec3 along = std::cos(turn) * point.tangent + std::sin(turn) * point.bitangent;
    // Equal steps of the sine are equal solid angles.
    for (int step = 0; step < heights && most > 0.0; ++step) {
      const double sine = most * (step + 0.5) / heights;
      const glm::dvec3 w = std::sqrt(1.0 - sine * sine) * along + sine * point.normal;
      const double weight =
          std::max(glm::dot(bumped, w), 0.0) / pi * (2.0 * pi / Relief::azimuths) * (most / heights);
      if (weight <= 0.0) continue;
      sh::evaluate(glm::normalize(w), order, basis);
      for (std::size_t i = 0; i < hidden.size(); ++i) hidden[i] += weight * basis[i];
    }
  }
}

}  // namespace prelight
