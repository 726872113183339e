#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "benchmarks/suites/stability/stability_suite.h"
#include "device/context.h"
#include "prelight/error.h"
#include "prelight/progress.h"

/// Errors of kernels and bases on inputs that are hard on them.
namespace prelight::benchmarks::stability {

/// Unit roundoff of float: half the distance from 1 to the next one.
constexpr double unitRoundoff = 0x1p-24;

/// Below this scale errors are judged as if the scale were this: a device may flush what is below FLT_MIN to
/// zero, which costs an operation FLT_MIN, one unit roundoff of this.
constexpr double leastScale = double(std::numeric_limits<float>::min()) / unitRoundoff;

/// Bound on the error of float sums of `terms` products, relative to the sum of their magnitudes, in whatever
/// order they are added, with fused products or without (Higham 2002, "Accuracy and Stability of Numerical
/// Algorithms", 3.1).
constexpr double sumBound(double terms) { return terms * unitRoundoff / (1.0 - terms * unitRoundoff); }

/// Worst differences between what was computed and what is right.
class Differences {
 public:
  /// `scale`, >= 0: what the error is relative to; the truth's own magnitude unless a sum cancels.
  void add(double got, double truth, double scale);
  void add(double got, double truth) { add(got, truth, truth < 0.0 ? -truth : truth); }

  /// A decision, which is right or wrong.
  void decide(bool right) { add(right ? 1.0 : 0.0, 1.0, 1.0); }

  double relative() const { return relative_; }
  double absolute() const { return absolute_; }
  std::size_t values() const { return values_; }
  std::size_t notFinite() const { return notFinite_; }

 private:
  double relative_ = 0.0;
  double absolute_ = 0.0;
  std::size_t values_ = 0;
  std::size_t notFinite_ = 0;
};

/// A parameter that errors grow with.
struct Growth {
  std::string parameter;  ///< "order", "texels a side"; empty: nothing
  double at = 0.0;
};

struct Trial {
  std::string subject;
  std::string stress;  ///< why the inputs are hard
  Growth growth;
  Differences differences;
  double bound = 0.0;  ///< on the relative error

  bool holds() const { return differences.notFinite() == 0 && differences.relative() <= bound; }
};

/// The device that subjects run on, and the trials that they report.
class Trials {
 public:
  Trials(const Device& device, const StabilityOptions& options, const Progress& progress)
      : device_(device), options_(options), progress_(progress) {}

  void begin(std::string subject) { subject_ = std::move(subject); }

  /// Throws Interrupted when the user wants to stop.
  void record(std::string stress, const Differences& differences, double bound, Growth growth = {});

  const Device& device() const { return device_; }
  DeviceContext& context() const { return device_.context(); }
  const StabilityOptions& options() const { return options_; }
  const std::vector<Trial>& all() const { return trials_; }

 private:
  const Device& device_;
  const StabilityOptions& options_;
  const Progress& progress_;
  std::string subject_;
  std::vector<Trial> trials_;
};

/// Numbers of one seed.
class Random {
 public:
  explicit Random(std::uint32_t seed) : random_(seed) {}

  std::uint32_t bits() { return static_cast<std::uint32_t>(random_()); }
  double unit() { return double(bits()) * 0x1p-32; }  ///< [0,1)
  double between(double low, double high) { return low + (high - low) * unit(); }
  glm::dvec3 direction();                                      ///< uniform over the sphere
  std::vector<float> floats(std::size_t count, double scale);  ///< numbers of both signs, up to `scale`

 private:
  std::mt19937 random_;
};

}  // namespace prelight::benchmarks::stability
