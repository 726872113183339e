#include "bake/vertex_fit.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace prelight {

namespace {

constexpr std::size_t rowGrain = 1024;
constexpr int maxIterations = 64;   // 10 to 25 do, but for stretches without samples, which nothing sees
constexpr double tolerance = 1e-6;  // of the residual's norm, below float and far below noise

/// Sum of the weights of a triangle's samples: barycentric weights sum to 1.
double totalWeight(const std::array<double, 6>& m) { return m[0] + m[1] + m[2] + 2.0 * (m[3] + m[4] + m[5]); }

/// The normal equations as a sparse matrix over the mesh's edges, applied to many columns at once.
class NormalEquations {
 public:
  NormalEquations(const FitMesh& mesh, const std::vector<std::array<double, 6>>& mass, double lambda)
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

  std::size_t rows() const { return diagonal_.size(); }

  /// Diagonal of the whole operator, for preconditioning; positive.
  double preconditioner(std::size_t row) const { return total_[row]; }

  /// y = (A + lambda L^T S L + floor) x, [slot][column]. `scratch` has the size of x.
  void apply(const std::vector<double>& x, std::vector<double>& y, std::vector<double>& scratch,
             std::size_t columns) const {
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

 private:
  void addEdge(std::uint32_t a, std::uint32_t b, double value, double weight) {
    if (a == b) {
      diagonal_[a] += 2.0 * value;
      return;
    }
    for (const std::size_t e : {find(a, b), find(b, a)}) {
      offDiagonal_[e] += value;
      edgeWeight_[e] += weight;
    }
  }

  std::size_t find(std::uint32_t row, std::uint32_t column) const {
    const auto begin = mesh_.columns.begin() + mesh_.rowStart[row];
    const auto end = mesh_.columns.begin() + mesh_.rowStart[row + 1];
    return static_cast<std::size_t>(std::lower_bound(begin, end, column) - mesh_.columns.begin());
  }

  // S is what the diagonal would be with samples spread evenly, so that small and large triangles are
  // smoothed alike and a slot whose few samples all lie far from it leans on its neighbours. The Laplacian
  // weighs neighbours by the surface they share: a tiny triangle beside a large one must not be bent to make
  // the large one smooth. Slots and edges without any sample get next to nothing, which makes them follow.
  void scaleRegularizer() {
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
  void laplacian(const std::vector<double>& x, std::vector<double>& y, std::size_t columns) const {
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

  const FitMesh& mesh_;
  std::vector<double> diagonal_;
  std::vector<double> offDiagonal_;  ///< parallel to mesh_.columns
  std::vector<double> edgeWeight_;   ///< parallel to mesh_.columns, symmetric
  std::vector<double> edgeSum_;      ///< [slot], of its edges' weights
  std::vector<double> share_;        ///< [edge], the Laplacian's entries
  std::vector<double> transposed_;   ///< [edge], -lambda x entries of its scaled transpose
  std::vector<double> scale_;
  std::vector<double> total_;
  double lambda_;
  double floor_ = 0.0;
};

/// Sum over slots of a[slot][c] b[slot][c] for every column, in an order that no thread count changes.
std::vector<double> columnDots(const std::vector<double>& a, const std::vector<double>& b,
                               std::size_t columns) {
  const std::size_t rows = a.size() / columns;
  const std::size_t ranges = (rows + rowGrain - 1) / rowGrain;
  std::vector<double> partial(ranges * columns, 0.0);
  parallelRanges(rows, rowGrain, [&](std::size_t begin, std::size_t end) {
    double* out = &partial[begin / rowGrain * columns];
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t c = 0; c < columns; ++c) out[c] += a[i * columns + c] * b[i * columns + c];
  });
  std::vector<double> sums(columns, 0.0);
  for (std::size_t r = 0; r < ranges; ++r)
    for (std::size_t c = 0; c < columns; ++c) sums[c] += partial[r * columns + c];
  return sums;
}

/// Preconditioned conjugate gradients with Jacobi's preconditioner, each column on its own step sizes.
std::vector<double> conjugateGradients(const NormalEquations& equations, const std::vector<double>& right,
                                       std::size_t columns) {
  std::vector<double> x(right.size(), 0.0), residual = right, direction(right.size()), image(right.size()),
                                            z(right.size()), scratch(right.size());
  const auto precondition = [&] {
    parallelRanges(equations.rows(), rowGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t c = 0; c < columns; ++c)
          z[i * columns + c] = residual[i * columns + c] / equations.preconditioner(i);
    });
  };
  precondition();
  direction = z;
  std::vector<double> rho = columnDots(residual, z, columns);
  const std::vector<double> start = rho;
  for (int iteration = 0; iteration < maxIterations; ++iteration) {
    bool done = true;
    for (std::size_t c = 0; c < columns; ++c) done = done && rho[c] <= tolerance * tolerance * start[c];
    if (done) break;
    equations.apply(direction, image, scratch, columns);
    const std::vector<double> curvature = columnDots(direction, image, columns);
    std::vector<double> step(columns);
    for (std::size_t c = 0; c < columns; ++c) step[c] = curvature[c] > 0.0 ? rho[c] / curvature[c] : 0.0;
    parallelRanges(equations.rows(), rowGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t c = 0; c < columns; ++c) {
          x[i * columns + c] += step[c] * direction[i * columns + c];
          residual[i * columns + c] -= step[c] * image[i * columns + c];
        }
    });
    precondition();
    const std::vector<double> next = columnDots(residual, z, columns);
    parallelRanges(equations.rows(), rowGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t c = 0; c < columns; ++c) {
          const double beta = rho[c] > 0.0 ? next[c] / rho[c] : 0.0;
          direction[i * columns + c] = z[i * columns + c] + beta * direction[i * columns + c];
        }
    });
    rho = next;
  }
  return x;
}

}  // namespace

VertexFit::VertexFit(const FitMesh& mesh, std::size_t columns)
    : mesh_(mesh), columns_(columns), mass_(mesh.triangles.size()), right_(mesh.slotCount() * columns, 0.0) {}

VertexFit::VertexFit(const FitMesh& mesh, std::size_t columns, std::vector<double> triangleWeights)
    : mesh_(mesh),
      columns_(columns),
      triangleWeights_(std::move(triangleWeights)),
      mass_(mesh.triangles.size()),
      right_(3 * mesh.triangles.size() * columns, 0.0) {}

void VertexFit::add(const SurfaceSample& sample, std::span<const double> values) {
  const std::array<double, 3> b{1.0 - double(sample.b1) - double(sample.b2), sample.b1, sample.b2};
  auto& mass = mass_[sample.triangle];
  for (std::size_t k = 0; k < 3; ++k) {
    mass[k] += sample.weight * b[k] * b[k];
    mass[3 + k] += sample.weight * b[k] * b[(k + 1) % 3];
    const std::size_t row =
        triangleWeights_.empty() ? mesh_.triangles[sample.triangle][k] : 3 * std::size_t{sample.triangle} + k;
    double* right = &right_[row * columns_];
    for (std::size_t c = 0; c < columns_; ++c) right[c] += sample.weight * b[k] * values[c];
  }
}

void VertexFit::save(StateWriter& state) const {
  state.values(mass_);
  state.values(right_);
}

void VertexFit::load(StateReader& state) {
  state.sameSize(mass_);
  state.sameSize(right_);
}

double VertexFit::scaleOf(std::size_t triangle) const {
  if (triangleWeights_.empty()) return 1.0;
  const double weight = totalWeight(mass_[triangle]);
  return weight > 0.0 ? triangleWeights_[triangle] / weight : 0.0;
}

std::vector<double> VertexFit::solve(double lambda) const {
  if (triangleWeights_.empty()) return solve(lambda, right_, columns_);
  std::vector<double> right(mesh_.slotCount() * columns_, 0.0);
  for (std::size_t t = 0; t < mass_.size(); ++t) {
    const double scale = scaleOf(t);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < columns_; ++c)
        right[mesh_.triangles[t][k] * columns_ + c] += scale * right_[(3 * t + k) * columns_ + c];
  }
  return solve(lambda, right, columns_);
}

std::vector<double> VertexFit::solve(double lambda, const std::vector<double>& rightSide,
                                     std::size_t columns) const {
  if (triangleWeights_.empty())
    return conjugateGradients(NormalEquations(mesh_, mass_, lambda), rightSide, columns);
  std::vector<std::array<double, 6>> mass = mass_;
  for (std::size_t t = 0; t < mass.size(); ++t) {
    const double scale = scaleOf(t);
    for (double& m : mass[t]) m *= scale;
  }
  return conjugateGradients(NormalEquations(mesh_, mass, lambda), rightSide, columns);
}

}  // namespace prelight
