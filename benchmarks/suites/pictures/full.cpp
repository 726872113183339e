#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "benchmarks/suites/pictures/path_traced.h"
#include "benchmarks/suites/pictures/pictures_suite.h"
#include "integrators/global_illumination_renderer.h"

namespace prelight::benchmarks {

namespace {

constexpr std::uint64_t truthSeed = 1000;
constexpr std::array<std::uint32_t, 3> sampleCounts = {4, 8, 16};
constexpr std::uint64_t peerSamples = 64;  ///< a pixel of the path tracer

/// Mean over the best 99 % of the pixels of the squared difference over the squared truth plus 0.01.
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

/// Seconds and errors of the runs of one way to make the picture.
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
  // The path tracer's error falls with the inverse of its time.
  const double peerSeconds = median(peer.seconds) * median(peer.errors) / std::max(error, 1e-12);
  results.push_back(
      {name, "time", seconds, "s", "path tracing to the same error", peerSeconds / std::max(seconds, 1e-9)});
}

/// Ways take turns, run by run, so that all meet the same disturbances.
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
