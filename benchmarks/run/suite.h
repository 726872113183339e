#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/run/option_table.h"
#include "benchmarks/run/run_options.h"
#include "benchmarks/run/suite_run.h"
#include "prelight/device.h"

namespace prelight::benchmarks {

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

  /// A part's name before the names of its cases, where there is more than one part: "cast/".
  std::string casePrefix(const std::string& part) const { return parts_.size() > 1 ? part + "/" : ""; }

  virtual std::vector<OptionText> options() const = 0;

  /// Takes the options of a run. Everything below measures with them.
  virtual void configure(const RunOptions& run) = 0;

  /// The values of its own options.
  virtual nlohmann::ordered_json toJson() const = 0;

  /// Whether a part has a case that RunOptions::onlyCase chooses: where that is empty, every part has.
  virtual bool hasChosenCase(const std::string& part) const = 0;

  /// Measures a part; `run` has the results. Throws Interrupted when `run` is asked to stop, and what the
  /// library throws.
  virtual void run(const std::string& part, const Device& device, SuiteRun& run) const = 0;

  /// Bounds that its results were to keep and did not, a sentence for each.
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
  bool (*hasChosenCase)(const Options&) = nullptr;  ///< null: its cases are not chosen from
};

/// A suite whose options are of a type of its own, which has their table().
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
