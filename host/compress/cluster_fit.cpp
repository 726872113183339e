#include "compress/cluster_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <random>

#include "base/parallel.h"

namespace prelight {

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Eigen::Index;

constexpr std::size_t rowGrain = 256;

/// Orthonormal rows that span the directions in which a covariance is greatest, greatest first.
Rows principalAxes(const Eigen::MatrixXd& covariance, Index count) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  return solver.eigenvectors().rightCols(count).rowwise().reverse().transpose();
}

/// A few rounds of subspace iteration from axes that were good a moment ago, which cost far less than an
/// eigenvalue problem. The variance along the axes never falls (Rayleigh-Ritz in a nested power of the
/// covariance).
Rows improvedAxes(const Eigen::MatrixXd& covariance, const Rows& axes) {
  constexpr int rounds = 3;
  Eigen::MatrixXd columns = axes.transpose();
  for (int round = 0; round < rounds; ++round) {
    const Eigen::MatrixXd image = covariance * columns;
    if (!(image.colwise().norm().minCoeff() > 0.0)) return axes;
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(image);
    columns = qr.householderQ() * Eigen::MatrixXd::Identity(image.rows(), image.cols());
  }
  return columns.transpose();
}

class Fitter {
 public:
  Fitter(std::span<const float> vectors, std::size_t dimension, std::span<const double> weights,
         const ClusterRequest& request)
      : request_(request), weights_(weights), random_(request.seed) {
    const auto count = static_cast<Index>(vectors.size() / dimension);
    points_ = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
                  vectors.data(), count, static_cast<Index>(dimension))
                  .cast<double>();
    centre_ = points_.colwise().mean();  // differences of large numbers are taken once, here
    points_.rowwise() -= centre_;
    squares_ = points_.rowwise().squaredNorm();
    clusters_ = std::min<Index>(request.clusters, count);
    clusterOf_.assign(static_cast<std::size_t>(count), 0);
    errors_.assign(static_cast<std::size_t>(count), 0.0);
  }

  ClusterFit fit() {
    seedMeans();
    setComponents(0);
    assign();
    iterate();
    for (Index k = 1; request_.components > 0; k *= 2) {
      setComponents(std::min<Index>(k, request_.components));
      update(true);
      assign();
      iterate();
      if (components_ == request_.components) break;
    }
    update(true);
    return store();
  }

 private:
  double weightOf(std::size_t point) const { return weights_.empty() ? 1.0 : weights_[point]; }
  Index members(Index cluster) const {
    return static_cast<Index>(members_[static_cast<std::size_t>(cluster)].size());
  }
  Rows axesOf(Index cluster) const { return basis_.middleRows(cluster * components_, components_); }

  void seedMeans();
  void setComponents(Index count);
  void assign();
  void assignRows(std::size_t begin, std::size_t end, const Rows& table, const Eigen::VectorXd& constants);
  void update(bool exact);
  void updateCluster(Index cluster, bool exact);
  void reseedEmpty();
  void iterate();
  ClusterFit store();
  double total() const;

  const ClusterRequest request_;
  const std::span<const double> weights_;
  std::mt19937_64 random_;
  Rows points_;  ///< [vector][dimension], less centre_
  Eigen::RowVectorXd centre_;
  Eigen::VectorXd squares_;
  Index clusters_ = 1, components_ = 0;
  Rows means_;  ///< [cluster][dimension]
  Rows basis_;  ///< [cluster * components + component][dimension]
  std::vector<std::uint32_t> clusterOf_;
  std::vector<double> errors_;  ///< [vector], squared, of its reconstruction
  std::vector<std::vector<Index>> members_;
  ClusterFit result_;
};

/// k-means++: each next mean is a vector drawn by weight x squared distance to the nearest mean so far.
void Fitter::seedMeans() {
  const Index count = points_.rows();
  means_.resize(clusters_, points_.cols());
  means_.row(0).setZero();
  basis_.resize(0, points_.cols());  // no axes yet, of as many numbers as there will be
  if (clusters_ == 1) return;
  Eigen::VectorXd distances = Eigen::VectorXd::Constant(count, 1.0);
  for (Index k = 0; k < clusters_; ++k) {
    double sum = 0.0;
    for (Index v = 0; v < count; ++v) sum += weightOf(static_cast<std::size_t>(v)) * distances[v];
    double wanted = std::uniform_real_distribution<double>(0.0, sum)(random_);
    Index chosen = 0;
    for (Index v = 0; v < count; ++v) {
      const double mass = weightOf(static_cast<std::size_t>(v)) * distances[v];
      if (mass > 0.0) chosen = v;
      wanted -= mass;
      if (wanted < 0.0) break;
    }
    means_.row(k) = points_.row(chosen);
    const Eigen::VectorXd next = (points_.rowwise() - means_.row(k)).rowwise().squaredNorm();
    distances = k == 0 ? next : distances.cwiseMin(next).eval();
  }
}

/// Keeps the axes that there are; new ones are zero until the next update.
void Fitter::setComponents(Index count) {
  Rows next = Rows::Zero(clusters_ * count, points_.cols());
  const Index kept = std::min(count, components_);
  for (Index k = 0; k < clusters_; ++k)
    next.middleRows(k * count, kept) = basis_.middleRows(k * components_, kept);
  basis_ = std::move(next);
  components_ = count;
}

/// Every vector goes to the cluster that reconstructs it best; the first of equals. With orthonormal axes
/// |x - m|^2 - sum_j ((x - m) . b_j)^2 = |x|^2 - 2 x.m + |m|^2 - sum_j (x.b_j - m.b_j)^2: products of
/// matrices.
void Fitter::assign() {
  const Index stride = 1 + components_;
  Rows table(clusters_ * stride, points_.cols());
  Eigen::VectorXd constants(clusters_ * stride);
  for (Index k = 0; k < clusters_; ++k) {
    table.row(k * stride) = means_.row(k);
    table.middleRows(k * stride + 1, components_) = axesOf(k);
    constants[k * stride] = means_.row(k).squaredNorm();
    constants.segment(k * stride + 1, components_) = axesOf(k) * means_.row(k).transpose();
  }
  parallelRanges(static_cast<std::size_t>(points_.rows()), rowGrain,
                 [&](std::size_t begin, std::size_t end) { assignRows(begin, end, table, constants); });
  members_.assign(static_cast<std::size_t>(clusters_), {});
  for (std::size_t v = 0; v < clusterOf_.size(); ++v)
    members_[clusterOf_[v]].push_back(static_cast<Index>(v));
}

void Fitter::assignRows(std::size_t begin, std::size_t end, const Rows& table,
                        const Eigen::VectorXd& constants) {
  const Index stride = 1 + components_;
  const Rows products =
      points_.middleRows(static_cast<Index>(begin), static_cast<Index>(end - begin)) * table.transpose();
  for (std::size_t v = begin; v < end; ++v) {
    const double* row = products.data() + static_cast<Index>(v - begin) * products.cols();
    double best = std::numeric_limits<double>::infinity();
    for (Index k = 0; k < clusters_; ++k) {
      double error = squares_[static_cast<Index>(v)] - 2.0 * row[k * stride] + constants[k * stride];
      for (Index j = 1; j < stride; ++j) {
        const double along = row[k * stride + j] - constants[k * stride + j];
        error -= along * along;
      }
      if (error < best) {
        best = error;
        clusterOf_[v] = static_cast<std::uint32_t>(k);
      }
    }
    errors_[v] = std::max(0.0, best);
  }
}

/// A cluster that nobody chose takes the vector that is reconstructed worst.
void Fitter::reseedEmpty() {
  for (Index k = 0; k < clusters_; ++k) {
    if (members(k) > 0) continue;
    std::size_t worst = 0;
    for (std::size_t v = 1; v < errors_.size(); ++v)
      if (weightOf(v) * errors_[v] > weightOf(worst) * errors_[worst]) worst = v;
    if (!(weightOf(worst) * errors_[worst] > 0.0)) return;
    auto& former = members_[clusterOf_[worst]];
    former.erase(std::find(former.begin(), former.end(), static_cast<Index>(worst)));
    members_[static_cast<std::size_t>(k)].push_back(static_cast<Index>(worst));
    clusterOf_[worst] = static_cast<std::uint32_t>(k);
    errors_[worst] = 0.0;
  }
}

void Fitter::update(bool exact) {
  reseedEmpty();
  parallelRanges(static_cast<std::size_t>(clusters_), 1,
                 [&](std::size_t k, std::size_t) { updateCluster(static_cast<Index>(k), exact); });
}

void Fitter::updateCluster(Index cluster, bool exact) {
  const auto& rows = members_[static_cast<std::size_t>(cluster)];
  if (rows.empty()) return;
  double weight = 0.0;
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(points_.cols());
  for (const Index v : rows) {
    weight += weightOf(static_cast<std::size_t>(v));
    sum += weightOf(static_cast<std::size_t>(v)) * points_.row(v);
  }
  if (!(weight > 0.0)) return;  // only vectors that do not count
  means_.row(cluster) = sum / weight;
  if (components_ == 0) return;

  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(points_.cols(), points_.cols());
  for (std::size_t first = 0; first < rows.size(); first += rowGrain) {
    const std::size_t count = std::min(rowGrain, rows.size() - first);
    Eigen::MatrixXd part(points_.cols(), static_cast<Index>(count));
    for (std::size_t i = 0; i < count; ++i) {
      const Index v = rows[first + i];
      part.col(static_cast<Index>(i)) = std::sqrt(weightOf(static_cast<std::size_t>(v))) *
                                        (points_.row(v) - means_.row(cluster)).transpose();
    }
    covariance.selfadjointView<Eigen::Lower>().rankUpdate(part);
  }
  covariance.triangularView<Eigen::StrictlyUpper>() = covariance.transpose();
  basis_.middleRows(cluster * components_, components_) =
      exact ? principalAxes(covariance, components_) : improvedAxes(covariance, axesOf(cluster));
}

double Fitter::total() const {
  double sum = 0.0;
  for (std::size_t v = 0; v < errors_.size(); ++v) sum += weightOf(v) * errors_[v];
  return sum;
}

void Fitter::iterate() {
  double before = total();
  result_.squaredErrors.push_back(before);
  for (int i = 0; i < request_.iterations && before > 0.0 && clusters_ > 1; ++i) {
    update(false);
    assign();
    const double now = total();
    result_.squaredErrors.push_back(now);
    if (now > before * (1.0 - 1e-4)) break;
    before = now;
  }
}

ClusterFit Fitter::store() {
  ClusterFit out = std::move(result_);
  const Rows means = means_.rowwise() + centre_;
  out.clusters = static_cast<int>(clusters_);
  out.components = static_cast<int>(components_);
  out.means.assign(means.data(), means.data() + means.size());
  out.basis.assign(basis_.data(), basis_.data() + basis_.size());
  out.clusterOf = clusterOf_;
  out.weights.resize(clusterOf_.size() * static_cast<std::size_t>(components_));
  for (std::size_t v = 0; v < clusterOf_.size(); ++v) {
    const Index k = clusterOf_[v];
    const Eigen::VectorXd along =
        axesOf(k) * (points_.row(static_cast<Index>(v)) - means_.row(k)).transpose();
    std::copy(along.begin(), along.end(),
              out.weights.begin() + static_cast<std::ptrdiff_t>(v * static_cast<std::size_t>(components_)));
  }
  return out;
}

}  // namespace

ClusterFit fitClusters(std::span<const float> vectors, std::size_t dimension, std::span<const double> weights,
                       const ClusterRequest& request) {
  assert(dimension > 0 && vectors.size() >= dimension && vectors.size() % dimension == 0);
  assert(static_cast<std::size_t>(request.components) <= dimension);
  assert(weights.empty() || weights.size() == vectors.size() / dimension);
  return Fitter(vectors, dimension, weights, request).fit();
}

}  // namespace prelight
