#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace prelight::benchmarks {

/// Exit radiance over albedo at every receiver.
using Lit = std::vector<glm::dvec3>;

/// Root of the sum of squared distances over that of squared lengths.
double relativeRms(const Lit& values, const Lit& exact);

/// How steady compressed lighting is while a light turns. The change from frame to frame that the exact
/// lighting makes is not counted.
class FlickerMeter {
 public:
  void add(const Lit& shown, const Lit& exact, std::size_t coefficients);

  double error() const;    ///< relative RMS of shown - exact over all frames
  double flicker() const;  ///< RMS over frames of the change of shown - exact, over the RMS of exact
  double worst() const;    ///< error of the worst frame
  double jump() const;  ///< greatest change of the receivers' mean of shown - exact, over the mean of exact
  double coefficients() const;  ///< mean over frames

 private:
  Lit before_;  ///< shown - exact of the last frame
  int frames_ = 0;
  double coefficients_ = 0.0;
  double errorSquares_ = 0.0;
  double exactSquares_ = 0.0;
  double changeSquares_ = 0.0;
  double worst_ = 0.0;
  double jump_ = 0.0;
};

}  // namespace prelight::benchmarks
