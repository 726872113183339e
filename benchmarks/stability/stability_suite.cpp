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

/// Those whose names contain what --case says.
std::vector<const stability::Subject*> chosenSubjects(const BenchmarkOptions& options) {
  std::vector<const stability::Subject*> chosen;
  for (const stability::Subject& subject : stability::subjects())
    if (subject.name.find(options.onlyCase) != std::string::npos) chosen.push_back(&subject);
  return chosen;
}

void addResults(const stability::Trial& trial, std::vector<BenchmarkResult>& results) {
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

}  // namespace

void runStabilitySuite(const Device& device, const BenchmarkOptions& options, SuiteRun& run) {
  const std::vector<const stability::Subject*> chosen = chosenSubjects(options);
  if (chosen.empty())
    throw UsageError("--case " + options.onlyCase, "no subject of `stability` has such a name",
                     "docs/notes/stability.md lists them");
  const StopOnly stop(run);
  StepCounter steps(run, "bench stability", chosen.size());
  stability::Trials trials(device, options, stop);
  std::size_t reported = 0;
  for (const stability::Subject* subject : chosen) {
    trials.begin(subject->name);
    subject->run(trials);
    for (; reported < trials.all().size(); ++reported) addResults(trials.all()[reported], run.results());
    if (!options.folder.empty()) writeReport(options.folder, trials.all(), device.info());
    steps.advance();
  }
}

bool hasStabilityCase(const BenchmarkOptions& options) { return !chosenSubjects(options).empty(); }

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
