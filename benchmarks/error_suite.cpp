#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "benchmarks/measure.h"
#include "benchmarks/suites.h"

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

/// What the runs of one number of rays came to.
struct ErrorPoint {
  double seconds = 0.0;      ///< median
  double vertexRms = 0.0;    ///< measured at vertices
  double surfaceRms = 0.0;   ///< measured over the surface
  double reportedRms = 0.0;  ///< standard error that the bake states, over the surface
};

/// Every run has a seed of its own: mean squares are over seeds as well as over the scene.
ErrorPoint measurePoint(const BenchmarkScene& scene, std::uint64_t rays, const Bake& reference,
                        const Device& device, int runs, const Progress& progress) {
  ErrorPoint point;
  std::vector<double> seconds;
  for (int run = 0; run < runs; ++run) {
    const BakeRequest request = aoRequest(rays, referenceSeed + 1 + static_cast<std::uint64_t>(run));
    const TimedBake result = timedBake(scene, request, device, progress);
    seconds.push_back(result.seconds());
    point.vertexRms += vertexMeanSquare(result.bake.ao, reference.ao) / runs;
    point.surfaceRms += surfaceMeanSquare(scene.compiled, result.bake.ao, reference.ao) / runs;
    point.reportedRms += result.report.aoErrorRms * result.report.aoErrorRms / runs;
  }
  point.seconds = median(seconds);
  for (double* rms : {&point.vertexRms, &point.surfaceRms, &point.reportedRms}) *rms = std::sqrt(*rms);
  return point;
}

void report(const std::string& name, const ErrorPoint& point, std::vector<BenchmarkResult>& results) {
  results.push_back({"error", name, "time", point.seconds, "s", {}, {}});
  results.push_back({"error", name, "vertex error", point.vertexRms, "AO", {}, {}});
  results.push_back({"error", name, "surface error", point.surfaceRms, "AO", {}, {}});
  BenchmarkResult reported{"error", name, "reported error", point.reportedRms, "AO", {}, {}};
  if (point.surfaceRms > 0.0) {
    reported.peer = "surface error";
    reported.ratio = point.reportedRms / point.surfaceRms;
  }
  results.push_back(std::move(reported));
}

}  // namespace

std::vector<BenchmarkResult> runErrorSuite(const Device& device, const BenchmarkOptions& options,
                                           Progress& progress) {
  constexpr std::array<const char*, 2> scenes = {"shapes", "cornell"};
  StepCounter steps(progress, "bench error", scenes.size() * (1 + options.errorRays.size()));
  std::vector<BenchmarkResult> results;
  for (const char* name : scenes) {
    const BenchmarkScene scene = loadBuiltinScene(name);
    const BakeRequest request = aoRequest(options.errorReferenceRays, referenceSeed);
    const TimedBake reference = timedBake(scene, request, device, progress);  // warms up, too
    const std::string referenceName = fmt::format("{}/reference of {} rays", name, request.rays);
    results.push_back({"error", referenceName, "time", reference.seconds(), "s", {}, {}});
    results.push_back({"error", referenceName, "reported error", reference.report.aoErrorRms, "AO", {}, {}});
    steps.advance();
    for (const std::uint64_t rays : options.errorRays) {
      report(fmt::format("{}/{} rays", name, rays),
             measurePoint(scene, rays, reference.bake, device, options.runs, progress), results);
      steps.advance();
    }
  }
  return results;
}

}  // namespace prelight::benchmarks
