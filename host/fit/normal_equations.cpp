#include "fit/normal_equations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/parallel.h"
#include "fit/symmetric_solve.h"

namespace prelight {

namespace {

constexpr std::size_t rowsAtOnce = 1024;
// Relative to the mean diagonal; ties unknowns that samples barely determine to their neighbours.
constexpr double floor = 1e-9;
// Most unknowns of a dense solve. A vertex with more around it is solved alone.
constexpr std::size_t largestBlock = 256;

double surfaceWeight(std::span<const TriangleMass> mass, std::span<const float> unseen,
                     std::size_t triangle) {
  const double seen = totalWeight(mass[triangle]);
  return unseen.empty() ? seen : seen + double(unseen[triangle]);
}

/// Returns the diagonal that evenly spread samples would give, [slot]: a sixth of the weight in the adjacent
/// triangles, the mean of w b^2 over a triangle. It is 0 without samples.
std::vector<double> evenDiagonal(const FitMesh& mesh, std::span<const TriangleMass> mass,
                                 std::span<const float> unseen) {
  std::vector<double> scale(mesh.slotCount());
  parallelRanges(mesh.slotCount(), rowsAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s)
      for (std::uint32_t i = mesh.cornerStart[s]; i < mesh.cornerStart[s + 1]; ++i)
        scale[s] += surfaceWeight(mass, unseen, mesh.corners[i] / 3) / 6.0;
  });
  return scale;
}

}  // namespace

double totalWeight(const TriangleMass& m) {
  return double(m[0]) + m[1] + m[2] + 2.0 * (double(m[3]) + m[4] + m[5]);
}

NormalEquations::NormalEquations(const FitMesh& mesh, std::span<const TriangleMass> mass, double lambda,
                                 std::span<const double> stiffness, std::span<const float> unseen)
    : mesh_(mesh) {
  const std::vector<double> scale = evenDiagonal(mesh, mass, unseen);
  numberRows(scale);
  evenOutComponents(scale);
  assemble(mass, unseen);
  smooth(lambda, scale, stiffness);
}

void NormalEquations::numberRows(const std::vector<double>& scale) {
  rowOfSlot_.assign(mesh_.slotCount(), noRow);
  for (std::uint32_t s = 0; s < mesh_.slotCount(); ++s)
    if (scale[s] > 0.0) {
      rowOfSlot_[s] = static_cast<std::uint32_t>(slots_.size());
      slots_.push_back(s);
    }
}

// Scales the equations of each connected component of the surface to the same size, so that neither the floor
// nor the stopping criterion neglects small components beside large ones.
void NormalEquations::evenOutComponents(const std::vector<double>& scale) {
  std::vector<double> sums(mesh_.slotCount(), 0.0), counts(mesh_.slotCount(), 0.0);
  for (const std::uint32_t slot : slots_) {
    sums[mesh_.components[slot]] += scale[slot];
    counts[mesh_.components[slot]] += 1.0;
  }
  factors_.reserve(rows());
  for (const std::uint32_t slot : slots_)
    factors_.push_back(counts[mesh_.components[slot]] / sums[mesh_.components[slot]]);
}

void NormalEquations::assemble(std::span<const TriangleMass> mass, std::span<const float> unseen) {
  start_.assign(rows() + 1, 0);
  for (std::size_t row = 0; row < rows(); ++row) {
    start_[row + 1] = start_[row];
    for (std::uint32_t e = mesh_.rowStart[slots_[row]]; e < mesh_.rowStart[slots_[row] + 1]; ++e)
      start_[row + 1] += rowOfSlot_[mesh_.columns[e]] != noRow ? 1 : 0;
  }
  edges_.resize(start_.back());
  entries_.resize(rows());
  parallelRanges(rows(), rowsAtOnce, [&](std::size_t begin, std::size_t end) {
    std::vector<EdgeSums> sums;
    for (std::size_t row = begin; row < end; ++row) assembleRow(mass, unseen, row, sums);
  });
}

// The Laplacian weights neighbours by shared area, so that a tiny triangle beside a large one is not
// distorted to make the large one smooth.
void NormalEquations::assembleRow(std::span<const TriangleMass> mass, std::span<const float> unseen,
                                  std::size_t row, std::vector<EdgeSums>& sums) {
  const std::uint32_t slot = slots_[row], firstEdge = mesh_.rowStart[slot];
  sums.assign(mesh_.rowStart[slot + 1] - firstEdge, {});
  double diagonal = 0.0;
  const auto add = [&](std::uint32_t other, double value, double weight) {
    if (other == slot) {  // both ends of an edge share one slot
      diagonal += value;
      return;
    }
    std::uint32_t e = 0;
    while (mesh_.columns[firstEdge + e] != other) ++e;
    sums[e].value += value;
    sums[e].weight += weight;
  };
  for (std::uint32_t i = mesh_.cornerStart[slot]; i < mesh_.cornerStart[slot + 1]; ++i) {
    const std::size_t t = mesh_.corners[i] / 3, k = mesh_.corners[i] % 3, before = (k + 2) % 3;
    const double weight = surfaceWeight(mass, unseen, t);
    diagonal += mass[t][k];
    add(mesh_.triangles[t][(k + 1) % 3], mass[t][3 + k], weight);
    add(mesh_.triangles[t][before], mass[t][3 + before], weight);
  }
  const double factor = factors_[row];
  double edgeSum = 0.0;
  std::uint32_t edge = start_[row];
  for (std::uint32_t e = 0; e < sums.size(); ++e) {
    const std::uint32_t other = rowOfSlot_[mesh_.columns[firstEdge + e]];
    if (other == noRow) continue;
    edges_[edge] = {other, static_cast<float>(factor * sums[e].value),
                    static_cast<float>(factor * sums[e].weight + floor)};
    edgeSum += edges_[edge++].weight;
  }
  entries_[row].diagonal = static_cast<float>(factor * diagonal + floor);
  entries_[row].edgeSum = static_cast<float>(edgeSum);
}

// S is the even diagonal, so that small and large triangles are smoothed alike, and a slot whose few samples
// are all far from it follows its neighbours.
void NormalEquations::smooth(double lambda, const std::vector<double>& scale,
                             std::span<const double> stiffness) {
  const auto strength = [&](std::size_t row) {
    return lambda * factors_[row] * scale[slots_[row]] * (stiffness.empty() ? 1.0 : stiffness[slots_[row]]);
  };
  parallelRanges(rows(), rowsAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const double sum = entries_[row].edgeSum;
      entries_[row].pull = sum > 0.0 ? static_cast<float>(strength(row) / (sum * sum)) : 0.0f;
    }
  });
  parallelRanges(rows(), rowsAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const double sum = entries_[row].edgeSum;
      double diagonal = entries_[row].diagonal + entries_[row].pull * sum * sum;
      for (std::uint32_t e = start_[row]; e < start_[row + 1]; ++e)
        diagonal += double(entries_[edges_[e].row].pull) * edges_[e].weight * edges_[e].weight;
      entries_[row].inverseDiagonal = static_cast<float>(1.0 / diagonal);
    }
  });
}

std::vector<double> NormalEquations::laplacian(std::span<const float> x) const {
  std::vector<double> bending(mesh_.slotCount(), 0.0);
  parallelRanges(rows(), rowsAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      double sum = 0.0;
      for (std::uint32_t e = start_[row]; e < start_[row + 1]; ++e)
        sum += edges_[e].weight * (double(x[slots_[row]]) - x[slots_[edges_[e].row]]);
      if (entries_[row].edgeSum > 0.0f) bending[slots_[row]] = sum / entries_[row].edgeSum;
    }
  });
  return bending;
}

// Returns the rows up to two edges away, up to one or none where there are too many, ascending.
std::vector<std::uint32_t> NormalEquations::around(std::uint32_t row) const {
  std::vector<std::uint32_t> rows = {row};
  for (int ring = 0; ring < 2; ++ring) {
    std::vector<std::uint32_t> wider = rows;
    for (const std::uint32_t r : rows)
      for (std::uint32_t e = start_[r]; e < start_[r + 1]; ++e) wider.push_back(edges_[e].row);
    std::sort(wider.begin(), wider.end());
    wider.erase(std::unique(wider.begin(), wider.end()), wider.end());
    if (wider.size() > largestBlock) break;
    rows = std::move(wider);
  }
  return rows;
}

// Returns the entries of the operator among `rows`, which ascend, [row][column].
std::vector<double> NormalEquations::denseBlock(const std::vector<std::uint32_t>& rows) const {
  const std::size_t n = rows.size();
  std::vector<double> block(n * n, 0.0);
  const auto placeOf = [&](std::uint32_t row) {
    const auto at = std::lower_bound(rows.begin(), rows.end(), row);
    return at != rows.end() && *at == row ? static_cast<std::ptrdiff_t>(at - rows.begin()) : -1;
  };
  std::vector<std::uint32_t> laplacians = rows;  // rows of L that touch one of them
  for (std::size_t i = 0; i < n; ++i) {
    block[i * n + i] += entries_[rows[i]].diagonal;
    for (std::uint32_t e = start_[rows[i]]; e < start_[rows[i] + 1]; ++e) {
      laplacians.push_back(edges_[e].row);
      const std::ptrdiff_t j = placeOf(edges_[e].row);
      if (j >= 0) block[i * n + static_cast<std::size_t>(j)] += edges_[e].value;
    }
  }
  std::sort(laplacians.begin(), laplacians.end());
  laplacians.erase(std::unique(laplacians.begin(), laplacians.end()), laplacians.end());
  std::vector<std::pair<std::size_t, double>> row;
  for (const std::uint32_t k : laplacians) {
    row.clear();
    if (const std::ptrdiff_t own = placeOf(k); own >= 0) row.emplace_back(own, entries_[k].edgeSum);
    for (std::uint32_t e = start_[k]; e < start_[k + 1]; ++e)
      if (const std::ptrdiff_t j = placeOf(edges_[e].row); j >= 0) row.emplace_back(j, -edges_[e].weight);
    for (const auto& [i, a] : row)
      for (const auto& [j, b] : row) block[i * n + j] += entries_[k].pull * a * b;
  }
  return block;
}

// Returns the right-hand sides for the functions 1, x, y and z, used to correct rows so that linear
// functions are reproduced. Barycentric weights reproduce them exactly.
glm::dvec4 NormalEquations::rightSideOfLinear(std::uint32_t row) const {
  glm::dvec4 sum = double(entries_[row].diagonal) * glm::dvec4(1.0, mesh_.positions[slots_[row]]);
  for (std::uint32_t e = start_[row]; e < start_[row + 1]; ++e)
    sum += double(edges_[e].value) * glm::dvec4(1.0, mesh_.positions[slots_[edges_[e].row]]);
  return sum;
}

// Returns the right-hand sides for 1, x, y and z relative to `row`'s slot, and for a unit value in that row,
// [rows][rowSides].
std::vector<double> NormalEquations::rightSidesOfRow(const std::vector<std::uint32_t>& rows,
                                                     std::uint32_t row) const {
  const glm::dvec3 p = mesh_.positions[slots_[row]];
  std::vector<double> right;
  right.reserve(rows.size() * rowSides);
  for (const std::uint32_t r : rows) {
    const glm::dvec4 linear = rightSideOfLinear(r);
    // Positions are relative to the slot, so that nothing cancels far from the origin.
    right.insert(right.end(), {linear[0], linear[1] - p.x * linear[0], linear[2] - p.y * linear[0],
                               linear[3] - p.z * linear[0], r == row ? 1.0 : 0.0});
  }
  return right;
}

std::vector<SlotWeight> NormalEquations::inverseRow(std::uint32_t slot) const {
  return rowOfSlot_[slot] != noRow ? sampledRow(rowOfSlot_[slot]) : meanOfNeighbours(slot);
}

std::vector<SlotWeight> NormalEquations::meanOfNeighbours(std::uint32_t slot) const {
  std::map<std::uint32_t, double> sums;
  double count = 0.0;
  for (std::uint32_t e = mesh_.rowStart[slot]; e < mesh_.rowStart[slot + 1]; ++e) {
    const std::uint32_t row = rowOfSlot_[mesh_.columns[e]];
    if (row == noRow) continue;
    const std::vector<SlotWeight> weights = sampledRow(row);
    if (!weights.empty()) count += 1.0;
    for (const SlotWeight& w : weights) sums[w.slot] += w.weight;
  }
  std::vector<SlotWeight> mean;
  for (const auto& [other, sum] : sums) mean.push_back({other, sum / count});
  return mean;
}

// Returns the row z of the block's inverse, corrected to be exact for linear functions, as the whole inverse
// is except for the smoothing: with B the right-hand sides of 1, x, y, z, the row is z + A^-1 B c where B^T
// (z + A^-1 B c) = (1, x, y, z) of the slot.
std::vector<SlotWeight> NormalEquations::sampledRow(std::uint32_t row) const {
  const std::vector<std::uint32_t> rows = around(row);
  const std::vector<double> right = rightSidesOfRow(rows, row);
  std::vector<double> solved = right;
  SymmetricFactors(denseBlock(rows), 0.0).solve(solved, rowSides);
  std::array<double, 4> lacking = {1.0, 0.0, 0.0, 0.0};
  std::vector<double> gram(16, 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      lacking[k] -= right[i * rowSides + k] * solved[i * rowSides + 4];
      for (std::size_t l = 0; l < 4; ++l)
        gram[k * 4 + l] += right[i * rowSides + k] * solved[i * rowSides + l];
    }
  // Weights that nearly cancel mean that no sample determines the slot.
  if (!(lacking[0] < 1.0 - 1e-3)) return {};
  // On a plane, one direction of the linear functions is degenerate.
  SymmetricFactors(std::move(gram), 4.0 * std::numeric_limits<double>::epsilon()).solve(lacking, 1);
  std::vector<SlotWeight> weights;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double inverse = solved[i * rowSides + 4];
    for (std::size_t k = 0; k < 4; ++k) inverse += solved[i * rowSides + k] * lacking[k];
    if (!std::isfinite(inverse)) return {};
    weights.push_back({slots_[rows[i]], factors_[row] * inverse});  // right-hand sides are given unscaled
  }
  return weights;
}

}  // namespace prelight
