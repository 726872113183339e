#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "benchmarks/run/options.h"
#include "prelight/device.h"
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

/// Returns {suite, case, metric, value, unit, peer, ratio}; peer and ratio are null if the result has none.
nlohmann::ordered_json toJson(const std::string& suite, const BenchmarkResult& result);

/// Results of a suite that is running. New results are handed on at every report of progress, so that an
/// interrupted run keeps them.
class SuiteRun final : public Progress {
 public:
  /// Receives new results.
  using Keep = std::function<void(std::span<const BenchmarkResult>)>;

  /// `outer` must outlive this object.
  SuiteRun(Progress& outer, Keep keep);
  ~SuiteRun() override;

  /// Returns the results so far, in order of measurement. Suites only append to them.
  std::vector<BenchmarkResult>& results() { return results_; }

  /// Hands on new results, and tells `outer` the time that is left at the present pace.
  void report(std::string_view stage, double fraction) override;
  bool stopRequested() const override { return outer_.stopRequested(); }

  /// Hands on the results that came after the last report.
  void finish();

 private:
  Progress& outer_;
  Keep keep_;
  std::vector<BenchmarkResult> results_;
  std::size_t kept_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Returns a duration as "0:05", "12:40" or "1:02:30".
std::string clockText(double seconds);

/// Measurements that belong together. A suite owns its options and has one part or several, each of which can
/// be run alone; the only part of a suite has the suite's name.
class Suite {
 public:
  struct Part {
    std::string name;
    std::string description;
  };

  Suite(std::string name, std::string description, std::vector<Part> parts)
      : name_(std::move(name)), description_(std::move(description)), parts_(std::move(parts)) {}
  virtual ~Suite() = default;
  Suite(const Suite&) = delete;
  Suite& operator=(const Suite&) = delete;

  const std::string& name() const { return name_; }
  const std::string& description() const { return description_; }
  const std::vector<Part>& parts() const { return parts_; }

  /// Returns the prefix of the names of a part's cases: "cast/", or "" if the suite has one part.
  std::string casePrefix(const std::string& part) const { return parts_.size() > 1 ? part + "/" : ""; }

  virtual std::vector<OptionText> options() const = 0;

  /// Takes the options of a run. Everything below measures with them.
  virtual void configure(const RunOptions& run) = 0;

  /// Returns the values of the suite's own options.
  virtual nlohmann::ordered_json toJson() const = 0;

  /// Returns whether RunOptions::onlyCase chooses a case of a part. An empty text chooses all.
  virtual bool hasChosenCase(const std::string& part) const = 0;

  /// Measures a part and adds the results to `run`. Throws Interrupted when the user stops it, and errors of
  /// the library.
  virtual void run(const std::string& part, const Device& device, SuiteRun& run) const = 0;

  /// Returns a sentence for each bound that the results break.
  virtual std::vector<std::string> brokenBounds(std::span<const BenchmarkResult> results) const = 0;

 private:
  std::string name_;
  std::string description_;
  std::vector<Part> parts_;
};

/// A part of a suite and the functions that run it.
template <typename Options>
struct PartRunner {
  const char* name;
  const char* description;
  void (*run)(const Device&, const Options&, SuiteRun&);
  bool (*hasChosenCase)(const Options&) = nullptr;  ///< null: the part always runs whole
};

/// A suite with options of its own type, whose table() states them.
template <typename Options>
class SuiteOf final : public Suite {
 public:
  using Runners = std::vector<PartRunner<Options>>;
  using BoundCheck = std::vector<std::string> (*)(std::span<const BenchmarkResult>);

  SuiteOf(const char* name, const char* description, Runners runners, BoundCheck broken = nullptr)
      : Suite(name, description, partsOf(runners)), runners_(std::move(runners)), broken_(broken) {}

  std::vector<OptionText> options() const override { return Options::table().texts(); }
  void configure(const RunOptions& run) override { options_ = optionsIn<Options>(run); }
  nlohmann::ordered_json toJson() const override { return Options::table().toJson(options_); }

  bool hasChosenCase(const std::string& part) const override {
    const PartRunner<Options>& runner = named(part);
    if (options_.onlyCase.empty()) return true;
    return runner.hasChosenCase != nullptr && runner.hasChosenCase(options_);
  }

  void run(const std::string& part, const Device& device, SuiteRun& run) const override {
    named(part).run(device, options_, run);
  }

  std::vector<std::string> brokenBounds(std::span<const BenchmarkResult> results) const override {
    return broken_ == nullptr ? std::vector<std::string>() : broken_(results);
  }

 private:
  static std::vector<Part> partsOf(const Runners& runners) {
    std::vector<Part> parts;
    for (const PartRunner<Options>& runner : runners) parts.push_back({runner.name, runner.description});
    return parts;
  }

  const PartRunner<Options>& named(const std::string& part) const {
    for (const PartRunner<Options>& runner : runners_)
      if (part == runner.name) return runner;
    return runners_.front();
  }

  Runners runners_;
  BoundCheck broken_;
  Options options_ = optionsIn<Options>({});
};

}  // namespace prelight::benchmarks
