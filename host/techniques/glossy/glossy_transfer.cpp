#include "techniques/glossy/glossy_transfer.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "base/clocks.h"
#include "base/kept_work.h"
#include "base/parallel.h"
#include "basis/sh.h"
#include "techniques/stored_rows.h"

namespace prelight {

namespace {

/// Columns of the light that are gathered at once: what a fit holds in memory is these times order^2.
constexpr std::size_t lightColumns = 4;
constexpr std::size_t matrixGrain = 64;  // that a thread takes at once

/// Sets what comes straight, [slot][channel][i][j].
void setDirect(const FitMesh& mesh, const Baseline& baseline, const std::vector<float>& fitted, int order,
               int channels, std::vector<float>& matrices, const Progress& progress) {
  const int transferOrder = 2 * order - 1;
  const std::size_t n = static_cast<std::size_t>(order * order), columns = baseline.columns();
  const std::size_t width = static_cast<std::size_t>(channels) * n * n;
  const sh::ShProduct product(order, transferOrder);
  const auto setSlots = [&](std::size_t begin, std::size_t end) {
    std::vector<double> transfer(static_cast<std::size_t>(transferOrder * transferOrder)), matrix(n * n);
    for (std::size_t s = begin; s < end; ++s) {
      for (std::size_t k = 0; k < transfer.size(); ++k)
        transfer[k] = baseline.value(s, 1 + k) + fitted[s * columns + 1 + k];
      product.matrix(transfer, matrix);
      for (int c = 0; c < channels; ++c)
        std::transform(matrix.begin(), matrix.end(),
                       &matrices[s * width + static_cast<std::size_t>(c) * n * n],
                       [](double v) { return static_cast<float>(v); });
    }
  };
  std::uint64_t done = 0;
  WorkPart part(progress, "straight", [&](auto& state) {
    state.value(done);
    state.growing(matrices, done * width);
    state.requireFinite(matrices);
  });
  Pace pace(matrixGrain * hardwareThreads(), mesh.slotCount());
  while (done < mesh.slotCount()) {
    progress.check();
    const std::size_t count = pace.next(mesh.slotCount() - done);
    parallelRanges(count, matrixGrain,
                   [&](std::size_t begin, std::size_t end) { setSlots(done + begin, done + end); });
    done += count;
    part.advance();
  }
  part.finish();
}

/// Device transfer of some columns of the light, [vertex][3][column] and then the backs.
std::vector<float> partOf(const CompiledScene& scene, const FitMesh& mesh, const SlotTransfer& transfer,
                          std::size_t first) {
  const bool backs = !transfer.backReflected.empty();
  std::vector<float> part(std::size_t{scene.vertexCount()} * 3 * lightColumns * (backs ? 2 : 1), 0.0f);
  const auto fill = [&](const std::vector<float>& slots, float* out) {
    for (std::size_t v = 0; v < scene.vertexCount(); ++v)
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t j = 0; j < lightColumns && first + j < transfer.shColumns(); ++j)
          out[(v * 3 + c) * lightColumns + j] =
              slots[(mesh.slotOfVertex[v] * 3 + c) * transfer.columns() + first + j];
  };
  fill(transfer.reflected, part.data());
  if (backs) fill(transfer.backReflected, part.data() + part.size() / 2);
  return part;
}

/// Fits the rows of a gather to the slots: [slot][i][3][column].
std::vector<float> fitPart(const GlossySource& source, const StoredRows& rows, int order,
                           Progress& progress) {
  const std::size_t width = static_cast<std::size_t>(order * order) * 3 * lightColumns;
  return rows.fit(
      width, source.transport->blockSize(),
      [&](std::uint32_t first, std::uint32_t count, std::vector<float>& values) {
        const auto& receivers = source.receivers.receiversOn(source.front.sums());
        source.transport->gatherGlossy(source.caster, std::span(receivers).subspan(first, count),
                                       source.front.storedFirst() + first, order, lightColumns, values);
      },
      progress);
}

/// What some columns of the light have in the matrices, [slot][channel][i][column]: calls use(place in that,
/// value of the matrices).
template <typename Use>
void forColumns(std::size_t slots, std::size_t n, std::size_t first, std::vector<float>& matrices,
                const Use& use) {
  for (std::size_t row = 0; row < slots * 3 * n; ++row)
    for (std::size_t j = 0; j < lightColumns && first + j < n; ++j)
      use(row * lightColumns + j, matrices[row * n + first + j]);
}

/// Keeps the columns that are done, and takes them up again.
template <typename State>
void exchange(State& state, std::size_t slots, std::size_t n, std::uint64_t& done,
              std::vector<float>& matrices) {
  const std::size_t size = slots * 3 * n * lightColumns;
  state.value(done);
  state.require(done <= (n + lightColumns - 1) / lightColumns);
  std::vector<float> blocks;
  if constexpr (std::is_same_v<State, StateWriter>) {
    state.growing(0, done, size * sizeof(float), [&](std::uint64_t first, std::uint64_t count) {
      blocks.assign(count * size, 0.0f);
      for (std::uint64_t i = 0; i < count; ++i)
        forColumns(slots, n, (first + i) * lightColumns, matrices,
                   [&](std::size_t place, float& value) { blocks[i * size + place] = value; });
      return std::as_bytes(std::span(blocks));
    });
  } else {
    state.growing(done, size * sizeof(float), [&](std::uint64_t first, std::span<const std::byte> bytes) {
      blocks.resize(bytes.size() / sizeof(float));
      std::memcpy(blocks.data(), bytes.data(), bytes.size());
      state.requireFinite(blocks);
      for (std::uint64_t i = 0; i < blocks.size() / size; ++i)
        forColumns(slots, n, (first + i) * lightColumns, matrices,
                   [&](std::size_t place, float& value) { value = blocks[i * size + place]; });
    });
  }
}

}  // namespace

std::vector<float> makeGlossyMatrices(const CompiledScene& scene, const FitMesh& mesh,
                                      const GlossySource& source, const std::vector<float>& fitted,
                                      const SlotTransfer& transfer, int order, Progress& progress) {
  const auto n = static_cast<std::size_t>(order * order);
  const int channels = transfer.channels();
  std::vector<float> matrices(std::size_t{mesh.slotCount()} * static_cast<std::size_t>(channels) * n * n);
  setDirect(mesh, source.baseline, fitted, order, channels, matrices, progress);
  if (transfer.reflected.empty()) return matrices;
  const StoredRows rows(*source.transport, source.front);
  std::uint64_t done = 0;  // of lightColumns
  WorkPart kept(progress, "reflected",
                [&](auto& state) { exchange(state, mesh.slotCount(), n, done, matrices); });
  while (done * lightColumns < n) {
    const std::size_t first = done * lightColumns;
    const std::vector<float> sent = partOf(scene, mesh, transfer, first);
    source.transport->resizeTransfer(sent.size());
    source.transport->setTransfer(sent);
    const std::vector<float> part = fitPart(source, rows, order, progress);
    for (std::size_t s = 0; s < mesh.slotCount(); ++s)
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < 3; ++c)
          for (std::size_t j = 0; j < lightColumns && first + j < n; ++j)
            matrices[((s * 3 + c) * n + i) * n + first + j] += part[((s * n + i) * 3 + c) * lightColumns + j];
    ++done;
    kept.advance();
    progress.report("glossy", double(std::min(n, first + lightColumns)) / double(n));
  }
  kept.finish();
  return matrices;
}

}  // namespace prelight
