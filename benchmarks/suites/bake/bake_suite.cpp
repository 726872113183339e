#include "benchmarks/suites/bake/bake_suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "benchmarks/run/measure.h"

namespace prelight::benchmarks {

namespace {

/// A kind of bake and the seconds of its stages in each run.
struct MeasuredBake {
  std::string name;
  BakeRequest request;
  std::vector<std::pair<std::string, std::vector<double>>> stages = {};  ///< in the order in which they ran

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

  /// Returns the median seconds of a stage; nothing if the bake has no such stage.
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

namespace {

/// Seed of the reference. No run has it, so that errors are independent.
constexpr std::uint64_t referenceSeed = 0;

double vertexMeanSquare(const std::vector<float>& ao, const std::vector<float>& reference) {
  double sum = 0.0;
  for (std::size_t v = 0; v < ao.size(); ++v) {
    const double difference = double(ao[v]) - double(reference[v]);
    sum += difference * difference;
  }
  return sum / static_cast<double>(ao.size());
}

/// Returns the mean square, over the surface, of the difference interpolated between vertices. The mean of
/// the square of a linear function over a triangle is (a^2 + b^2 + c^2 + ab + bc + ca) / 6.
double surfaceMeanSquare(const CompiledScene& scene, const std::vector<float>& ao,
                         const std::vector<float>& reference) {
  const auto difference = [&](std::uint32_t v) { return double(ao[v]) - double(reference[v]); };
  double sum = 0.0, total = 0.0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const double area = 0.5 * glm::length(geometricNormal(scene, t));
    const double a = difference(scene.triangles[t].x), b = difference(scene.triangles[t].y),
                 c = difference(scene.triangles[t].z);
    sum += area * (a * a + b * b + c * c + a * b + b * c + c * a) / 6.0;
    total += area;
  }
  return sum / total;
}

/// Errors and seconds of the runs with one number of rays. Every run has its own seed, so that means are over
/// seeds and over the scene.
struct ErrorPoint {
  std::uint64_t rays = 0;  ///< per vertex
  std::vector<double> seconds = {};
  double vertexSquares = 0.0;    ///< sum over runs of mean squares at vertices
  double surfaceSquares = 0.0;   ///< sum over runs of mean squares over the surface
  double reportedSquares = 0.0;  ///< sum over runs of the squared standard error that the bake reports

  void run(const BenchmarkScene& scene, std::uint64_t seed, const Bake& reference, const Device& device,
           const Progress& progress) {
    const TimedBake result = timedBake(scene, aoRequest(rays, seed), device, progress);
    seconds.push_back(result.seconds());
    vertexSquares += vertexMeanSquare(result.bake.ao, reference.ao);
    surfaceSquares += surfaceMeanSquare(scene.compiled, result.bake.ao, reference.ao);
    reportedSquares += result.report.aoErrorRms * result.report.aoErrorRms;
  }

  double rms(double squares) const { return std::sqrt(squares / static_cast<double>(seconds.size())); }
};

void reportErrors(const std::string& scene, const ErrorPoint& point, std::vector<BenchmarkResult>& results) {
  const std::string name = fmt::format("{}/{} rays", scene, point.rays);
  results.push_back({name, "time", median(point.seconds), "s", {}, {}});
  results.push_back({name, "vertex error", point.rms(point.vertexSquares), "AO", {}, {}});
  results.push_back({name, "surface error", point.rms(point.surfaceSquares), "AO", {}, {}});
  BenchmarkResult reported{name, "reported error", point.rms(point.reportedSquares), "AO", {}, {}};
  if (point.surfaceSquares > 0.0) {
    reported.peer = "surface error";
    reported.ratio = std::sqrt(point.reportedSquares / point.surfaceSquares);
  }
  results.push_back(std::move(reported));
}

/// Measures numbers of rays in turns, run by run, so that disturbances affect all of them.
void measureErrors(const BenchmarkScene& scene, const Device& device, const BakeOptions& options,
                   StepCounter& steps, const Progress& progress, std::vector<BenchmarkResult>& results) {
  const TimedBake reference =
      timedBake(scene, aoRequest(options.errorReferenceRays, referenceSeed), device, progress);
  const std::string name = fmt::format("{}/reference of {} rays", scene.name, options.errorReferenceRays);
  results.push_back({name, "time", reference.seconds(), "s", {}, {}});
  results.push_back({name, "reported error", reference.report.aoErrorRms, "AO", {}, {}});
  steps.advance();  // the reference bake has also warmed up

  std::vector<ErrorPoint> points;
  for (const std::uint64_t rays : options.errorRays) points.push_back({.rays = rays});
  for (int run = 0; run < options.runs; ++run) {
    const std::uint64_t seed = referenceSeed + 1 + static_cast<std::uint64_t>(run);
    for (ErrorPoint& point : points) point.run(scene, seed, reference.bake, device, progress);
    steps.advance();
  }
  for (const ErrorPoint& point : points) reportErrors(scene.name, point, results);
}

}  // namespace

void runError(const Device& device, const BakeOptions& options, SuiteRun& run) {
  constexpr std::array<const char*, 2> scenes = {"shapes", "cornell"};
  StepCounter steps(run, "bench error", scenes.size() * static_cast<std::size_t>(options.runs + 1));
  std::vector<BenchmarkResult>& results = run.results();
  for (const char* name : scenes) measureErrors(loadBuiltinScene(name), device, options, steps, run, results);
}

const OptionTable<BakeOptions>& BakeOptions::table() {
  static const OptionTable<BakeOptions> table =
      OptionTable<BakeOptions>()
          .add("bakeRays", &BakeOptions::bakeRays, 256, 16, "rays per vertex of `stages`")
          .add("scalingTriangles", &BakeOptions::scalingTriangles,
               {10000, 100000, 407000, 1390000, 4690000, 10000000}, {10000, 100000},
               "triangles of the scenes of `bake-scaling`", {.least = 2000, .ascending = true})
          .add("scalingRays", &BakeOptions::scalingRays, {16, 64, 256, 1024, 4096}, {16},
               "rays per vertex of its bakes", {.ascending = true})
          .add("scalingMostRays", &BakeOptions::scalingMostRays, 180000000,
               "largest number of rays of a bake with more than 64 per vertex")
          .add("scalingTracedRays", &BakeOptions::scalingTracedRays, 1u << 22, 1u << 18,
               "rays that are enough to time tracing alone")
          .add("scalingLongBake", &BakeOptions::scalingLongBake, 1u << 23, 0,
               "number of rays from which on a bake runs only once", {.least = 0})
          .add("peerTriangles", &BakeOptions::peerTriangles, {407000, 1390000}, {10000},
               "triangles of the scenes on which errors are compared with those of a baker that uses Embree",
               {.least = 2000})
          .add("peerSides", &BakeOptions::peerSides, {2, 4, 8, 16, 32}, {2, 4},
               "sides of that baker's squares of rays", {.most = 256, .ascending = true})
          .add("peerRays", &BakeOptions::peerRays, 180000000, "largest number of rays of that baker")
          .add("errorPlaces", &BakeOptions::errorPlaces, 4096, 64,
               "points of the surface at which those errors are measured")
          .add("truthSide", &BakeOptions::truthSide, 32, 4,
               "side of the square of paths at each point, which are traced twice", {.most = 256})
          .add("errorRays", &BakeOptions::errorRays, {64, 128, 256, 512, 1024}, {16, 32},
               "rays per vertex of `error`", {.ascending = true})
          .add("errorReferenceRays", &BakeOptions::errorReferenceRays, 4096, 64,
               "rays per vertex of the reference bake of `error`");
  return table;
}

std::unique_ptr<Suite> bakeSuite() {
  SuiteOf<BakeOptions>::Runners parts = {
      {"stages", "seconds of each stage of a bake of AO, of AO and SH, and of both with a bounce", runStages},
      {"bake-scaling", "seconds, memory and share of tracing of whole bakes, from 10 k triangles to 10 M",
       runBakeScaling, hasBakeScalingCase},
      {"error", "error of AO against time, and the error that a bake reports against the measured one",
       runError},
  };
  return std::make_unique<SuiteOf<BakeOptions>>("bake", "time, memory and error of bakes", std::move(parts));
}

}  // namespace prelight::benchmarks
