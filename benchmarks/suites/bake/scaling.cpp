#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "bake/make_plan.h"
#include "benchmarks/peers/embree/ray_peer.h"
#include "benchmarks/run/measure.h"
#include "benchmarks/run/work_folder.h"
#include "benchmarks/scenes/detailed_scene.h"
#include "benchmarks/suites/bake/bake_process.h"
#include "benchmarks/suites/bake/bake_suite.h"
#include "benchmarks/suites/bake/bumpy_balls.h"
#include "benchmarks/suites/bake/rays_alone.h"
#include "benchmarks/suites/bake/scaling_cases.h"
#include "benchmarks/suites/bake/scaling_peer.h"
#include "prelight/error.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/loader.h"

namespace prelight::benchmarks {

namespace {

constexpr int tracingRounds = 2;
constexpr std::uint64_t smallScene = 2000;  // triangles, of bakes that are not measured
constexpr std::uint64_t fewRays = 16;       // a vertex, of those

/// Memory that a bake may hold beside its output, bytes.
double memoryBound(double triangles) { return 400.0 * triangles + 300e6; }

struct MeasuredCase {
  ScalingCase some;
  TracingCost tracing;  ///< cost of tracing some of its rays
  std::vector<ProcessCost> runs = {};
};

/// Runs of one number, of which the median counts.
template <typename Value>
double medianOf(const std::vector<ProcessCost>& runs, const Value& value) {
  std::vector<double> values;
  for (const ProcessCost& run : runs) values.push_back(value(run));
  return median(values);
}

constexpr const char* smallRoom = "cornell";

std::string ballsOf(std::uint64_t triangles) { return "balls " + sizeName(triangles); }

class ScalingRun {
 public:
  ScalingRun(const Device& device, const BakeOptions& options, SuiteRun& run)
      : device_(device), options_(options), progress_(run), results_(run.results()) {}

  void run() {
    StepCounter steps(progress_, "bench bake-scaling", 1 + options_.scalingTriangles.size());
    measure(
        smallRoom, [] { return makeBuiltinScene("cornell"); }, true);
    steps.advance();
    stages_.clear();  // it is not one of those that grow
    const std::vector<std::uint64_t>& compared = options_.peerTriangles;
    for (const std::uint64_t triangles : options_.scalingTriangles) {
      measure(
          ballsOf(triangles), [&] { return makeBumpyBalls(triangles); },
          std::find(compared.begin(), compared.end(), triangles) != compared.end());
      steps.advance();
    }
    addPowers();
  }

 private:
  struct StagePoint {
    std::string series;  ///< "--ao/64 rays"
    std::string stage;
    Point point;
  };

  /// `compares`: errors, too, and with another baker.
  void measure(const std::string& scene, const std::function<GltfDocument()>& make, bool compares) {
    if (scalingCases(scene, 0, options_).empty()) return;
    writeGlb(folder_ / "scene.glb", make());
    std::vector<MeasuredCase> cases;
    double triangles = 0.0;
    {  // Nothing of it is held while the bakes run.
      Warnings warnings;
      const CompiledScene compiled =
          compileScene(loadScene(readGltf(folder_ / "scene.glb", warnings), warnings), warnings);
      triangles = compiled.triangleCount();
      cases = traced(scene, compiled);
    }
    std::vector<FinishedBake> finished;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const std::filesystem::path file = folder_ / fmt::format("baked-{}.glb", compares ? i : 0);
      bake(cases[i], file);
      if (cases[i].runs.empty()) continue;
      report(cases[i], triangles);
      finished.push_back(finishedBake(cases[i], file));
    }
    if (!compares) return;
    const std::vector<BenchmarkResult> compared =
        compareWithVertexBaker(scene, finished, peerThreads(device_.info()), options_, progress_);
    results_.insert(results_.end(), compared.begin(), compared.end());
  }

  /// Without what writing the file takes.
  static FinishedBake finishedBake(const MeasuredCase& measured, const std::filesystem::path& file) {
    const auto less = [](double all, const nlohmann::ordered_json& part) {
      return all - part.at("write").get<double>();
    };
    return {measured.some.name(), measured.some.technique, file,
            medianOf(measured.runs,
                     [&](const ProcessCost& run) {
                       return less(bakeSeconds(run.report), run.report.at("stages"));
                     }),
            medianOf(measured.runs, [&](const ProcessCost& run) {
              return less(bakeProcessorSeconds(run.report), run.report.at("processorSeconds"));
            })};
  }

  std::vector<MeasuredCase> traced(const std::string& scene, const CompiledScene& compiled) {
    Tracer tracer(compiled, device_);
    std::vector<MeasuredCase> cases;
    for (const ScalingCase& some : scalingCases(scene, compiled.vertexCount(), options_))
      cases.push_back({some, traceRaysAlone(compiled, some.request, tracer, options_.scalingTracedRays,
                                            tracingRounds, StopOnly(progress_))});
    return cases;
  }

  BakeProcess processOf(const ScalingCase& some, const char* scene, const std::filesystem::path& file) const {
    BakeProcess process{options_.program, folder_ / scene, file, some.options()};
    process.options.insert(process.options.end(), {"--device", std::to_string(device_.info().index)});
    return process;
  }

  /// Has the kernels of a technique compiled and kept.
  void warm(ScalingCase some, const Progress& stop) {
    if (std::find(warm_.begin(), warm_.end(), some.technique) != warm_.end()) return;
    if (warm_.empty()) writeGlb(folder_ / "small.glb", makeBumpyBalls(smallScene));
    warm_.push_back(some.technique);
    some.rays = fewRays;
    runBakeProcess(processOf(some, "small.glb", folder_ / "small-baked.glb"), stop);
  }

  void bake(MeasuredCase& measured, const std::filesystem::path& file) {
    const StopOnly stop(progress_);
    warm(measured.some, stop);
    const BakeProcess process = processOf(measured.some, "scene.glb", file);
    ProcessCost cost = runBakeProcess(process, stop);
    if (!cost.finished) return leaveOut(measured);
    const int runs =
        cost.report.at("rays").get<std::uint64_t>() < options_.scalingLongBake ? options_.runs : 1;
    measured.runs.push_back(std::move(cost));
    while (static_cast<int>(measured.runs.size()) < runs)
      measured.runs.push_back(runBakeProcess(process, stop));
  }

  void leaveOut(const MeasuredCase& measured) {
    add(measured.some.name(), "ended for want of memory", 1.0, "bakes");
  }

  void report(const MeasuredCase& measured, double triangles) {
    const std::vector<ProcessCost>& runs = measured.runs;
    const ProcessCost& last = runs.back();
    const auto rays = last.report.at("rays").get<double>();
    const double share = rays / static_cast<double>(measured.tracing.rays);
    const double alone = share * measured.tracing.seconds;
    const double whole = medianOf(runs, [](const ProcessCost& run) { return run.seconds; });
    const double bake = medianOf(runs, [](const ProcessCost& run) { return bakeSeconds(run.report); });
    const double bakeProcessor =
        medianOf(runs, [](const ProcessCost& run) { return bakeProcessorSeconds(run.report); });
    const std::string name = measured.some.name(), peer = "its rays alone";
    add(name, "whole", whole, "s", peer, alone / whole);
    for (const std::string& stage : stagesOf(last))
      addStage(measured.some, stage, triangles, medianOf(runs, [&](const ProcessCost& run) {
                 return run.report.at("stages").value(stage, 0.0);
               }));
    add(name, "prepare to write", bake, "s", peer, alone / bake);
    add(name, "processor", bakeProcessor, "s", peer,
        share * measured.tracing.processorSeconds / bakeProcessor);
    add(name, "cores busy", bakeProcessor / bake, "cores");
    add(name, "rays", rays, "rays");
    add(name, "rays alone", alone, "s");
    reportMemory(name, last, triangles);
  }

  void reportMemory(const std::string& name, const ProcessCost& run, double triangles) {
    const auto& memory = run.report.at("memory");
    double estimate = memory.at("hostEstimate").get<double>();
    if (device_.info().kind == DeviceKind::Cpu) estimate += memory.at("deviceEstimate").get<double>();
    const auto peak = memory.at("peakResident").get<double>();
    const auto output = static_cast<double>(run.outputBytes);
    add(name, "peak memory", peak, "bytes", "the plan's estimate", estimate / peak);
    add(name, "memory beyond the output", peak - output, "bytes", "400 bytes a triangle and 300 MB",
        memoryBound(triangles) / (peak - output));
    add(name, "output", output, "bytes");
  }

  static std::vector<std::string> stagesOf(const ProcessCost& run) {
    std::vector<std::string> stages;
    for (const auto& stage : run.report.at("stages").items()) stages.push_back(stage.key());
    return stages;
  }

  void addStage(const ScalingCase& some, const std::string& stage, double triangles, double seconds) {
    add(some.name(), stage, seconds, "s");
    if (seconds > 0.0)
      stages_.push_back({fmt::format("{}/{} rays", some.technique, some.rays), stage, {triangles, seconds}});
  }

  /// Adds the power of triangles of every stage that was measured at two sizes or more.
  void addPowers() {
    while (!stages_.empty()) {
      const StagePoint first = stages_.front();
      std::vector<Point> points;
      std::erase_if(stages_, [&](const StagePoint& other) {
        const bool same = other.series == first.series && other.stage == first.stage;
        if (same) points.push_back(other.point);
        return same;
      });
      if (points.size() > 1)
        add("growth/" + first.series, first.stage, powerOf(points), "power of triangles");
    }
  }

  void add(const std::string& name, const std::string& metric, double value, const std::string& unit,
           const std::string& peer = {}, std::optional<double> ratio = {}) {
    results_.push_back({name, metric, value, unit, peer, ratio});
  }

  const Device& device_;
  const BakeOptions& options_;
  Progress& progress_;
  WorkFolder folder_;
  std::vector<std::string> warm_;  ///< techniques that were baked before
  std::vector<StagePoint> stages_;
  std::vector<BenchmarkResult>& results_;
};

}  // namespace

bool hasBakeScalingCase(const BakeOptions& options) {
  std::vector<std::string> scenes = {smallRoom};
  for (const std::uint64_t triangles : options.scalingTriangles) scenes.push_back(ballsOf(triangles));
  return std::any_of(scenes.begin(), scenes.end(),
                     [&](const std::string& scene) { return !scalingCases(scene, 0, options).empty(); });
}

void runBakeScaling(const Device& device, const BakeOptions& options, SuiteRun& run) {
  if (!hasBakeScalingCase(options))
    throw UsageError("--case " + options.onlyCase, "no case of `bake-scaling` has such a name",
                     "they are like \"balls 100k/--ao/64 rays\"");
  if (options.program.empty())
    throw UsageError("BakeOptions::program", "bake-scaling runs the program, and none is named",
                     "name the built `prelight`");
  ScalingRun(device, options, run).run();
}

}  // namespace prelight::benchmarks
