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

/// Errors of kernels and bases on hard inputs.
namespace prelight::benchmarks::stability {

/// Unit roundoff of float: half the distance from 1 to the next one.
constexpr double unitRoundoff = 0x1p-24;

/// Smallest scale to which errors are relative. A device may flush values below FLT_MIN to zero; this error
/// of FLT_MIN per operation is one unit roundoff of this scale.
constexpr double leastScale = double(std::numeric_limits<float>::min()) / unitRoundoff;

/// Returns a bound on the error of float sums of `terms` products, relative to the sum of their magnitudes,
/// in any order, with or without fused products (Higham 2002, "Accuracy and Stability of Numerical
/// Algorithms", 3.1).
constexpr double sumBound(double terms) { return terms * unitRoundoff / (1.0 - terms * unitRoundoff); }

/// Largest differences between computed and true values.
class Differences {
 public:
  /// Adds a value. `scale` (>= 0) is the size to which the error is relative: the truth's magnitude, unless a
  /// sum cancels.
  void add(double got, double truth, double scale);
  void add(double got, double truth) { add(got, truth, truth < 0.0 ? -truth : truth); }

  /// Adds a decision, which is right or wrong.
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

/// A parameter with which errors grow.
struct Growth {
  std::string parameter;  ///< "order", "texels per side"; empty: none
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

/// The device on which subjects run, and the trials that they report.
class Trials {
 public:
  Trials(const Device& device, const StabilityOptions& options, const Progress& progress)
      : device_(device), options_(options), progress_(progress) {}

  void begin(std::string subject) { subject_ = std::move(subject); }

  /// Adds a trial of the current subject. Throws Interrupted when the user wants to stop.
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

/// Random numbers of a seed.
class Random {
 public:
  explicit Random(std::uint32_t seed) : random_(seed) {}

  std::uint32_t bits() { return static_cast<std::uint32_t>(random_()); }
  double unit() { return double(bits()) * 0x1p-32; }  ///< [0,1)
  double between(double low, double high) { return low + (high - low) * unit(); }
  glm::dvec3 direction();                                      ///< uniform over the unit sphere
  std::vector<float> floats(std::size_t count, double scale);  ///< numbers of both signs, up to `scale`

 private:
  std::mt19937 random_;
};

enum class SubjectKind : std::uint8_t { Basis, Kernel, Pipeline };

/// A kernel, basis or pipeline whose errors are measured.
struct Subject {
  std::string name;
  SubjectKind kind = SubjectKind::Kernel;
  std::string truth;  ///< the values with which it is compared
  std::string scale;  ///< the size to which errors are relative
  std::string rests;  ///< why the bound is what it is
  std::vector<std::string>
      kernels;  ///< kernels that it runs: "lab/kernels/sh_evaluate_kernels.cl:evaluateSh"
  void (*run)(Trials&) = nullptr;
};

/// Returns all subjects. Together they run every kernel.
const std::vector<Subject>& subjects();

/// Returns a table of each subject's worst trial, by the share of its bound.
std::string worstTable(const std::vector<Trial>& trials);

/// Returns a table of the worst relative errors of bases by order.
std::string orderTable(const std::vector<Trial>& trials);

/// Returns a table of kernels and the subjects that run them.
std::string kernelTable();

/// Returns all tables of the trials on a device, as Markdown.
std::string makeReport(const std::vector<Trial>& trials, const std::string& device);

}  // namespace prelight::benchmarks::stability
