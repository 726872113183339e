#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "basis/cube_overlap.h"
#include "basis/haar.h"
#include "benchmarks/lab/haar_rotation.h"
#include "benchmarks/lab/quincunx.h"
#include "benchmarks/lab/wavelet_trials.h"
#include "benchmarks/run/measure.h"
#include "benchmarks/suites/relighting/relighting_suite.h"
#include "benchmarks/suites/relighting/wavelet_turns.h"

// Both bases represent the same light and visibility on a cube of twice the face size. A Haar texel is the
// mean of four of its texels within a face, a point of the lattice the mean of the four (three at corners)
// around it.

namespace prelight::benchmarks {

namespace {

/// Cells that group the texels of the fine cube.
struct Cells {
  std::vector<std::uint32_t> cellOf;  ///< [fine texel]
  std::vector<double> solidAngles;    ///< [cell]

  Cells(std::vector<std::uint32_t> cells, std::size_t count, const CubeTexels& fine)
      : cellOf(std::move(cells)), solidAngles(count, 0.0) {
    for (std::uint32_t i = 0; i < cellOf.size(); ++i) solidAngles[cellOf[i]] += fine.solidAngle(i);
  }
};

/// A basis with the values that the comparison needs.
struct Basis {
  std::string name;
  Cells cells;
  std::vector<double> norms;  ///< L2 norm of a coefficient's function, for ranking
  std::function<void(std::vector<double>&)> forward, inverse, transfer;
  std::vector<std::vector<double>> rows = {};  ///< [receiver][coefficient]
  std::vector<double> rms = {};                ///< [coefficient]
};

Basis haarBasis(int faceSize, const CubeTexels& fine) {
  std::vector<std::uint32_t> cells(fine.count());
  const auto size = static_cast<std::uint32_t>(fine.faceSize());
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    const std::uint32_t face = i / (size * size), row = i / size % size, column = i % size;
    cells[i] = (face * size / 2 + row / 2) * (size / 2) + column / 2;
  }
  const auto forward = [faceSize](std::vector<double>& values) {
    haar::forward(std::span<double>(values), faceSize);
  };
  const auto inverse = [faceSize](std::vector<double>& values) {
    haar::inverse(std::span<double>(values), faceSize);
  };
  return {"Haar",
          Cells(std::move(cells), cubeTexelCount(faceSize), fine),
          std::vector<double>(cubeTexelCount(faceSize), 1.0),
          forward,
          inverse,
          forward};
}

Basis quincunxBasis(const QuincunxLattice& lattice, const CubeTexels& fine) {
  std::vector<std::uint32_t> cells(fine.count());
  for (std::uint32_t i = 0; i < cells.size(); ++i) cells[i] = lattice.pointOf(i);
  return {"quincunx",
          Cells(std::move(cells), lattice.size(), fine),
          lattice.functionNorms(),
          [&lattice](std::vector<double>& values) { lattice.forward(values); },
          [&lattice](std::vector<double>& values) { lattice.inverse(values); },
          [&lattice](std::vector<double>& values) { lattice.transposedInverse(values); }};
}

void projectTransfer(Basis& basis, const std::vector<std::vector<float>>& fineRows) {
  const std::size_t count = basis.norms.size();
  basis.rms.assign(count, 0.0);
  for (const std::vector<float>& fine : fineRows) {
    std::vector<double> row(count, 0.0);
    for (std::size_t i = 0; i < fine.size(); ++i) row[basis.cells.cellOf[i]] += static_cast<double>(fine[i]);
    basis.transfer(row);
    for (std::size_t i = 0; i < count; ++i) basis.rms[i] += row[i] * row[i];
    basis.rows.push_back(std::move(row));
  }
  for (double& value : basis.rms) value = std::sqrt(value / static_cast<double>(fineRows.size()));
}

/// Returns means of the fine light over cells, [channel][cell].
std::array<std::vector<double>, 3> cellMeans(const Basis& basis, const CubeMap& light,
                                             const CubeTexels& fine) {
  std::array<std::vector<double>, 3> means;
  for (int c = 0; c < 3; ++c) {
    means[c].assign(basis.norms.size(), 0.0);
    for (std::uint32_t i = 0; i < light.radiance.size(); ++i) {
      const std::uint32_t cell = basis.cells.cellOf[i];
      means[c][cell] +=
          fine.solidAngle(i) / basis.cells.solidAngles[cell] * static_cast<double>(light.radiance[i][c]);
    }
  }
  return means;
}

/// Returns the coefficients with all set to 0 but the `count` most important of the three channels together.
std::array<std::vector<double>, 3> keep(const std::array<std::vector<double>, 3>& light,
                                        const std::vector<double>& weights, std::size_t count) {
  std::vector<std::pair<double, std::size_t>> ranks;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const glm::dvec3 value(light[0][i], light[1][i], light[2][i]);
    ranks.emplace_back(-glm::length(value) * weights[i], i);
  }
  std::sort(ranks.begin(), ranks.end());
  std::array<std::vector<double>, 3> kept;
  for (int c = 0; c < 3; ++c) {
    kept[c].assign(weights.size(), 0.0);
    for (std::size_t k = 0; k < std::min(count, ranks.size()); ++k) {
      kept[c][ranks[k].second] = light[c][ranks[k].second];
    }
  }
  return kept;
}

Lit relightDense(const Basis& basis, const std::array<std::vector<double>, 3>& light) {
  std::vector<std::uint32_t> used;
  for (std::uint32_t i = 0; i < light[0].size(); ++i) {
    if (light[0][i] != 0.0 || light[1][i] != 0.0 || light[2][i] != 0.0) used.push_back(i);
  }
  Lit lit;
  for (const std::vector<double>& row : basis.rows) {
    glm::dvec3 sum(0.0);
    for (const std::uint32_t i : used) sum += row[i] * glm::dvec3(light[0][i], light[1][i], light[2][i]);
    lit.push_back(sum);
  }
  return lit;
}

/// Returns the relative L2 error over the sphere of the light with `count` coefficients, ranked by L2.
double lightError(const Basis& basis, const std::array<std::vector<double>, 3>& means,
                  const std::array<std::vector<double>, 3>& coefficients, std::size_t count) {
  auto kept = keep(coefficients, basis.norms, count);
  double error = 0.0, total = 0.0;
  for (int c = 0; c < 3; ++c) {
    basis.inverse(kept[c]);
    for (std::size_t i = 0; i < kept[c].size(); ++i) {
      const double difference = kept[c][i] - means[c][i];
      error += basis.cells.solidAngles[i] * difference * difference;
      total += basis.cells.solidAngles[i] * means[c][i] * means[c][i];
    }
  }
  return std::sqrt(error / total);
}

void compareBasis(const Basis& basis, const NamedLight& light, const std::vector<CubeMap>& frames,
                  const CubeTexels& fine, const RelightingOptions& options,
                  std::vector<BenchmarkResult>& results) {
  std::vector<FlickerMeter> meters(options.waveletCounts.size());
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const auto means = cellMeans(basis, frames[f], fine);
    auto coefficients = means;
    for (std::vector<double>& channel : coefficients) basis.forward(channel);
    const Lit exact = relightDense(basis, coefficients);
    for (std::size_t k = 0; k < meters.size(); ++k) {
      const std::size_t count = options.waveletCounts[k];
      meters[k].add(relightDense(basis, keep(coefficients, basis.rms, count)), exact, count);
      if (f > 0) continue;
      const std::string name = fmt::format("lattice/{}/{}/{}", light.name, count, basis.name);
      results.push_back(
          {name, "light error", 100.0 * lightError(basis, means, coefficients, count), "%", {}, {}});
    }
  }
  for (std::size_t k = 0; k < meters.size(); ++k) {
    const std::string name =
        fmt::format("lattice/{}/{}/{}", light.name, options.waveletCounts[k], basis.name);
    results.push_back({name, "error", 100.0 * meters[k].error(), "%", {}, {}});
    results.push_back({name, "flicker", 100.0 * meters[k].flicker(), "%", {}, {}});
  }
}

}  // namespace

void compareWithQuincunx(const WaveletScene& scene, const RelightingOptions& options,
                         const Progress& progress, std::vector<BenchmarkResult>& results) {
  const int faceSize = scene.texels.faceSize();
  const CubeTexels fine(2 * faceSize);
  const QuincunxLattice lattice(faceSize);
  std::vector<std::vector<float>> rows;
  for (std::size_t r = 0; r < scene.receivers.count(); ++r) {
    rows.push_back(scene.receivers.texelTransfer(r, fine));
    progress.check();
  }
  std::vector<Basis> bases = {haarBasis(faceSize, fine), quincunxBasis(lattice, fine)};
  for (Basis& basis : bases) projectTransfer(basis, rows);
  const int frames = std::min(options.waveletFrames, 11);
  for (const NamedLight& light : waveletLights(fine.faceSize(), options.skies)) {
    std::vector<CubeMap> turned;
    for (int f = 0; f < frames; ++f) {
      const double angle = f * std::numbers::pi / 180.0;
      const double c = std::cos(angle), s = std::sin(angle);
      turned.push_back(
          rotateByArea({{c, 0.0, -s}, {0.0, 1.0, 0.0}, {s, 0.0, c}}, fine.faceSize()).apply(light.map));
      progress.check();
    }
    for (const Basis& basis : bases) compareBasis(basis, light, turned, fine, options, results);
  }
}

namespace {

void add(std::vector<BenchmarkResult>& results, const std::string& name, const char* metric, double value,
         const char* unit) {
  results.push_back({name, metric, value, unit, {}, {}});
}

/// Measures the error of lit receivers by the number of the light's coefficients and by how they are ranked.
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

/// Measures coefficients per row by the error of storage, and the coefficients that bounces add.
void measureRows(const WaveletScene& scene, const NamedLight& light, std::vector<BenchmarkResult>& results) {
  const std::vector<float> coefficients = haar::transformLight(light.map);
  const auto links = scene.receivers.links(scene.texels);
  Lit exact;  // lit exactly, with three bounces
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
