#include "bake/haar_transfer.h"

#include <algorithm>

#include "base/error.h"
#include "base/parallel.h"
#include "basis/haar.h"
#include "basis/haar_selection.h"
#include "basis/sh.h"

namespace prelight {

namespace {

constexpr std::size_t slotGrain = 64;  // a workspace is made for as many

/// Face size that carries bounces: 5 degrees a texel, where SH of order 8 still falls by less than 1 % from a
/// texel's centre to its edge.
constexpr int bounceFaceSize = 16;

/// Wavelet coefficients of the texel integrals of SH functions, on the coarse levels of a cube map.
class ShToHaar {
 public:
  ShToHaar(int order, int faceSize) : count_(static_cast<std::size_t>(order * order)) {
    const int coarse = std::min(faceSize, bounceFaceSize), step = faceSize / coarse;
    const std::size_t texels = cubeTexelCount(coarse);
    const std::vector<double> integrals = sh::cubeTexelIntegrals(coarse, order);
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
  std::size_t count_;
  std::vector<float> matrix_;         ///< [coarse coefficient][i]
  std::vector<std::size_t> indices_;  ///< of the coarse coefficients in the whole cube map
};

/// SH coefficients of what bounces add in a channel of a slot.
std::vector<float> bounced(const SlotTransfer& transfer, std::size_t slot, std::size_t channel) {
  const std::size_t first = (slot * 3 + channel) * transfer.columns();
  std::vector<float> sh(transfer.shColumns());
  for (std::size_t i = 0; i < sh.size(); ++i)
    sh[i] = static_cast<float>(transfer.total[first + i] - transfer.direct[first + i]);
  return sh;
}

/// [slot * channels + channel]
std::vector<haar::SparseRow> makeRows(const FitMesh& mesh, const TexelTransfer& direct,
                                      const SlotTransfer& transfer, int faceSize, double error,
                                      Progress& progress) {
  const auto channels = static_cast<std::size_t>(transfer.channels());
  std::vector<haar::SparseRow> rows(mesh.slotCount() * channels);
  const std::size_t texels = cubeTexelCount(faceSize);
  std::optional<ShToHaar> shToHaar;
  if (transfer.bounces > 0) shToHaar.emplace(transfer.order, faceSize);
  // Slots part by part, so that a user can stop in between.
  const std::size_t part = 1024;
  for (std::size_t first = 0; first < mesh.slotCount(); first += part) {
    progress.check();
    const std::size_t count = std::min<std::size_t>(part, mesh.slotCount() - first);
    parallelRanges(count, slotGrain, [&](std::size_t begin, std::size_t end) {
      TexelTransfer::Workspace work = direct.workspace();
      std::vector<float> shared(texels), own(texels);
      for (std::size_t s = first + begin; s < first + end; ++s) {
        direct.evaluate(static_cast<std::uint32_t>(s), work, shared);
        haar::forward(std::span(shared), faceSize);
        for (std::size_t c = 0; c < channels; ++c) {
          own = shared;
          if (shToHaar) shToHaar->add(bounced(transfer, s, c), own);
          rows[s * channels + c] = haar::keepError(own, error);
        }
      }
    });
    progress.report("haar", double(first + count) / mesh.slotCount());
  }
  return rows;
}

}  // namespace

HaarTransfer makeHaarTransfer(const CompiledScene& scene, const FitMesh& mesh, const TexelTransfer& direct,
                              const SlotTransfer& transfer, int faceSize, double error, Progress& progress) {
  const auto channels = static_cast<std::size_t>(transfer.channels());
  const std::vector<haar::SparseRow> rows = makeRows(mesh, direct, transfer, faceSize, error, progress);
  const auto rowsOf = [&](std::uint32_t v) { return std::size_t{mesh.slotOfVertex[v]} * channels; };
  std::size_t entries = 0;
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v)
    for (std::size_t c = 0; c < channels; ++c) entries += rows[rowsOf(v) + c].indices.size();
  if (entries > 0xffffffffull)
    throw Error(ExitCode::OutOfMemory, "--haar", "the wavelet transfer has more than 2^32 coefficients",
                "use a smaller face size or a larger --haar-error");
  HaarTransfer haar{faceSize, transfer.channels(), transfer.bounces, {0}, {}, {}};
  haar.indices.reserve(entries);
  haar.values.reserve(entries);
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v)
    for (std::size_t c = 0; c < channels; ++c) {
      const haar::SparseRow& row = rows[rowsOf(v) + c];
      haar.indices.insert(haar.indices.end(), row.indices.begin(), row.indices.end());
      haar.values.insert(haar.values.end(), row.values.begin(), row.values.end());
      haar.offsets.push_back(static_cast<std::uint32_t>(haar.indices.size()));
    }
  return haar;
}

}  // namespace prelight
