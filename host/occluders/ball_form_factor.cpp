#include "occluders/ball_form_factor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace prelight {

double ballFormFactor(double cosine, double sine) {
  if (!(sine > 0.0) || cosine <= -sine) return 0.0;
  if (cosine >= sine) return std::min(1.0, sine * sine * cosine);
  // Only the part above the horizon counts; h = 1 / sine, k = sqrt(h^2 - 1).
  const double h = 1.0 / sine, k = std::sqrt(std::max(0.0, h * h - 1.0));
  const double across = std::sqrt(std::max(1e-12, 1.0 - cosine * cosine));
  const double rim = std::asin(std::clamp(k / (h * across), -1.0, 1.0));
  const double arc = std::acos(std::clamp(-k * cosine / across, -1.0, 1.0));
  const double chord = k * std::sqrt(std::max(0.0, 1.0 - h * h * cosine * cosine));
  const double factor = 0.5 - rim / std::numbers::pi + (cosine * arc - chord) / (std::numbers::pi * h * h);
  return std::clamp(factor, 0.0, 1.0);
}

}  // namespace prelight
