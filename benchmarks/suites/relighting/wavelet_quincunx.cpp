#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "basis/cube_overlap.h"
#include "basis/haar.h"
#include "benchmarks/lab/quincunx.h"
#include "benchmarks/suites/relighting/flicker.h"
#include "benchmarks/suites/relighting/wavelet_turns.h"

// Both bases see the same light and the same visibility on a cube of twice the face size: a Haar texel is the
// mean of four of its texels within a face, a point of the lattice that of the four (at corners three) around
// it.

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

/// A basis as the comparison needs it.
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

/// Means of the fine light over cells, [channel][cell].
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

/// Coefficients with all but the `count` most important of the three channels together set to 0.
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

/// Relative L2 error over the sphere of the light from `count` coefficients, ranked by L2.
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

}  // namespace prelight::benchmarks
