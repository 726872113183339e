#include "benchmarks/run/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "bake/make_plan.h"
#include "charts/make_light_map_layout.h"
#include "prelight/error.h"
#include "prelight/load.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "techniques/light_map/light_map_plan.h"

namespace prelight::benchmarks {

BenchmarkScene loadBuiltinScene(const std::string& name) {
  Warnings warnings;
  BenchmarkScene result;
  result.name = name;
  result.scene = loadScene(makeBuiltinScene(name), warnings);
  result.compiled = compileScene(result.scene, warnings);
  return result;
}

std::string sceneName(const std::string& nameOrFile) {
  return std::filesystem::path(nameOrFile).stem().string();
}

BenchmarkScene loadNamedScene(const std::string& nameOrFile) {
  if (!std::filesystem::path(nameOrFile).has_extension()) return loadBuiltinScene(nameOrFile);
  LoadedScene loaded = load(nameOrFile);
  return {sceneName(nameOrFile), std::move(loaded.scene), std::move(loaded.compiled)};
}

std::vector<BenchmarkScene> loadBuiltinScenes() {
  std::vector<BenchmarkScene> scenes;
  for (const BuiltinScene& scene : builtinScenes()) scenes.push_back(loadBuiltinScene(scene.name));
  return scenes;
}

double median(std::vector<double> values) {
  assert(!values.empty());
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

double secondsOf(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

device::Ray rayFrom(const glm::dvec3& point, const glm::dvec3& direction, std::uint32_t triangle,
                    double farthest) {
  const glm::vec3 start(point), along(direction);
  return {{start.x, start.y, start.z}, triangle, {along.x, along.y, along.z}, static_cast<float>(farthest)};
}

BakeRequest aoRequest(std::uint64_t rays, std::uint64_t seed) {
  BakeRequest request;
  request.ao = true;
  request.effort.rays = rays;
  request.seed = seed;
  return request;
}

double TimedBake::seconds() const {
  double total = 0.0;
  for (const auto& [stage, seconds] : report.stageSeconds) total += seconds;
  return total;
}

TimedBake timedBake(const BenchmarkScene& scene, const BakeRequest& request, const Device& device,
                    const Progress& progress, const Charts* charts) {
  const Plan plan = makePlan(scene.scene, scene.compiled, request);
  StopOnly quiet(progress);
  TimedBake result;
  result.bake = bakeScene(scene.compiled, request, plan, device, quiet, result.report, charts, &scene.scene);
  return result;
}

StepCounter::StepCounter(Progress& progress, std::string stage, std::size_t steps)
    : progress_(progress), stage_(std::move(stage)), steps_(steps) {
  progress_.report(stage_, 0.0);
}

void StepCounter::advance() {
  ++done_;
  progress_.report(stage_, static_cast<double>(done_) / static_cast<double>(steps_));
  progress_.check();
}

LineFit fitLine(std::span<const Point> points) {
  const auto n = static_cast<double>(points.size());
  double meanX = 0.0, meanY = 0.0;
  for (const Point& p : points) meanX += p.x / n, meanY += p.y / n;
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const Point& p : points) {
    xx += (p.x - meanX) * (p.x - meanX);
    xy += (p.x - meanX) * (p.y - meanY);
    yy += (p.y - meanY) * (p.y - meanY);
  }
  assert(xx > 0.0);
  const double slope = xy / xx;
  return {meanY - slope * meanX, slope, yy > 0.0 ? slope * xy / yy : 1.0};
}

WorkFolder::WorkFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "prelight-bench-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw Error(ExitCode::RuntimeFailure, name,
                fmt::format("cannot make this folder: {}", std::generic_category().message(errno)),
                "set TMPDIR to a folder that can be written to");
  path_ = name;
}

WorkFolder::~WorkFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace prelight::benchmarks
