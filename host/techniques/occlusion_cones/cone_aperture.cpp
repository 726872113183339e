#include "techniques/occlusion_cones/cone_aperture.h"

#include <algorithm>
#include <cmath>

#include "occluders/occluder_record.h"

namespace prelight {

namespace {

constexpr int halvings = 40;  // of a range of 1: beyond floats

}  // namespace

double coneAperture(double accessibility, double cosine) {
  // A cone lets through what a ball within it would hide: sine^2 cosine where it lies above the horizon.
  if (cosine > 0.0 && accessibility <= cosine * cosine * cosine)
    return std::sqrt(1.0 - std::max(0.0, accessibility) / cosine);
  // Where it does not, what it lets through still grows with the sine.
  double narrow = std::max(0.0, cosine), wide = 1.0;
  for (int i = 0; i < halvings; ++i) {
    const double sine = 0.5 * (narrow + wide);
    (ballFormFactor(cosine, sine) < accessibility ? narrow : wide) = sine;
  }
  return std::sqrt(std::max(0.0, 1.0 - wide * wide));
}

}  // namespace prelight
