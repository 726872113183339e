#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/colour.h"
#include "benchmarks/run/measure.h"
#include "benchmarks/suites/pictures/pictures_suite.h"
#include "integrators/global_illumination_renderer.h"
#include "integrators/reference.h"
#include "prelight/picture.h"

namespace prelight::benchmarks {

namespace {

struct TimedPicture {
  Picture picture;
  double seconds = 0.0;
  double reportedError = 0.0;  ///< Film::relativeError() of path tracing; 0 after a single pass
};

/// Returns a picture by the reference renderer with the scene's own lights and first camera: a square of
/// `size` pixels per side. `progress` can stop it but is told nothing.
TimedPicture pathTrace(const BenchmarkScene& scene, int size, std::uint64_t samples, std::uint64_t seed,
                       const Device& device, const Progress& progress) {
  const reference::ReferenceInputs inputs{.scene = scene.compiled,
                                          .images = scene.scene.images,
                                          .lights = scene.scene.lights,
                                          .camera = scene.scene.cameras.at(0)};
  reference::ReferenceRequest request;
  request.samples = samples;
  request.seed = seed;
  request.width = request.height = size;
  reference::Film film(size, size);
  reference::ReferenceReport report;
  StopOnly quiet(progress);
  TimedPicture result;
  result.seconds = secondsOf([&] { renderReference(inputs, request, device, quiet, film, report); });
  result.picture = film.picture();
  result.reportedError = film.passes < 2 ? 0.0 : film.relativeError();
  return result;
}

/// Seed of the long run. No other run has it, so that errors are independent.
constexpr std::uint64_t longRunSeed = 0;

/// Returns the mean over pixels and colours of the squared difference as a share of the squared truth plus a
/// hundredth of the picture's mean square.
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

/// Returns the root mean square difference of luminance as a share of the truth's mean luminance, which
/// Film::relativeError() estimates.
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

/// Errors and seconds of the runs with one number of samples. Squares are averaged over runs, each of which
/// has its own seed.
struct QualityPoint {
  std::uint64_t samples = 0;  ///< per pixel
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

/// Measures numbers of samples in turns, run by run, so that disturbances affect all of them.
void measureReference(const BenchmarkScene& scene, const Device& device, const PicturesOptions& options,
                      StepCounter& steps, const Progress& progress, std::vector<BenchmarkResult>& results) {
  const int size = options.referenceSize;
  const TimedPicture truth = pathTrace(scene, size, options.referenceLongRun, longRunSeed, device, progress);
  const std::string name = fmt::format("{}/long run of {} samples", scene.name, options.referenceLongRun);
  results.push_back({name, "time", truth.seconds, "s", {}, {}});
  results.push_back({name, "reported error", truth.reportedError, "of mean luminance", {}, {}});
  steps.advance();  // the long run has also warmed up

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

namespace {

constexpr std::uint64_t truthSeed = 1000;
constexpr std::array<std::uint32_t, 3> sampleCounts = {4, 8, 16};
constexpr std::uint64_t peerSamples = 64;  ///< samples per pixel of the path tracer

/// Returns the mean, over the best 99 % of the pixels, of the squared difference divided by the squared truth
/// plus 0.01.
double relMse99(const Picture& picture, const Picture& truth) {
  std::vector<double> errors;
  errors.reserve(truth.pixels.size());
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    double error = 0.0;
    for (int c = 0; c < 3; ++c) {
      const double t = truth.pixels[i][c], difference = picture.pixels[i][c] - t;
      error += difference * difference / (3.0 * (t * t + 0.01));
    }
    errors.push_back(error);
  }
  std::sort(errors.begin(), errors.end());
  const std::size_t kept = std::max<std::size_t>(1, errors.size() * 99 / 100);
  double sum = 0.0;
  for (std::size_t i = 0; i < kept; ++i) sum += errors[i];
  return sum / static_cast<double>(kept);
}

TimedPicture renderAll(const BenchmarkScene& scene, int size, std::uint32_t samples, std::uint64_t seed,
                       const Device& device, const Progress& progress) {
  const LitScene lit{scene.compiled, scene.scene.images, scene.scene.lights};
  GlobalIlluminationPictureRequest request;
  request.samples = samples;
  request.seed = request.indirect.seed = seed;
  request.width = request.height = size;
  StopOnly quiet(progress);
  GlobalIlluminationPictureReport reportGlobalIllumination;
  TimedPicture trial;
  trial.seconds = secondsOf([&] {
    trial.picture = renderGlobalIllumination(scene.scene, lit, scene.scene.cameras.at(0), request, device,
                                             quiet, reportGlobalIllumination);
  });
  return trial;
}

/// Seconds and errors of the runs of one way to make a picture.
struct Measured {
  std::vector<double> seconds, errors;

  void add(const TimedPicture& trial, const Picture& truth) {
    seconds.push_back(trial.seconds);
    errors.push_back(relMse99(trial.picture, truth));
  }
};

void reportGlobalIllumination(const std::string& scene, std::uint32_t samples, const Measured& gathered,
                              const Measured& peer, std::vector<BenchmarkResult>& results) {
  const std::string name = fmt::format("{}/{} samples", scene, samples);
  const double error = median(gathered.errors), seconds = median(gathered.seconds);
  results.push_back({name, "relMSE of 99 %", error, "relative", {}, {}});
  // The error of the path tracer is inversely proportional to its time.
  const double peerSeconds = median(peer.seconds) * median(peer.errors) / std::max(error, 1e-12);
  results.push_back(
      {name, "time", seconds, "s", "path tracing to the same error", peerSeconds / std::max(seconds, 1e-9)});
}

/// Measures the ways in turns, run by run, so that disturbances affect all of them.
void measureGlobalIllumination(const BenchmarkScene& scene, const Device& device,
                               const PicturesOptions& options, StepCounter& steps, const Progress& progress,
                               std::vector<BenchmarkResult>& results) {
  const int size = 2 * options.referenceSize;
  const Picture truth = pathTrace(scene, size, options.referenceLongRun, truthSeed, device, progress).picture;
  renderAll(scene, size, sampleCounts[0], 0, device, progress);  // warms up
  steps.advance();
  Measured peer;
  std::array<Measured, sampleCounts.size()> gathered;
  for (int run = 0; run < options.runs; ++run) {
    const auto seed = static_cast<std::uint64_t>(run);
    peer.add(pathTrace(scene, size, std::min(peerSamples, options.referenceLongRun), seed, device, progress),
             truth);
    for (std::size_t i = 0; i < gathered.size(); ++i)
      gathered[i].add(renderAll(scene, size, sampleCounts[i], seed, device, progress), truth);
    steps.advance();
  }
  for (std::size_t i = 0; i < gathered.size(); ++i)
    reportGlobalIllumination(scene.name, sampleCounts[i], gathered[i], peer, results);
}

}  // namespace

void runFull(const Device& device, const PicturesOptions& options, SuiteRun& run) {
  constexpr std::array<const char*, 3> scenes = {"cornell", "caustics", "rooms"};
  StepCounter steps(run, "bench full", scenes.size() * static_cast<std::size_t>(options.runs + 1));
  std::vector<BenchmarkResult>& results = run.results();
  for (const char* name : scenes)
    measureGlobalIllumination(loadBuiltinScene(name), device, options, steps, run, results);
}

}  // namespace prelight::benchmarks
