#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bake/baker.h"
#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "prelight/plan.h"
#include "prelight/progress.h"
#include "prelight/scene.h"

/// Helpers that suites share: scenes, clocks and medians.
namespace prelight::benchmarks {

struct BenchmarkScene {
  std::string name;
  Scene scene;
  CompiledScene compiled;
};

BenchmarkScene loadBuiltinScene(const std::string& name);

/// A built-in scene, or a file, whose name without its extension is the scene's.
BenchmarkScene loadNamedScene(const std::string& nameOrFile);
std::string sceneName(const std::string& nameOrFile);
std::vector<BenchmarkScene> loadBuiltinScenes();

/// Middle value, or the mean of the two in the middle. There must be one.
double median(std::vector<double> values);

double secondsOf(const std::function<void()>& work);

/// A request for AO at a number of rays a vertex.
BakeRequest aoRequest(std::uint64_t rays, std::uint64_t seed);

/// A bake of a benchmark and what the library says of it.
struct TimedBake {
  Bake bake;
  BakeReport report;

  double seconds() const;  ///< seconds of all stages
};

/// Plans and bakes. `progress` is asked whether to stop but told nothing: a benchmark's bar counts bakes.
/// `charts`: of transfer at texels; nullptr: there is none.
TimedBake timedBake(const BenchmarkScene& scene, const BakeRequest& request, const Device& device,
                    const Progress& progress, const Charts* charts = nullptr);

/// Passes on the wish to stop and nothing else: a benchmark's bar counts its own steps.
class StopOnly final : public Progress {
 public:
  explicit StopOnly(const Progress& outer) : outer_(outer) {}
  bool stopRequested() const override { return outer_.stopRequested(); }

 private:
  const Progress& outer_;
};

/// Tells `progress` how many of a suite's equal steps are done, and stops when the user wants to.
class StepCounter {
 public:
  StepCounter(Progress& progress, std::string stage, std::size_t steps);

  /// Throws Interrupted.
  void advance();

 private:
  Progress& progress_;
  std::string stage_;
  std::size_t steps_;
  std::size_t done_ = 0;
};

}  // namespace prelight::benchmarks
