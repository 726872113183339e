#include "benchmarks/suites/relighting/flicker.h"

#include <algorithm>
#include <cmath>

namespace prelight::benchmarks {

double relativeRms(const Lit& values, const Lit& exact) {
  FlickerMeter meter;
  meter.add(values, exact, 0);
  return meter.error();
}

void FlickerMeter::add(const Lit& shown, const Lit& exact, std::size_t coefficients) {
  double changes = 0.0, squares = 0.0;
  glm::dvec3 meanChange(0.0), mean(0.0);
  Lit difference(shown.size());
  for (std::size_t v = 0; v < shown.size(); ++v) {
    difference[v] = shown[v] - exact[v];
    errorSquares_ += glm::dot(difference[v], difference[v]);
    squares += glm::dot(exact[v], exact[v]);
    mean += exact[v];
    if (before_.empty()) continue;
    const glm::dvec3 change = difference[v] - before_[v];
    changes += glm::dot(change, change);
    meanChange += change;
  }
  exactSquares_ += squares;
  changeSquares_ += changes;
  worst_ = std::max(worst_, std::sqrt(changes / squares));
  jump_ = std::max(jump_, glm::length(meanChange) / glm::length(mean));
  coefficients_ += static_cast<double>(coefficients);
  before_ = std::move(difference);
  ++frames_;
}

double FlickerMeter::error() const { return std::sqrt(errorSquares_ / exactSquares_); }

double FlickerMeter::flicker() const {
  const double meanSquare = exactSquares_ / frames_;
  return frames_ > 1 ? std::sqrt(changeSquares_ / (frames_ - 1) / meanSquare) : 0.0;
}

double FlickerMeter::worst() const { return worst_; }
double FlickerMeter::jump() const { return jump_; }
double FlickerMeter::coefficients() const { return coefficients_ / frames_; }

}  // namespace prelight::benchmarks
