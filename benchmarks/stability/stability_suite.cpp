#include "benchmarks/stability/stability_suite.h"

#include <fmt/format.h>

#include <fstream>

#include "benchmarks/measure.h"
#include "benchmarks/stability/report.h"
#include "benchmarks/stability/subjects.h"
#include "benchmarks/suites.h"
#include "prelight/error.h"

namespace prelight::benchmarks {

namespace {

constexpr const char* relativeError = "relative error";
constexpr const char* notFinite = "values not finite";

void writeReport(const std::filesystem::path& folder, const std::vector<stability::Trial>& trials,
                 const DeviceInfo& device) {
  const std::filesystem::path file = folder / "stability.md";
  std::ofstream out(file, std::ios::binary);
  out << stability::makeReport(trials, device.name + ", " + device.platform);
  out.close();
  if (!out)
    throw Error(ExitCode::RuntimeFailure, file.string(), "cannot be written",
                "see that the folder exists and has room");
}

}  // namespace

std::vector<BenchmarkResult> runStabilitySuite(const Device& device, const BenchmarkOptions& options,
                                               Progress& progress) {
  const StopOnly stop(progress);
  StepCounter steps(progress, "bench stability", stability::subjects().size());
  stability::Trials trials(device, options, stop);
  for (const stability::Subject& subject : stability::subjects()) {
    trials.begin(subject.name);
    subject.run(trials);
    steps.advance();
  }
  std::vector<BenchmarkResult> results;
  for (const stability::Trial& trial : trials.all()) {
    std::string name = trial.subject + "/" + trial.stress;
    if (!trial.growth.parameter.empty())
      name += fmt::format("/{} {:g}", trial.growth.parameter, trial.growth.at);
    const double relative = trial.differences.relative();
    BenchmarkResult error{"stability", name, relativeError, relative, "", "bound", {}};
    // No error at all is as good as one of a thousandth of the least one that there can be.
    error.ratio = relative > 0.0 ? trial.bound / relative : 1e6;
    results.push_back(std::move(error));
    results.push_back({"stability", name, "absolute error", trial.differences.absolute(), "", {}, {}});
    results.push_back({"stability", name, notFinite, double(trial.differences.notFinite()), "", {}, {}});
  }
  if (!options.folder.empty()) writeReport(options.folder, trials.all(), device.info());
  return results;
}

std::vector<std::string> brokenBounds(const std::vector<BenchmarkResult>& results) {
  std::vector<std::string> broken;
  for (const BenchmarkResult& result : results) {
    if (result.suite != "stability") continue;
    if (result.metric == relativeError && result.ratio && *result.ratio < 1.0)
      broken.push_back(fmt::format("{}: relative error {:.3g}, bound {:.3g}", result.case_, result.value,
                                   result.value * *result.ratio));
    if (result.metric == notFinite && result.value > 0.0)
      broken.push_back(fmt::format("{}: {:g} values that are not finite", result.case_, result.value));
  }
  return broken;
}

}  // namespace prelight::benchmarks
