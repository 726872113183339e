#include "bake/normal_equations.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "base/parallel.h"

namespace prelight {

namespace {

constexpr std::size_t rowGrain = 1024;
constexpr std::size_t largestBlock =
    256;  // unknowns of a dense solve; a vertex with more around it stands alone

}  // namespace

/// Sum of the weights of a triangle's samples: barycentric weights sum to 1.
double totalWeight(const std::array<double, 6>& m) { return m[0] + m[1] + m[2] + 2.0 * (m[3] + m[4] + m[5]); }

NormalEquations::NormalEquations(const FitMesh& mesh, const std::vector<std::array<double, 6>>& mass,
                                 double lambda)
    : mesh_(mesh),
      diagonal_(mesh.slotCount(), 0.0),
      offDiagonal_(mesh.columns.size(), 0.0),
      edgeWeight_(mesh.columns.size(), 0.0),
      scale_(mesh.slotCount(), 0.0),
      lambda_(lambda) {
  for (std::size_t t = 0; t < mass.size(); ++t) {
    const auto& s = mesh.triangles[t];
    const auto& m = mass[t];
    const double weight = totalWeight(m);
    for (std::size_t k = 0; k < 3; ++k) {
      diagonal_[s[k]] += m[k];
      scale_[s[k]] += weight / 6.0;  // the mean of w b^2 over a triangle
      addEdge(s[k], s[(k + 1) % 3], m[3 + k], weight);
    }
  }
  scaleRegularizer();
}

void NormalEquations::apply(const std::vector<double>& x, std::vector<double>& y,
                            std::vector<double>& scratch, std::size_t columns) const {
  laplacian(x, scratch, columns);
  parallelRanges(rows(), rowGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double* out = &y[i * columns];
      const double own = edgeSum_[i] > 0.0 ? lambda_ * scale_[i] : 0.0;
      for (std::size_t c = 0; c < columns; ++c)
        out[c] = (diagonal_[i] + floor_) * x[i * columns + c] + own * scratch[i * columns + c];
      for (std::uint32_t e = mesh_.rowStart[i]; e < mesh_.rowStart[i + 1]; ++e) {
        const std::size_t j = mesh_.columns[e];
        const double transposed = transposed_[e];
        for (std::size_t c = 0; c < columns; ++c)
          out[c] += offDiagonal_[e] * x[j * columns + c] + transposed * scratch[j * columns + c];
      }
    }
  });
}

void NormalEquations::addEdge(std::uint32_t a, std::uint32_t b, double value, double weight) {
  if (a == b) {
    diagonal_[a] += 2.0 * value;
    return;
  }
  for (const std::size_t e : {find(a, b), find(b, a)}) {
    offDiagonal_[e] += value;
    edgeWeight_[e] += weight;
  }
}

std::size_t NormalEquations::find(std::uint32_t row, std::uint32_t column) const {
  const auto begin = mesh_.columns.begin() + mesh_.rowStart[row];
  const auto end = mesh_.columns.begin() + mesh_.rowStart[row + 1];
  return static_cast<std::size_t>(std::lower_bound(begin, end, column) - mesh_.columns.begin());
}

// S is what the diagonal would be with samples spread evenly, so that small and large triangles are
// smoothed alike and a slot whose few samples all lie far from it leans on its neighbours. The Laplacian
// weighs neighbours by the surface they share: a tiny triangle beside a large one must not be bent to make
// the large one smooth. Slots and edges without any sample get next to nothing, which makes them follow.
void NormalEquations::scaleRegularizer() {
  double mean = 0.0;
  for (const double s : scale_) mean += s;
  mean = rows() > 0 ? std::max(mean / static_cast<double>(rows()), 1e-300) : 1.0;
  floor_ = 1e-9 * mean;
  for (double& s : scale_) s = s > 0.0 ? s : mean;
  edgeSum_.assign(rows(), 0.0);
  for (std::size_t i = 0; i < rows(); ++i)
    for (std::uint32_t e = mesh_.rowStart[i]; e < mesh_.rowStart[i + 1]; ++e) {
      edgeWeight_[e] += floor_;
      edgeSum_[i] += edgeWeight_[e];
    }
  share_.resize(mesh_.columns.size());
  transposed_.resize(mesh_.columns.size());
  total_.resize(rows());
  for (std::size_t i = 0; i < rows(); ++i) {
    double regularizer = edgeSum_[i] > 0.0 ? scale_[i] : 0.0;
    for (std::uint32_t e = mesh_.rowStart[i]; e < mesh_.rowStart[i + 1]; ++e) {
      const std::size_t j = mesh_.columns[e];
      const double reverse = edgeWeight_[e] / edgeSum_[j];
      share_[e] = edgeWeight_[e] / edgeSum_[i];
      transposed_[e] = -lambda_ * scale_[j] * reverse;
      regularizer += scale_[j] * reverse * reverse;
    }
    total_[i] = diagonal_[i] + floor_ + lambda_ * regularizer;
  }
}

// y = x - weighted mean of x over the neighbours; 0 for a slot without neighbours.
void NormalEquations::laplacian(const std::vector<double>& x, std::vector<double>& y,
                                std::size_t columns) const {
  parallelRanges(rows(), rowGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double* out = &y[i * columns];
      for (std::size_t c = 0; c < columns; ++c) out[c] = edgeSum_[i] > 0.0 ? x[i * columns + c] : 0.0;
      for (std::uint32_t e = mesh_.rowStart[i]; e < mesh_.rowStart[i + 1]; ++e) {
        for (std::size_t c = 0; c < columns; ++c) out[c] -= share_[e] * x[mesh_.columns[e] * columns + c];
      }
    }
  });
}

double NormalEquations::rightSideOfOnes(std::size_t slot) const {
  double sum = diagonal_[slot];
  for (std::uint32_t e = mesh_.rowStart[slot]; e < mesh_.rowStart[slot + 1]; ++e) sum += offDiagonal_[e];
  return sum;
}

// Slots up to two edges away, one or none where there are too many; ascending.
std::vector<std::uint32_t> NormalEquations::around(std::uint32_t slot) const {
  std::vector<std::uint32_t> slots = {slot};
  for (int ring = 0; ring < 2; ++ring) {
    std::vector<std::uint32_t> wider = slots;
    for (const std::uint32_t s : slots)
      wider.insert(wider.end(), mesh_.columns.begin() + mesh_.rowStart[s],
                   mesh_.columns.begin() + mesh_.rowStart[s + 1]);
    std::sort(wider.begin(), wider.end());
    wider.erase(std::unique(wider.begin(), wider.end()), wider.end());
    if (wider.size() > largestBlock) break;
    slots = std::move(wider);
  }
  return slots;
}

// Entries of A + lambda L^T S L + floor among `slots`, which ascend; [row][column].
std::vector<double> NormalEquations::denseBlock(const std::vector<std::uint32_t>& slots) const {
  const std::size_t n = slots.size();
  std::vector<double> block(n * n, 0.0);
  const auto placeOf = [&](std::uint32_t slot) {
    const auto at = std::lower_bound(slots.begin(), slots.end(), slot);
    return at != slots.end() && *at == slot ? static_cast<std::ptrdiff_t>(at - slots.begin()) : -1;
  };
  std::vector<std::uint32_t> laplacians = slots;  // whose row of L touches one of them
  for (std::size_t i = 0; i < n; ++i) {
    block[i * n + i] += diagonal_[slots[i]] + floor_;
    for (std::uint32_t e = mesh_.rowStart[slots[i]]; e < mesh_.rowStart[slots[i] + 1]; ++e) {
      laplacians.push_back(mesh_.columns[e]);
      const std::ptrdiff_t j = placeOf(mesh_.columns[e]);
      if (j >= 0) block[i * n + static_cast<std::size_t>(j)] += offDiagonal_[e];
    }
  }
  std::sort(laplacians.begin(), laplacians.end());
  laplacians.erase(std::unique(laplacians.begin(), laplacians.end()), laplacians.end());
  std::vector<std::pair<std::size_t, double>> row;
  for (const std::uint32_t k : laplacians) {
    if (!(edgeSum_[k] > 0.0)) continue;
    row.clear();
    if (const std::ptrdiff_t own = placeOf(k); own >= 0) row.emplace_back(own, 1.0);
    for (std::uint32_t e = mesh_.rowStart[k]; e < mesh_.rowStart[k + 1]; ++e)
      if (const std::ptrdiff_t j = placeOf(mesh_.columns[e]); j >= 0) row.emplace_back(j, -share_[e]);
    for (const auto& [i, a] : row)
      for (const auto& [j, b] : row) block[i * n + j] += lambda_ * scale_[k] * a * b;
  }
  return block;
}

std::vector<SlotWeight> NormalEquations::inverseRow(std::uint32_t slot) const {
  const std::vector<std::uint32_t> slots = around(slot);
  const auto n = static_cast<Eigen::Index>(slots.size());
  const std::vector<double> block = denseBlock(slots);
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(n);
  unit[std::lower_bound(slots.begin(), slots.end(), slot) - slots.begin()] = 1.0;
  const Eigen::VectorXd row = Eigen::Map<const Eigen::MatrixXd>(block.data(), n, n).ldlt().solve(unit);
  double constant = 0.0;
  for (Eigen::Index i = 0; i < n; ++i)
    constant += row[i] * rightSideOfOnes(slots[static_cast<std::size_t>(i)]);
  // Weights that nearly cancel belong to a slot that no sample determines.
  if (!(constant > 1e-3)) return {};
  std::vector<SlotWeight> weights;
  for (Eigen::Index i = 0; i < n; ++i)
    weights.push_back({slots[static_cast<std::size_t>(i)], row[i] / constant});
  return weights;
}

}  // namespace prelight
