#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "benchmarks/run/measure.h"
#include "benchmarks/suites/bake/bake_suite.h"

namespace prelight::benchmarks {

namespace {

/// The reference's seed; no run has it, so that their errors are independent.
constexpr std::uint64_t referenceSeed = 0;

double vertexMeanSquare(const std::vector<float>& ao, const std::vector<float>& reference) {
  double sum = 0.0;
  for (std::size_t v = 0; v < ao.size(); ++v) {
    const double difference = double(ao[v]) - double(reference[v]);
    sum += difference * difference;
  }
  return sum / static_cast<double>(ao.size());
}

/// Mean square over the surface of the difference interpolated between vertices. The mean of a linear
/// function's square over a triangle is (a^2 + b^2 + c^2 + ab + bc + ca) / 6.
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

/// Errors and seconds of the runs with one number of rays. Every run has a seed of its own: mean squares are
/// over seeds as well as over the scene.
struct ErrorPoint {
  std::uint64_t rays = 0;  ///< a vertex
  std::vector<double> seconds = {};
  double vertexSquares = 0.0;    ///< sum over runs: measured at vertices
  double surfaceSquares = 0.0;   ///< measured over the surface
  double reportedSquares = 0.0;  ///< of the standard error that the bake states, over the surface

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

/// Numbers of rays take turns, run by run, so that all meet the same disturbances.
void measureErrors(const BenchmarkScene& scene, const Device& device, const BakeOptions& options,
                   StepCounter& steps, const Progress& progress, std::vector<BenchmarkResult>& results) {
  const TimedBake reference =
      timedBake(scene, aoRequest(options.errorReferenceRays, referenceSeed), device, progress);
  const std::string name = fmt::format("{}/reference of {} rays", scene.name, options.errorReferenceRays);
  results.push_back({name, "time", reference.seconds(), "s", {}, {}});
  results.push_back({name, "reported error", reference.report.aoErrorRms, "AO", {}, {}});
  steps.advance();  // the reference has warmed up, too

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

}  // namespace prelight::benchmarks
