#include "projectors/bounce.h"

#include <algorithm>

namespace prelight {

namespace {

/// Device transfer, [vertex][3][n] and then the backs, from the slots' values.
void scatter(const FitMesh& mesh, const std::vector<float>& slots, std::size_t columns, float* out) {
  for (std::size_t v = 0; v < mesh.slotOfVertex.size(); ++v)
    for (std::size_t c = 0; c < columns; ++c)
      out[v * columns + c] = slots[mesh.slotOfVertex[v] * columns + c];
}

std::vector<float> fitRows(Caster& caster, const SideCast& cast, std::size_t columns, Progress& progress) {
  VertexFit fit = cast.emptyFit(columns);
  std::vector<float> values;
  std::vector<double> row(columns);
  for (std::uint32_t first = 0; first < cast.storedCount(); first += caster.blockSize()) {
    progress.check();
    const std::uint32_t count = std::min(caster.blockSize(), cast.storedCount() - first);
    caster.gather(cast.storedFirst() + first, count, values);
    for (std::uint32_t i = 0; i < count; ++i) {
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * columns), columns, row.begin());
      fit.add(cast.records()[first + i].sample, row);
    }
  }
  return fit.solve(defaultSmoothing);
}

}  // namespace

void bounceOnce(const CompiledScene& scene, const FitMesh& mesh, Caster& caster,
                std::size_t columnsPerChannel, BounceSide& front, BounceSide* back, Progress& progress) {
  const std::size_t columns = 3 * columnsPerChannel;
  std::vector<float> transfer(std::size_t{scene.vertexCount()} * columns * (back != nullptr ? 2 : 1));
  scatter(mesh, front.transfer, columns, transfer.data());
  if (back != nullptr)
    scatter(mesh, back->transfer, columns, transfer.data() + std::size_t{scene.vertexCount()} * columns);
  caster.setTransfer(transfer);
  front.transfer = fitRows(caster, *front.cast, columns, progress);
  if (back != nullptr) back->transfer = fitRows(caster, *back->cast, columns, progress);
}

}  // namespace prelight
