#include "benchmarks/suites/stability/stability_suite.h"

#include <fmt/format.h>

#include <fstream>

#include "benchmarks/run/measure.h"
#include "benchmarks/suites/stability/trials.h"
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

/// Returns the subjects whose names contain the text of --case.
std::vector<const stability::Subject*> chosenSubjects(const StabilityOptions& options) {
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
  BenchmarkResult error{name, relativeError, relative, "", "bound", {}};
  // An error of 0 counts as a millionth of the bound.
  error.ratio = relative > 0.0 ? trial.bound / relative : 1e6;
  results.push_back(std::move(error));
  results.push_back({name, "absolute error", trial.differences.absolute(), "", {}, {}});
  results.push_back({name, notFinite, double(trial.differences.notFinite()), "", {}, {}});
}

}  // namespace

void runStability(const Device& device, const StabilityOptions& options, SuiteRun& run) {
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

bool hasStabilityCase(const StabilityOptions& options) { return !chosenSubjects(options).empty(); }

std::vector<std::string> brokenBounds(std::span<const BenchmarkResult> results) {
  std::vector<std::string> broken;
  for (const BenchmarkResult& result : results) {
    if (result.metric == relativeError && result.ratio && *result.ratio < 1.0)
      broken.push_back(fmt::format("{}: relative error {:.3g}, bound {:.3g}", result.case_, result.value,
                                   result.value * *result.ratio));
    if (result.metric == notFinite && result.value > 0.0)
      broken.push_back(fmt::format("{}: {:g} values that are not finite", result.case_, result.value));
  }
  return broken;
}

const OptionTable<StabilityOptions>& StabilityOptions::table() {
  static const OptionTable<StabilityOptions> table =
      OptionTable<StabilityOptions>()
          .add("orders", &StabilityOptions::orders, {1, 2, 3, 4, 6, 8, 12, 16, 24, 32}, {1, 3, 8},
               "orders of bases", {.most = 32, .ascending = true})
          .add("faceSizes", &StabilityOptions::faceSizes, {4, 8, 16, 32, 64, 128}, {4, 16},
               "texels per side of a face of cube maps", {.least = 4, .most = 512, .powerOfTwo = true})
          .add("skyRows", &StabilityOptions::skyRows, {16, 64, 256, 1024}, {16, 64}, "rows of skies",
               {.least = 2, .most = 16384})
          .add("elementCells", &StabilityOptions::elementCells, {4, 12, 32}, {4, 8},
               "cells per side of the squares whose elements exchange light; a square has two elements per "
               "cell")
          .add("rays", &StabilityOptions::rays, 2000, 200,
               "rays of each kind, each of which is tested against every triangle")
          .add("lights", &StabilityOptions::lights, 1000000, 10000, "largest number of lights of a scene")
          .add("photons", &StabilityOptions::photons, 1000000000,
               "largest number that a photon of this suite has")
          .add("flownPhotons", &StabilityOptions::flownPhotons, 1u << 16, 2000,
               "photons that fly through each room", {.most = 0xf0000000u})
          .add("densityPhotons", &StabilityOptions::densityPhotons, {2000, 20000, 200000}, {2000},
               "photons on a square", {.ascending = true})
          .add("bakeRays", &StabilityOptions::bakeRays, 64, 16, "rays per vertex")
          .add("scenes", &StabilityOptions::scenes, {"shapes", "caustics", "cornell"}, {"caustics"},
               "scenes that are baked");
  return table;
}

void StabilityOptions::takeGiven() { flownPhotons = given.photons.value_or(flownPhotons); }

std::unique_ptr<Suite> stabilitySuite() {
  SuiteOf<StabilityOptions>::Runners parts = {
      {"stability", "errors of every kernel and basis on inputs that are hard on them, against bounds",
       runStability, hasStabilityCase},
  };
  return std::make_unique<SuiteOf<StabilityOptions>>(
      "stability", "errors of every kernel and basis on inputs that are hard on them, against bounds",
      std::move(parts), brokenBounds);
}

}  // namespace prelight::benchmarks
