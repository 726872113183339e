#include "projectors/bounce.h"

#include <algorithm>

#include "projectors/stored_rows.h"

namespace prelight {

void sendTransfer(const FitMesh& mesh, Caster& caster, const std::vector<float>& fronts,
                  const std::vector<float>& backs) {
  constexpr std::size_t part = 16384;  // vertices: the whole need not be in memory twice
  const std::size_t columns = fronts.size() / mesh.slotCount(), vertices = mesh.slotOfVertex.size();
  caster.resizeTransfer(vertices * columns * (backs.empty() ? 1 : 2));
  std::vector<float> rows;
  const auto send = [&](const std::vector<float>& slots, std::size_t offset) {
    for (std::size_t first = 0; first < vertices; first += part) {
      const std::size_t count = std::min(part, vertices - first);
      rows.resize(count * columns);
      for (std::size_t v = 0; v < count; ++v)
        std::copy_n(&slots[mesh.slotOfVertex[first + v] * columns], columns, &rows[v * columns]);
      caster.setTransfer(rows, (offset + first) * columns);
    }
  };
  send(fronts, 0);
  if (!backs.empty()) send(backs, vertices);
}

std::vector<float> receiveTransfer(Caster& caster, const SideCast& side, std::size_t columns,
                                   Progress& progress) {
  return fitStoredRows(
      caster, side, columns,
      [&](std::uint32_t first, std::uint32_t count, std::vector<float>& values) {
        caster.gather(side.storedFirst() + first, count, values);
      },
      progress);
}

}  // namespace prelight
