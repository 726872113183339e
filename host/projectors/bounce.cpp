#include "projectors/bounce.h"

#include "projectors/stored_rows.h"

namespace prelight {

namespace {

/// Device transfer, [vertex][3][n] and then the backs, from the slots' values.
void scatter(const FitMesh& mesh, const std::vector<float>& slots, std::size_t columns, float* out) {
  for (std::size_t v = 0; v < mesh.slotOfVertex.size(); ++v)
    for (std::size_t c = 0; c < columns; ++c)
      out[v * columns + c] = slots[mesh.slotOfVertex[v] * columns + c];
}

std::vector<float> fitRows(Caster& caster, const SideCast& side, std::size_t columns, Progress& progress) {
  return fitStoredRows(
      caster, side, columns,
      [&](std::uint32_t first, std::uint32_t count, std::vector<float>& values) {
        caster.gather(side.storedFirst() + first, count, values);
      },
      progress);
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
