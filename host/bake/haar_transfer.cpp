#include "bake/haar_transfer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "basis/haar.h"
#include "basis/quadrature.h"
#include "basis/sh.h"

namespace prelight {

namespace {

constexpr std::size_t slotGrain = 64;  // a workspace is made for as many

/// Face size that carries bounces: 5 degrees a texel, where SH of order 8 still falls by less than 1 % from a
/// texel's centre to its edge.
constexpr int bounceFaceSize = 16;

struct SparseRow {
  std::vector<std::uint32_t> indices;
  std::vector<float> values;
};

/// Wavelet coefficients of the texel integrals of SH functions, on the coarse levels of a cube map.
class ShToHaar {
 public:
  ShToHaar(int order, int faceSize) : count_(static_cast<std::size_t>(order * order)) {
    const int coarse = std::min(faceSize, bounceFaceSize), step = faceSize / coarse;
    const std::size_t texels = cubeTexelCount(coarse);
    std::vector<double> integrals(texels * count_);
    for (std::uint32_t t = 0; t < texels; ++t)
      integrate(t, coarse, order, std::span(integrals).subspan(t * count_, count_));
    matrix_.resize(texels * count_);
    std::vector<double> column(texels);
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t t = 0; t < texels; ++t) column[t] = integrals[t * count_ + i];
      haar::forward(std::span(column), coarse);
      // A square of step x step texels that share its integral evenly has 1 / step of it as its average
      // coefficient.
      for (std::size_t t = 0; t < texels; ++t) matrix_[t * count_ + i] = static_cast<float>(column[t] / step);
    }
    const auto size = static_cast<std::size_t>(coarse);
    for (std::size_t t = 0; t < texels; ++t)
      indices_.push_back(((t / size) * static_cast<std::size_t>(step)) * static_cast<std::size_t>(faceSize) +
                         t % size * static_cast<std::size_t>(step));
  }

  /// Adds a function given by its SH coefficients.
  void add(std::span<const float> sh, std::span<float> haar) const {
    for (std::size_t t = 0; t < indices_.size(); ++t) {
      const float* row = &matrix_[t * count_];
      float sum = 0.0f;
      for (std::size_t i = 0; i < count_; ++i) sum += row[i] * sh[i];
      haar[indices_[t]] += sum;
    }
  }

 private:
  /// Integral of Y_i over a texel, by 4 x 4 Gauss points: exact to 1e-9 at order 8.
  static void integrate(std::uint32_t texel, int faceSize, int order, std::span<double> out) {
    static const std::vector<LineSample> rule = gaussLegendre(4);
    const auto size = static_cast<std::uint32_t>(faceSize);
    const int face = static_cast<int>(texel / (size * size));
    const double row = texel / size % size, column = texel % size, step = 1.0 / faceSize;
    std::vector<double> basis(out.size());
    for (const LineSample& y : rule)
      for (const LineSample& x : rule) {
        const double u = step * (column + 0.5 + 0.5 * x.position), v = step * (row + 0.5 + 0.5 * y.position);
        const double a = 2.0 * u - 1.0, b = 2.0 * v - 1.0, r2 = 1.0 + a * a + b * b;
        sh::evaluate(cubeDirection(face, u, v), order, basis);
        const double weight = x.weight * y.weight * step * step / (r2 * std::sqrt(r2));
        for (std::size_t i = 0; i < out.size(); ++i) out[i] += weight * basis[i];
      }
  }

  std::size_t count_;
  std::vector<float> matrix_;         ///< [coarse coefficient][i]
  std::vector<std::size_t> indices_;  ///< of the coarse coefficients in the whole cube map
};

/// What keepLargest() works in.
struct Candidates {
  std::vector<std::uint32_t> indices;
  std::vector<float> values;
};

/// Sum of squares, in eight sums that a compiler can keep side by side.
double squaredNorm(std::span<const float> values) {
  std::array<float, 8> sums{};
  std::size_t i = 0;
  for (; i + 8 <= values.size(); i += 8)
    for (std::size_t k = 0; k < 8; ++k) sums[k] += values[i + k] * values[i + k];
  double total = 0.0;
  for (; i < values.size(); ++i) total += double(values[i]) * values[i];
  for (const float sum : sums) total += sum;
  return total;
}

/// The largest coefficients that together leave at most `error` of the row's norm, found by a histogram of
/// magnitudes: a sort would take longer than all the rest. Steps of a fifth of a magnitude: some more are
/// kept than need be.
SparseRow keepLargest(std::span<const float> coefficients, double error, Candidates& work) {
  const double total = squaredNorm(coefficients);
  // All below the allowed mean may go together; they are most.
  const auto least = static_cast<float>(error * error * total / static_cast<double>(coefficients.size()));
  work.indices.clear();
  work.values.clear();
  double dropped = 0.0;
  std::array<double, 1024> energy{};
  const auto binOf = [](float square) { return std::bit_cast<std::uint32_t>(square) >> 21; };
  for (std::uint32_t i = 0; i < coefficients.size(); ++i) {
    const float square = coefficients[i] * coefficients[i];
    if (square <= least) {
      dropped += square;
      continue;
    }
    work.indices.push_back(i);
    work.values.push_back(coefficients[i]);
    energy[binOf(square)] += square;
  }
  double left = error * error * total - dropped;
  std::uint32_t bin = 0;
  while (bin < energy.size() && energy[bin] <= left) left -= energy[bin++];
  const auto kept = [&](float value) { return binOf(value * value) >= bin; };
  SparseRow row;
  const auto count = static_cast<std::size_t>(std::count_if(work.values.begin(), work.values.end(), kept));
  row.indices.reserve(count);
  row.values.reserve(count);
  for (std::size_t k = 0; k < work.values.size(); ++k)
    if (kept(work.values[k])) {
      row.indices.push_back(work.indices[k]);
      row.values.push_back(work.values[k]);
    }
  return row;
}

/// SH coefficients of what bounces add in a channel of a slot.
std::vector<float> bounced(const SlotTransfer& transfer, std::size_t slot, std::size_t channel) {
  const std::size_t first = (slot * 3 + channel) * transfer.columns();
  std::vector<float> sh(transfer.shColumns());
  for (std::size_t i = 0; i < sh.size(); ++i)
    sh[i] = static_cast<float>(transfer.total[first + i] - transfer.direct[first + i]);
  return sh;
}

/// [slot * channels + channel]
std::vector<SparseRow> makeRows(const FitMesh& mesh, const TexelTransfer& direct,
                                const SlotTransfer& transfer, int faceSize, int channels, double error,
                                Progress& progress) {
  std::vector<SparseRow> rows(std::size_t{mesh.slotCount()} * static_cast<std::size_t>(channels));
  const std::size_t texels = cubeTexelCount(faceSize);
  std::optional<ShToHaar> shToHaar;
  if (channels == 3) shToHaar.emplace(transfer.order, faceSize);
  // Slots part by part, so that a user can stop in between.
  const std::size_t part = 1024;
  for (std::size_t first = 0; first < mesh.slotCount(); first += part) {
    progress.check();
    const std::size_t count = std::min<std::size_t>(part, mesh.slotCount() - first);
    parallelRanges(count, slotGrain, [&](std::size_t begin, std::size_t end) {
      TexelTransfer::Workspace work = direct.workspace();
      std::vector<float> shared(texels), own(texels);
      Candidates candidates;
      for (std::size_t s = first + begin; s < first + end; ++s) {
        direct.evaluate(static_cast<std::uint32_t>(s), work, shared);
        haar::forward(std::span(shared), faceSize);
        for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
          own = shared;
          if (shToHaar) shToHaar->add(bounced(transfer, s, c), own);
          rows[s * static_cast<std::size_t>(channels) + c] = keepLargest(own, error, candidates);
        }
      }
    });
    progress.report("haar", double(first + count) / mesh.slotCount());
  }
  return rows;
}

}  // namespace

HaarTransfer makeHaarTransfer(const CompiledScene& scene, const FitMesh& mesh, const TexelTransfer& direct,
                              const SlotTransfer& transfer, int faceSize, int channels, double error,
                              Progress& progress) {
  const std::vector<SparseRow> rows = makeRows(mesh, direct, transfer, faceSize, channels, error, progress);
  const auto rowsOf = [&](std::uint32_t v) {
    return std::size_t{mesh.slotOfVertex[v]} * static_cast<std::size_t>(channels);
  };
  std::size_t entries = 0;
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v)
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c)
      entries += rows[rowsOf(v) + c].indices.size();
  if (entries > 0xffffffffull)
    throw Error(ExitCode::OutOfMemory, "--haar", "the wavelet transfer has more than 2^32 coefficients",
                "use a smaller face size or a larger --haar-error");
  HaarTransfer haar{faceSize, channels, 0, {0}, {}, {}};
  haar.indices.reserve(entries);
  haar.values.reserve(entries);
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v)
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
      const SparseRow& row = rows[rowsOf(v) + c];
      haar.indices.insert(haar.indices.end(), row.indices.begin(), row.indices.end());
      haar.values.insert(haar.values.end(), row.values.begin(), row.values.end());
      haar.offsets.push_back(static_cast<std::uint32_t>(haar.indices.size()));
    }
  return haar;
}

}  // namespace prelight
