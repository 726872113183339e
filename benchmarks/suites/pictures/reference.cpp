#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "base/colour.h"
#include "benchmarks/suites/pictures/path_traced.h"
#include "benchmarks/suites/pictures/pictures_suite.h"

namespace prelight::benchmarks {

namespace {

/// The long run's seed; no other run has it, so that errors are independent.
constexpr std::uint64_t longRunSeed = 0;

/// Mean over pixels and colours of the squared difference over the squared truth, which a hundredth of the
/// picture's mean square keeps from vanishing.
double relativeMeanSquare(const Picture& picture, const Picture& truth) {
  double meanSquare = 0.0;
  for (const glm::vec3& pixel : truth.pixels) meanSquare += double(glm::dot(pixel, pixel)) / 3.0;
  meanSquare /= static_cast<double>(truth.pixels.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double t = truth.pixels[i][c], difference = picture.pixels[i][c] - t;
      sum += difference * difference / (t * t + 0.01 * meanSquare);
    }
  return sum / (3.0 * static_cast<double>(truth.pixels.size()));
}

/// Root mean square difference of luminance over the truth's mean luminance: what Film::relativeError()
/// estimates.
double relativeError(const Picture& picture, const Picture& truth) {
  double squares = 0.0, mean = 0.0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    const double t = luminance(truth.pixels[i]);
    const double difference = luminance(picture.pixels[i]) - t;
    squares += difference * difference;
    mean += t;
  }
  const auto count = static_cast<double>(truth.pixels.size());
  return std::sqrt(squares / count) / (mean / count);
}

/// Errors and seconds of the runs with one number of samples; squares are averaged over runs, each of a seed
/// of its own.
struct QualityPoint {
  std::uint64_t samples = 0;  ///< a pixel
  std::vector<double> seconds = {};
  double relativeSquares = 0.0;  ///< sums over runs
  double errorSquares = 0.0;
  double reportedSquares = 0.0;

  void add(const TimedPicture& run, const Picture& truth) {
    seconds.push_back(run.seconds);
    relativeSquares += relativeMeanSquare(run.picture, truth);
    const double error = relativeError(run.picture, truth);
    errorSquares += error * error;
    reportedSquares += run.reportedError * run.reportedError;
  }

  double mean(double sum) const { return sum / static_cast<double>(seconds.size()); }
};

void reportReference(const std::string& scene, const QualityPoint& point,
                     std::vector<BenchmarkResult>& results) {
  const std::string name = fmt::format("{}/{} samples", scene, point.samples);
  results.push_back({name, "time", median(point.seconds), "s", {}, {}});
  results.push_back({name, "relMSE", point.mean(point.relativeSquares), "relative", {}, {}});
  results.push_back({name, "error", std::sqrt(point.mean(point.errorSquares)), "of mean luminance", {}, {}});
  BenchmarkResult reported{
      name, "reported error", std::sqrt(point.mean(point.reportedSquares)), "of mean luminance", {}, {}};
  if (point.errorSquares > 0.0) {
    reported.peer = "error";
    reported.ratio = std::sqrt(point.reportedSquares / point.errorSquares);
  }
  results.push_back(std::move(reported));
}

/// Numbers of samples take turns, run by run, so that all meet the same disturbances.
void measureReference(const BenchmarkScene& scene, const Device& device, const PicturesOptions& options,
                      StepCounter& steps, const Progress& progress, std::vector<BenchmarkResult>& results) {
  const int size = options.referenceSize;
  const TimedPicture truth = pathTrace(scene, size, options.referenceLongRun, longRunSeed, device, progress);
  const std::string name = fmt::format("{}/long run of {} samples", scene.name, options.referenceLongRun);
  results.push_back({name, "time", truth.seconds, "s", {}, {}});
  results.push_back({name, "reported error", truth.reportedError, "of mean luminance", {}, {}});
  steps.advance();  // the long run has warmed up, too

  std::vector<QualityPoint> points;
  for (const std::uint64_t samples : options.referenceSamples) points.push_back({.samples = samples});
  for (int run = 0; run < options.runs; ++run) {
    const std::uint64_t seed = longRunSeed + 1 + static_cast<std::uint64_t>(run);
    for (QualityPoint& point : points)
      point.add(pathTrace(scene, size, point.samples, seed, device, progress), truth.picture);
    steps.advance();
  }
  for (const QualityPoint& point : points) reportReference(scene.name, point, results);
}

}  // namespace

void runReference(const Device& device, const PicturesOptions& options, SuiteRun& run) {
  constexpr std::array<const char*, 2> scenes = {"cornell", "caustics"};
  StepCounter steps(run, "bench reference", scenes.size() * static_cast<std::size_t>(options.runs + 1));
  std::vector<BenchmarkResult>& results = run.results();
  for (const char* name : scenes)
    measureReference(loadBuiltinScene(name), device, options, steps, run, results);
}

}  // namespace prelight::benchmarks
