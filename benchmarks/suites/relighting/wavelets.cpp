#include <fmt/format.h>

#include <algorithm>

#include "basis/cube_overlap.h"
#include "basis/haar.h"
#include "benchmarks/lab/haar_rotation.h"
#include "benchmarks/lab/wavelet_trials.h"
#include "benchmarks/run/measure.h"
#include "benchmarks/suites/relighting/flicker.h"
#include "benchmarks/suites/relighting/relighting_suite.h"
#include "benchmarks/suites/relighting/wavelet_turns.h"

namespace prelight::benchmarks {

namespace {

void add(std::vector<BenchmarkResult>& results, const std::string& name, const char* metric, double value,
         const char* unit) {
  results.push_back({name, metric, value, unit, {}, {}});
}

/// Error of the lit receivers against the number of the light's coefficients, by what these are ranked by.
void measureSelection(const WaveletScene& scene, const NamedLight& light, const RelightingOptions& options,
                      std::vector<BenchmarkResult>& results) {
  const std::vector<float> coefficients = haar::transformLight(light.map);
  const Lit exact = haar::relight(scene.transfer, coefficients);
  const std::vector<float> ones(scene.texels.count(), 1.0f),
      areas = haar::areaWeights(scene.texels.faceSize());
  const std::vector<std::pair<std::string, const std::vector<float>*>> rankings = {
      {"unweighted", &ones}, {"area", &areas}, {"transfer", &scene.model.rms}};
  for (const std::size_t count : options.waveletCounts) {
    const auto name = [&](const std::string& how) {
      return fmt::format("select/{}/{}/{}", light.name, count, how);
    };
    for (const auto& [how, weights] : rankings) {
      const haar::SparseLight part = haar::selectLight(coefficients, *weights, count);
      add(results, name(how), "error", 100.0 * relativeRms(haar::relight(scene.transfer, part), exact), "%");
    }
    const haar::SparseLight fitted = haar::selectFitted(coefficients, count, scene.model);
    add(results, name("transfer, fitted"), "error",
        100.0 * relativeRms(haar::relight(scene.transfer, fitted), exact), "%");
    add(results, name("transfer, fitted"), "expected error",
        100.0 * haar::expectedError(coefficients, fitted, scene.model), "%");
  }
  for (const int order : {3, 6, 10}) {
    const haar::BasisChoice choice =
        haar::chooseBasis(light.map, order, static_cast<std::size_t>(order * order), scene.model.rms);
    const std::string name = fmt::format("choose/{}/{}", light.name, order * order);
    add(results, name, "expected error, SH", 100.0 * choice.shError, "%");
    add(results, name, "expected error, Haar", 100.0 * choice.haarError, "%");
  }
}

double medianRowSize(const HaarTransfer& transfer) {
  std::vector<double> sizes;
  for (std::size_t row = 0; row + 1 < transfer.offsets.size(); ++row) {
    sizes.push_back(transfer.offsets[row + 1] - transfer.offsets[row]);
  }
  return median(std::move(sizes));
}

/// Coefficients a row against the error that it is stored with, and what bounces add to them.
void measureRows(const WaveletScene& scene, const NamedLight& light, std::vector<BenchmarkResult>& results) {
  const std::vector<float> coefficients = haar::transformLight(light.map);
  const auto links = scene.receivers.links(scene.texels);
  Lit exact;  // with three bounces
  for (const double error : {0.0, 0.01, 0.05}) {
    HaarTransfer bounce = scene.receivers.transfer(scene.texels, error), total = bounce;
    for (int bounces = 0; bounces <= 3; ++bounces) {
      const std::string name = fmt::format("rows/to {:g} %/{} bounces", 100.0 * error, bounces);
      add(results, name, "coefficients a row", medianRowSize(total), "");
      if (bounces == 3) {
        const Lit lit = haar::relight(total, coefficients);
        if (exact.empty()) exact = lit;
        add(results, name, "error", 100.0 * relativeRms(lit, exact), "%");
        break;
      }
      bounce = haar::gatherBounce(bounce, links, error);
      total = haar::keepRows(haar::addTransfer(total, bounce), error);
    }
  }
}

void measureTimes(const WaveletScene& scene, const NamedLight& light, const RelightingOptions& options,
                  std::vector<BenchmarkResult>& results) {
  const int size = scene.texels.faceSize();
  const glm::dmat3 turn = {{0.8, 0.0, -0.6}, {0.0, 1.0, 0.0}, {0.6, 0.0, 0.8}};
  const auto time = [&](const char* name, const std::function<void()>& work) {
    std::vector<double> seconds;
    for (int run = 0; run <= options.runs; ++run) seconds.push_back(secondsOf(work));
    seconds.erase(seconds.begin());
    add(results, fmt::format("time/{}", name), "time", median(std::move(seconds)), "s");
  };
  std::vector<float> values(scene.texels.count());
  time("open transfer of a receiver", [&] {
    scene.texels.open({0.36, 0.48, 0.8}, std::span<float>(values));
  });
  time("transform of a row", [&] { haar::forward(std::span<float>(values), size); });
  time("row to 1 %", [&] { haar::keepError(values, 0.01); });
  time("resampling for a rotation", [&] { rotateByArea(turn, size); });
  const CubeResampling resampling = rotateByArea(turn, size);
  time("resampling a light", [&] { resampling.apply(light.map); });
  const std::vector<float> coefficients = haar::transformLight(light.map);
  time("choice of 100 coefficients", [&] { haar::selectLight(coefficients, scene.model.rms, 100); });
  const haar::SparseLight chosen = haar::selectLight(coefficients, scene.model.rms, 100);
  time("fit of 100 coefficients", [&] { haar::fitSelection(coefficients, chosen, scene.model); });
  time("wavelet columns of 100 coefficients",
       [&] { haar::WaveletRotation(turn, size, 0.01).rotate(chosen); });
  time("model of the transfer", [&] { haar::modelTransfer(scene.transfer, haar::usualRank); });
}

}  // namespace

void runWavelets(const Device&, const RelightingOptions& options, SuiteRun& run) {
  const WaveletScene scene(options.waveletFaceSize, options.waveletReceivers);
  const std::vector<NamedLight> lights = waveletLights(options.waveletFaceSize, options.skies);
  StepCounter steps(run, "bench wavelets", 5);
  std::vector<BenchmarkResult>& results = run.results();
  for (const NamedLight& light : lights) measureSelection(scene, light, options, results);
  steps.advance();
  measureRows(scene, lights[1], results);
  steps.advance();
  measureTimes(scene, lights[1], options, results);
  steps.advance();
  const StopOnly stop(run);
  measureTurns(scene, lights, options, stop, results);
  steps.advance();
  compareWithQuincunx(scene, options, stop, results);
  steps.advance();
}

}  // namespace prelight::benchmarks
