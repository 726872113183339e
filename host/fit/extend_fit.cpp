#include "fit/extend_fit.h"

#include <algorithm>
#include <utility>

namespace prelight {

namespace {

constexpr int smoothings = 8;

/// Returns the waiting slots beside a sampled slot, ordered by the first such sampled slot, then by their own
/// index.
std::vector<std::uint32_t> firstRing(const FitMesh& mesh, const NormalEquations& equations,
                                     const std::vector<std::uint8_t>& waits) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ring;  // {sampled slot, waiting slot}
  for (std::uint32_t s = 0; s < mesh.slotCount(); ++s)
    for (std::uint32_t e = mesh.rowStart[s]; waits[s] != 0 && e < mesh.rowStart[s + 1]; ++e)
      if (equations.rowOf(mesh.columns[e]) != NormalEquations::noRow) {
        ring.emplace_back(mesh.columns[e], s);
        break;
      }
  std::sort(ring.begin(), ring.end());
  std::vector<std::uint32_t> slots;
  for (const auto& [sampled, slot] : ring) slots.push_back(slot);
  return slots;
}

/// Returns the slots without a row that need a value, ring by ring away from those with a row.
std::vector<std::uint32_t> ringsAround(const FitMesh& mesh, const NormalEquations& equations,
                                       std::span<const std::uint8_t> extent) {
  std::vector<std::uint8_t> waits(mesh.slotCount());
  for (std::uint32_t s = 0; s < mesh.slotCount(); ++s)
    waits[s] = equations.rowOf(s) == NormalEquations::noRow && (extent.empty() || extent[s] != 0);
  std::vector<std::uint32_t> order;
  const auto takeAround = [&](std::uint32_t slot) {
    for (std::uint32_t e = mesh.rowStart[slot]; e < mesh.rowStart[slot + 1]; ++e)
      if (waits[mesh.columns[e]] != 0) {
        waits[mesh.columns[e]] = 0;
        order.push_back(mesh.columns[e]);
      }
  };
  for (const std::uint32_t slot : firstRing(mesh, equations, waits)) {
    waits[slot] = 0;
    order.push_back(slot);
  }
  for (std::size_t i = 0; i < order.size(); ++i) takeAround(order[i]);
  return order;
}

}  // namespace

void extendFit(const FitMesh& mesh, const NormalEquations& equations, std::span<const std::uint8_t> extent,
               std::size_t columns, std::vector<float>& x) {
  const std::vector<std::uint32_t> order = ringsAround(mesh, equations, extent);
  if (order.empty()) return;
  std::vector<std::uint8_t> known(mesh.slotCount());
  for (std::uint32_t s = 0; s < mesh.slotCount(); ++s)
    known[s] = equations.rowOf(s) != NormalEquations::noRow;
  std::vector<double> sum(columns);
  for (int sweep = 0; sweep <= smoothings; ++sweep)
    for (const std::uint32_t slot : order) {
      std::fill(sum.begin(), sum.end(), 0.0);
      double count = 0.0;
      for (std::uint32_t e = mesh.rowStart[slot]; e < mesh.rowStart[slot + 1]; ++e) {
        const std::size_t other = mesh.columns[e];
        if (known[other] == 0) continue;
        count += 1.0;
        for (std::size_t c = 0; c < columns; ++c) sum[c] += x[other * columns + c];
      }
      for (std::size_t c = 0; c < columns; ++c) x[slot * columns + c] = static_cast<float>(sum[c] / count);
      known[slot] = 1;
    }
}

}  // namespace prelight
