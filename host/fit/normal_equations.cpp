#include "fit/normal_equations.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>

#include "base/parallel.h"

namespace prelight {

namespace {

constexpr std::size_t rowsAtOnce = 1024;
constexpr double floor = 1e-9;  // of the mean diagonal: what no sample and no neighbour determines is 0
constexpr std::size_t largestBlock =
    256;  // unknowns of a dense solve; a vertex with more around it stands alone

}  // namespace

/// Sum of the weights of a triangle's samples: barycentric weights sum to 1.
double totalWeight(const std::array<double, 6>& m) { return m[0] + m[1] + m[2] + 2.0 * (m[3] + m[4] + m[5]); }

NormalEquations::NormalEquations(const FitMesh& mesh, const std::vector<std::array<double, 6>>& mass,
                                 double lambda, const std::vector<double>& stiffness)
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
  evenOutComponents();
  for (std::size_t i = 0; i < stiffness.size(); ++i) scale_[i] *= stiffness[i];
  scaleRegularizer();
}

// Stretches of surface that do not touch have nothing to do with each other. Each is brought to the same
// scale, so that neither the floor nor the end of an iteration neglects a pebble on a plain.
void NormalEquations::evenOutComponents() {
  const std::vector<std::uint32_t> components = componentsOf(mesh_);
  std::vector<double> sums(rows(), 0.0), counts(rows(), 0.0);
  for (std::size_t i = 0; i < rows(); ++i) {
    sums[components[i]] += scale_[i];
    counts[components[i]] += 1.0;
  }
  factors_.resize(rows());
  for (std::size_t i = 0; i < rows(); ++i) {
    const double sum = sums[components[i]];
    factors_[i] = sum > 0.0 ? counts[components[i]] / sum : 1.0;
    diagonal_[i] *= factors_[i];
    scale_[i] *= factors_[i];
    for (std::uint32_t e = mesh_.rowStart[i]; e < mesh_.rowStart[i + 1]; ++e) {
      offDiagonal_[e] *= factors_[i];
      edgeWeight_[e] *= factors_[i];
    }
  }
}

void NormalEquations::apply(const std::vector<double>& x, std::vector<double>& y,
                            std::vector<double>& scratch, std::size_t columns) const {
  laplacian(x, scratch, columns);
  parallelRanges(rows(), rowsAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double* out = &y[i * columns];
      const double own = edgeSum_[i] > 0.0 ? lambda_ * scale_[i] : 0.0;
      for (std::size_t c = 0; c < columns; ++c)
        out[c] = (diagonal_[i] + floor) * x[i * columns + c] + own * scratch[i * columns + c];
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
  for (double& s : scale_) s = s > 0.0 ? s : 1.0;  // the mean of a component
  edgeSum_.assign(rows(), 0.0);
  for (std::size_t i = 0; i < rows(); ++i)
    for (std::uint32_t e = mesh_.rowStart[i]; e < mesh_.rowStart[i + 1]; ++e) {
      edgeWeight_[e] += floor;
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
    total_[i] = diagonal_[i] + floor + lambda_ * regularizer;
  }
}

void NormalEquations::laplacian(const std::vector<double>& x, std::vector<double>& y,
                                std::size_t columns) const {
  parallelRanges(rows(), rowsAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double* out = &y[i * columns];
      for (std::size_t c = 0; c < columns; ++c) out[c] = edgeSum_[i] > 0.0 ? x[i * columns + c] : 0.0;
      for (std::uint32_t e = mesh_.rowStart[i]; e < mesh_.rowStart[i + 1]; ++e) {
        for (std::size_t c = 0; c < columns; ++c) out[c] -= share_[e] * x[mesh_.columns[e] * columns + c];
      }
    }
  });
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
    block[i * n + i] += diagonal_[slots[i]] + floor;
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

// What samples of 1, x, y and z add to a slot's right-hand side: barycentric weights reproduce linear
// functions.
glm::dvec4 NormalEquations::rightSideOfLinear(std::size_t slot) const {
  glm::dvec4 sum = diagonal_[slot] * glm::dvec4(1.0, mesh_.positions[slot]);
  for (std::uint32_t e = mesh_.rowStart[slot]; e < mesh_.rowStart[slot + 1]; ++e)
    sum += offDiagonal_[e] * glm::dvec4(1.0, mesh_.positions[mesh_.columns[e]]);
  return sum;
}

// The row of the block's inverse, and what it takes to make it exact for linear functions, which the whole
// inverse is but for the smoothing: with B the right-hand sides of 1, x, y, z, the row z + A^-1 B c with B^T
// (z + A^-1 B c) = (1, x, y, z) of the slot.
std::vector<SlotWeight> NormalEquations::inverseRow(std::uint32_t slot) const {
  const std::vector<std::uint32_t> slots = around(slot);
  const auto n = static_cast<Eigen::Index>(slots.size());
  const std::vector<double> block = denseBlock(slots);
  Eigen::MatrixXd right(n, 5);
  right.col(4).setZero();
  right(std::lower_bound(slots.begin(), slots.end(), slot) - slots.begin(), 4) = 1.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const glm::dvec4 linear = rightSideOfLinear(slots[static_cast<std::size_t>(i)]);
    for (int k = 0; k < 4; ++k) right(i, k) = linear[k];
  }
  const glm::vec3 p = mesh_.positions[slot];
  // Around the slot, so that far from the origin nothing cancels.
  for (int axis = 0; axis < 3; ++axis) right.col(1 + axis) -= double(p[axis]) * right.col(0);
  const Eigen::MatrixXd solved = Eigen::Map<const Eigen::MatrixXd>(block.data(), n, n).ldlt().solve(right);
  const Eigen::Vector4d got = right.leftCols<4>().transpose() * solved.col(4);
  // Weights that nearly cancel belong to a slot that no sample determines.
  if (!(got[0] > 1e-3)) return {};
  const Eigen::Matrix4d gram = right.leftCols<4>().transpose() * solved.leftCols<4>();
  const Eigen::Vector4d lacking = Eigen::Vector4d(1.0, 0.0, 0.0, 0.0) - got;
  // On a plane one direction has nothing to it.
  const Eigen::Vector4d c = gram.completeOrthogonalDecomposition().solve(lacking);
  const Eigen::VectorXd row = solved.col(4) + solved.leftCols<4>() * c;
  std::vector<SlotWeight> weights;
  // Right-hand sides come unscaled.
  for (Eigen::Index i = 0; i < n; ++i)
    weights.push_back({slots[static_cast<std::size_t>(i)], factors_[slot] * row[i]});
  return weights;
}

}  // namespace prelight
