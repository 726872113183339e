#include "benchmarks/suites/stability/trials.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace prelight::benchmarks::stability {

void Differences::add(double got, double truth, double scale) {
  ++values_;
  if (!std::isfinite(got)) {
    ++notFinite_;
    return;
  }
  const double off = std::abs(got - truth);
  absolute_ = std::max(absolute_, off);
  relative_ = std::max(relative_, off / std::max(scale, leastScale));
}

void Trials::record(std::string stress, const Differences& differences, double bound, Growth growth) {
  if (progress_.stopRequested()) throw Interrupted();
  trials_.push_back({subject_, std::move(stress), std::move(growth), differences, bound});
}

glm::dvec3 Random::direction() {
  const double z = between(-1.0, 1.0), turn = 2.0 * std::numbers::pi * unit();
  const double ring = std::sqrt(std::max(1.0 - z * z, 0.0));
  return {ring * std::cos(turn), ring * std::sin(turn), z};
}

std::vector<float> Random::floats(std::size_t count, double scale) {
  std::vector<float> values(count);
  for (float& value : values) value = static_cast<float>(between(-scale, scale));
  return values;
}

}  // namespace prelight::benchmarks::stability
