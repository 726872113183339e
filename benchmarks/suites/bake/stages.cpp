#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "benchmarks/run/measure.h"
#include "benchmarks/suites/bake/bake_suite.h"

namespace prelight::benchmarks {

namespace {

/// A kind of bake, and the seconds of its stages over the runs.
struct MeasuredBake {
  std::string name;
  BakeRequest request;
  std::vector<std::pair<std::string, std::vector<double>>> stages = {};  ///< in the order they ran

  void add(const std::string& stage, double seconds) {
    const auto found =
        std::find_if(stages.begin(), stages.end(), [&](const auto& entry) { return entry.first == stage; });
    if (found != stages.end())
      found->second.push_back(seconds);
    else
      stages.push_back({stage, {seconds}});
  }

  void run(const BenchmarkScene& scene, const Device& device, const Progress& progress) {
    const TimedBake result = timedBake(scene, request, device, progress);
    for (const auto& [stage, seconds] : result.report.stageSeconds) add(stage, seconds);
    add("total", result.seconds());
  }

  /// Empty when the bake has no such stage.
  std::optional<double> seconds(const std::string& stage) const {
    for (const auto& [other, values] : stages)
      if (other == stage) return median(values);
    return {};
  }
};

std::vector<MeasuredBake> bakes(std::uint64_t rays) {
  const BakeRequest ao = aoRequest(rays, 0);
  BakeRequest sh = ao;
  sh.sh.order = 3;
  BakeRequest bounces = sh;
  bounces.bounces = 1;
  return {{"--ao", ao}, {"--ao --sh 3", sh}, {"--ao --sh 3 --bounces 1", bounces}};
}

void reportBake(const std::string& scene, const MeasuredBake& bake, const MeasuredBake& plainest,
                std::vector<BenchmarkResult>& results) {
  for (const auto& [stage, values] : bake.stages) {
    const double seconds = median(values);
    BenchmarkResult result{fmt::format("{}/{}", scene, bake.name), stage, seconds, "s", {}, {}};
    const std::optional<double> peer = plainest.seconds(stage);
    if (&bake != &plainest && peer && seconds > 0.0) {
      result.peer = plainest.name;
      result.ratio = *peer / seconds;
    }
    results.push_back(std::move(result));
  }
}

}  // namespace

void runStages(const Device& device, const BakeOptions& options, SuiteRun& run) {
  const std::vector<BenchmarkScene> scenes = loadBuiltinScenes();
  StepCounter steps(run, "bench bake", scenes.size() * static_cast<std::size_t>(options.runs + 1));
  std::vector<BenchmarkResult>& results = run.results();
  for (const BenchmarkScene& scene : scenes) {
    std::vector<MeasuredBake> measured = bakes(options.bakeRays);
    for (MeasuredBake warmUp : measured) warmUp.run(scene, device, run);
    steps.advance();
    for (int i = 0; i < options.runs; ++i) {
      for (MeasuredBake& bake : measured) bake.run(scene, device, run);
      steps.advance();
    }
    for (const MeasuredBake& bake : measured) reportBake(scene.name, bake, measured.front(), results);
  }
}

}  // namespace prelight::benchmarks
