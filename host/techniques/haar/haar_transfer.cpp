#include "techniques/haar/haar_transfer.h"

#include <algorithm>
#include <array>
#include <optional>

#include "base/clocks.h"
#include "base/kept_work.h"
#include "base/parallel.h"
#include "basis/haar.h"
#include "basis/haar_cut.h"
#include "basis/sh.h"
#include "prelight/error.h"

namespace prelight {

namespace {

constexpr std::uint32_t slotGrain = 64;   // a workspace is made for as many
constexpr std::uint32_t partSize = 1024;  // slots at once, at most

/// Face size that carries bounces: 5 degrees a texel, where SH of order 8 still falls by less than 1 % from a
/// texel's centre to its edge.
constexpr int bounceFaceSize = 16;

/// What bounces, mirrors and glass add, in wavelets: those of the texel integrals of SH functions on the
/// coarse levels of a cube map.
class ShToHaar {
 public:
  ShToHaar(int order, int faceSize) : count_(static_cast<std::size_t>(order * order)) {
    const int coarse = std::min(faceSize, bounceFaceSize), step = faceSize / coarse;
    const std::size_t texels = cubeTexelCount(coarse);
    const std::vector<double> integrals = sh::cubeTexelIntegrals(coarse, order);
    matrix_.resize((texels + width - 1) / width * width * count_);
    std::vector<double> column(texels);
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t t = 0; t < texels; ++t) column[t] = integrals[t * count_ + i];
      haar::forward(std::span(column), coarse);
      // A square of step x step texels that share its integral evenly has 1 / step of it as its average
      // coefficient.
      for (std::size_t t = 0; t < texels; ++t)
        matrix_[(t / width * count_ + i) * width + t % width] = static_cast<float>(column[t] / step);
    }
    const auto size = static_cast<std::uint32_t>(coarse), stride = static_cast<std::uint32_t>(step);
    for (std::uint32_t t = 0; t < texels; ++t)
      indices_.push_back(t / size * stride * static_cast<std::uint32_t>(faceSize) + t % size * stride);
  }

  /// Where the coarse coefficients are among those of the whole cube map, ascending.
  const std::vector<std::uint32_t>& indices() const { return indices_; }

  /// Adds functions given by their SH coefficients, [i][channel], to coarse coefficients, [channel][t].
  void add(std::span<const std::array<float, 3>> sh, std::span<float> coarse) const {
    const std::size_t size = indices_.size();
    for (std::size_t t = 0; t < size; t += width) {
      std::array<std::array<float, width>, 3> sums{};
      for (std::size_t i = 0; i < count_; ++i) {
        const float* row = &matrix_[(t / width * count_ + i) * width];
        for (std::size_t c = 0; c < 3; ++c)
          for (std::size_t k = 0; k < width; ++k) sums[c][k] += row[k] * sh[i][c];
      }
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < std::min(width, size - t); ++k) coarse[c * size + t + k] += sums[c][k];
    }
  }

 private:
  static constexpr std::size_t width = 8;  ///< so many sums of three channels stay in registers

  std::size_t count_;
  std::vector<float> matrix_;           ///< [coarse coefficient / width][i][coarse coefficient % width]
  std::vector<std::uint32_t> indices_;  ///< of the coarse coefficients in the whole cube map
};

/// Rows of consecutive slots.
struct SlotRows {
  haar::SparseRow entries;
  std::vector<std::size_t> ends;  ///< [slot][channel], into the entries
};

/// Where a slot's transfer comes from: texel by texel, and by way of SH.
struct HaarSources {
  const TexelTransfer* direct;  ///< what comes straight; nullptr: that comes by way of SH, too
  const SlotTransfer& transfer;
  std::span<const float> rows;    ///< [slot][3][column] of `transfer`, of one side
  std::span<const float> fitted;  ///< the front's solution, where `direct` is of it
  const Baseline* baseline;       ///< of that solution

  int channels() const { return direct != nullptr ? transfer.channels() : 3; }
};

class RowMaker {
 public:
  RowMaker(const HaarSources& sources, int faceSize, double error)
      : sources_(sources), faceSize_(faceSize), error_(error) {
    if (sources.channels() > 1) shToHaar_.emplace(sources.transfer.order, faceSize);
  }

  void make(std::size_t begin, std::size_t end, SlotRows& rows) const {
    const auto channels = static_cast<std::size_t>(sources_.channels());
    const std::vector<std::uint32_t> varying =
        shToHaar_ ? shToHaar_->indices() : std::vector<std::uint32_t>{};
    haar::RowCutter cutter(cubeTexelCount(faceSize_), varying);
    std::optional<TexelTransfer::Workspace> work;
    if (sources_.direct != nullptr) work.emplace(sources_.direct->workspace());
    std::vector<float> shared(cubeTexelCount(faceSize_)), own(channels * varying.size());
    rows.entries.indices.clear();
    rows.entries.values.clear();
    rows.ends.clear();
    for (std::size_t s = begin; s < end; ++s) {
      if (work) {
        sources_.direct->evaluate(static_cast<std::uint32_t>(s), *work, shared);
        haar::forward(std::span(shared), faceSize_);
      }
      for (std::size_t k = 0, n = varying.size(); k < n; ++k)
        for (std::size_t c = 0; c < channels; ++c) own[c * n + k] = shared[varying[k]];
      if (shToHaar_) shToHaar_->add(bounced(s), own);
      for (const std::uint32_t i : varying) shared[i] = 0.0f;
      cutter.cut(shared, own, channels, error_, rows.entries, rows.ends);
    }
  }

 private:
  /// SH coefficients of what comes by way of SH in a slot: [i][channel].
  std::vector<std::array<float, 3>> bounced(std::size_t slot) const {
    const SlotTransfer& transfer = sources_.transfer;
    std::vector<std::array<float, 3>> sh(transfer.shColumns());
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < sh.size(); ++i) {
        sh[i][c] = sources_.rows[(slot * 3 + c) * transfer.columns() + i];
        if (sources_.direct != nullptr)
          sh[i][c] -= directTransfer(*sources_.baseline, sources_.fitted, slot, i);
      }
    return sh;
  }

  HaarSources sources_;
  int faceSize_;
  double error_;
  std::optional<ShToHaar> shToHaar_;
};

/// The transfer as it grows, vertex by vertex. Vertices of one slot have the same rows.
class HaarAssembly {
 public:
  HaarAssembly(const FitMesh& mesh, HaarTransfer& haar)
      : mesh_(mesh), haar_(haar), channels_(static_cast<std::size_t>(haar.channels)) {}

  /// Appends the vertices up to the first one of the slot after the last of `rows`.
  void add(std::uint32_t firstSlot, const SlotRows& rows) {
    const std::size_t slots = rows.ends.size() / channels_;
    const std::uint32_t end =
        firstSlot + slots < mesh_.slotCount() ? mesh_.vertexOfSlot[firstSlot + slots] : vertexCount();
    for (std::size_t row = 0; vertices_ < end; ++vertices_) {
      const std::uint32_t first = mesh_.vertexOfSlot[mesh_.slotOfVertex[vertices_]];
      for (std::size_t c = 0; c < channels_; ++c) first == vertices_ ? append(rows, row++) : repeat(first, c);
    }
  }

  /// Asks for memory at once, as if the other vertices had as many entries as those so far, and a few more:
  /// where it grows bit by bit, it is copied as often.
  void reserve() {
    const double share = static_cast<double>(vertexCount()) / std::max(1u, vertices_);
    const auto entries = static_cast<std::size_t>(1.05 * share * static_cast<double>(haar_.indices.size()));
    haar_.indices.reserve(entries);
    haar_.values.reserve(entries);
  }

  /// Keeps the transfer, and takes it up again.
  template <typename State>
  void exchange(State& state) {
    state.growing(haar_.offsets);
    state.growing(haar_.indices);
    state.growing(haar_.values);
    state.check([&] { return isWhole(); });
    state.requireFinite(haar_.values);
    vertices_ = static_cast<std::uint32_t>((haar_.offsets.size() - 1) / channels_);
    state.require(vertices_ <= vertexCount());
  }

 private:
  std::uint32_t vertexCount() const { return static_cast<std::uint32_t>(mesh_.slotOfVertex.size()); }

  /// Rows are those of whole vertices, and lie within the entries.
  bool isWhole() const {
    const std::vector<std::uint32_t>& offsets = haar_.offsets;
    const auto texels = static_cast<std::uint32_t>(cubeTexelCount(haar_.faceSize));
    return !offsets.empty() && offsets.front() == 0 && offsets.back() == haar_.indices.size() &&
           haar_.indices.size() == haar_.values.size() && std::is_sorted(offsets.begin(), offsets.end()) &&
           (offsets.size() - 1) % channels_ == 0 &&
           std::all_of(haar_.indices.begin(), haar_.indices.end(),
                       [&](std::uint32_t i) { return i < texels; });
  }

  void append(const SlotRows& rows, std::size_t row) {
    const auto begin = static_cast<std::ptrdiff_t>(row > 0 ? rows.ends[row - 1] : 0),
               end = static_cast<std::ptrdiff_t>(rows.ends[row]);
    const haar::SparseRow& from = rows.entries;
    haar_.indices.insert(haar_.indices.end(), from.indices.begin() + begin, from.indices.begin() + end);
    haar_.values.insert(haar_.values.end(), from.values.begin() + begin, from.values.begin() + end);
    endRow();
  }

  void repeat(std::uint32_t vertex, std::size_t channel) {
    const std::size_t begin = haar_.offsets[vertex * channels_ + channel],
                      end = haar_.offsets[vertex * channels_ + channel + 1], at = haar_.indices.size();
    haar_.indices.resize(at + end - begin);
    haar_.values.resize(at + end - begin);
    std::copy_n(&haar_.indices[begin], end - begin, &haar_.indices[at]);
    std::copy_n(&haar_.values[begin], end - begin, &haar_.values[at]);
    endRow();
  }

  void endRow() {
    if (haar_.indices.size() > 0xffffffffull)
      throw Error(ExitCode::OutOfMemory, "HaarRequest::size",
                  "the wavelet transfer has more than 2^32 coefficients",
                  "use a smaller face size or a larger HaarRequest::error");
    haar_.offsets.push_back(static_cast<std::uint32_t>(haar_.indices.size()));
  }

  const FitMesh& mesh_;
  HaarTransfer& haar_;
  std::size_t channels_;
  std::uint32_t vertices_ = 0;
};

HaarTransfer assemble(const FitMesh& mesh, const HaarSources& sources, const HaarRequest& request,
                      Progress& progress) {
  HaarTransfer haar{request.size, sources.channels(), sources.transfer.bounces, {0}, {}, {}};
  HaarAssembly assembly(mesh, haar);
  std::uint32_t first = 0;
  WorkPart part(progress, "haar", [&](auto& state) {
    state.value(first);
    assembly.exchange(state);
    state.require(first % slotGrain == 0 || first == mesh.slotCount());
  });
  if (first > 0) assembly.reserve();
  const RowMaker maker(sources, request.size, request.error);
  // Slots part by part, so that a user can stop in between and the memory of a part serves the next.
  std::vector<SlotRows> ranges(partSize / slotGrain);
  Pace pace(std::min<std::size_t>(slotGrain * hardwareThreads(), partSize), partSize);
  while (first < mesh.slotCount()) {
    progress.check();
    const auto count = static_cast<std::uint32_t>(pace.next(mesh.slotCount() - first));
    parallelRanges(count, slotGrain, [&](std::size_t begin, std::size_t end) {
      maker.make(first + begin, first + end, ranges[begin / slotGrain]);
    });
    for (std::uint32_t begin = 0; begin < count; begin += slotGrain)
      assembly.add(first + begin, ranges[begin / slotGrain]);
    if (first == 0) assembly.reserve();
    first += count;
    part.advance();
    progress.report("haar", double(first) / mesh.slotCount());
  }
  part.finish();
  return haar;
}

}  // namespace

HaarTransfer makeHaarTransfer(const FitMesh& mesh, const TexelTransfer& direct, const Baseline& baseline,
                              const SlotTransfer& transfer, std::span<const float> fitted,
                              const HaarRequest& request, Progress& progress) {
  return assemble(mesh, {&direct, transfer, transfer.total, fitted, &baseline}, request, progress);
}

HaarTransfer makeThroughHaar(const FitMesh& mesh, const SlotTransfer& transfer, std::span<const float> rows,
                             const HaarRequest& request, Progress& progress) {
  return assemble(mesh, {nullptr, transfer, rows, {}, nullptr}, request, progress);
}

}  // namespace prelight
