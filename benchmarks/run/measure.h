#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bake/baker.h"
#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "prelight/plan.h"
#include "prelight/progress.h"
#include "prelight/scene.h"
#include "shared/ray_types.h"

/// Helpers that suites share: scenes, bakes, rays, medians, fitted lines and a temporary folder.
namespace prelight::benchmarks {

struct BenchmarkScene {
  std::string name;
  Scene scene;
  CompiledScene compiled;
};

BenchmarkScene loadBuiltinScene(const std::string& name);

/// Loads a built-in scene, or a file, whose name without its extension becomes the scene's name.
BenchmarkScene loadNamedScene(const std::string& nameOrFile);
std::string sceneName(const std::string& nameOrFile);
std::vector<BenchmarkScene> loadBuiltinScenes();

/// Returns the middle value, or the mean of the two in the middle. `values` is not empty.
double median(std::vector<double> values);

double secondsOf(const std::function<void()>& work);

/// Returns a ray of length `farthest` from a point along a unit direction. It does not hit `triangle`, on
/// which the point lies (PRELIGHT_NO_TRIANGLE: it hits all).
device::Ray rayFrom(const glm::dvec3& point, const glm::dvec3& direction, std::uint32_t triangle,
                    double farthest);

/// Returns a request for AO with `rays` rays per vertex.
BakeRequest aoRequest(std::uint64_t rays, std::uint64_t seed);

/// A bake and the library's report about it.
struct TimedBake {
  Bake bake;
  BakeReport report;

  double seconds() const;  ///< seconds of all stages
};

/// Plans and bakes. `progress` can stop the bake but is told nothing, since the bar of a benchmark counts
/// bakes. `charts`: those of transfer at texels, or nullptr.
TimedBake timedBake(const BenchmarkScene& scene, const BakeRequest& request, const Device& device,
                    const Progress& progress, const Charts* charts = nullptr);

/// Forwards a request to stop, but no progress: the bar of a benchmark counts its own steps.
class StopOnly final : public Progress {
 public:
  explicit StopOnly(const Progress& outer) : outer_(outer) {}
  bool stopRequested() const override { return outer_.stopRequested(); }

 private:
  const Progress& outer_;
};

/// Reports how many of a suite's equal steps are done, and stops when the user wants to.
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

struct Point {
  double x = 0.0;
  double y = 0.0;
};

/// The line y = intercept + slope x.
struct LineFit {
  double intercept = 0.0;
  double slope = 0.0;
  double r2 = 0.0;  ///< share of the variance of y that the line explains; 1 where there is none to explain
};

/// Returns the line of least squares. At least two x differ.
LineFit fitLine(std::span<const Point> points);

/// A new folder in the system's temporary folder. Its destructor deletes it and its contents.
class WorkFolder {
 public:
  WorkFolder();
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace prelight::benchmarks
