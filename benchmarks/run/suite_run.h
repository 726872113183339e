#pragma once

#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "prelight/progress.h"

namespace prelight::benchmarks {

/// One number that was measured. Times are medians over the runs that follow a warm-up.
struct BenchmarkResult {
  std::string case_;            ///< the case, from the general to the particular: "shapes/any hit"
  std::string metric;           ///< "throughput", "total", ...
  double value = 0.0;           ///< finite, in `unit`
  std::string unit;             ///< "rays/s", "s", "AO"
  std::string peer;             ///< the other side of `ratio`, measured in the same run; empty: nothing
  std::optional<double> ratio;  ///< > 1: better than the peer
};

/// {case, metric, value, unit, peer, ratio}; peer and ratio are null where there is none.
nlohmann::ordered_json toJson(const std::string& suite, const BenchmarkResult& result);

/// A suite at work. What it has measured is handed on whenever it reports progress, so that a run that is cut
/// keeps it.
class SuiteRun final : public Progress {
 public:
  /// Gets what is new.
  using Keep = std::function<void(std::span<const BenchmarkResult>)>;

  /// `outer` outlives it.
  SuiteRun(Progress& outer, Keep keep);
  ~SuiteRun() override;

  /// So far, in the order in which they were measured. Suites add to its end and change nothing before.
  std::vector<BenchmarkResult>& results() { return results_; }

  /// Hands on what is new, and tells how much time is left if the rest goes on like this.
  void report(std::string_view stage, double fraction) override;
  bool stopRequested() const override { return outer_.stopRequested(); }

  /// Hands on what came after the last report.
  void finish();

 private:
  Progress& outer_;
  Keep keep_;
  std::vector<BenchmarkResult> results_;
  std::size_t kept_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// "0:05", "12:40", "1:02:30".
std::string clockText(double seconds);

}  // namespace prelight::benchmarks
