#include "compress/cluster_fit.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <type_traits>

#include "base/clocks.h"
#include "base/kept_work.h"
#include "base/parallel.h"

namespace prelight {

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Eigen::Index;

constexpr std::size_t rowGrain = 256;

/// Returns orthonormal rows that span the directions of greatest variance, greatest first.
Rows principalAxes(const Eigen::MatrixXd& covariance, Index count) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  return solver.eigenvectors().rightCols(count).rowwise().reverse().transpose();
}

/// Improves axes of the previous iteration by a few rounds of subspace iteration, which cost far less than an
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
    centre_ = points_.colwise().mean();  // centred once, so that later differences are not of large numbers
    points_.rowwise() -= centre_;
    squares_ = points_.rowwise().squaredNorm();
    clusters_ = std::min<Index>(request.clusters, count);
    clusterOf_.assign(static_cast<std::size_t>(count), 0);
    errors_.assign(static_cast<std::size_t>(count), 0.0);
    means_ = Rows::Zero(clusters_, points_.cols());
    basis_.resize(0, points_.cols());  // no axes yet, but the right number of columns
  }

  ClusterFit fit() {
    const Progress nobody;
    const Progress& progress = request_.progress != nullptr ? *request_.progress : nobody;
    begin(Step::Seed);
    distances_.assign(errors_.size(), 1.0);
    const std::string name = fmt::format("clusters {}:{}:{}:{}", request_.clusters, request_.components,
                                         request_.seed, request_.iterations);
    WorkPart part(progress, name, [this](auto& state) { this->exchange(state); });
    collectMembers();
    while (course_.step != Step::Done) {
      progress.check();
      takeStep();
      part.advance();
    }
    part.finish();
    return store();
  }

 private:
  /// Steps of the fit. Seed chooses the means; then Assign (vectors to clusters) and Update (clusters to
  /// their vectors) take turns, with ever more components.
  enum class Step : std::uint8_t { Seed, Assign, Update, Done };

  /// Position in the course of the fit, from which an interrupted one continues.
  struct Course {
    Step step = Step::Seed;
    bool exact = false;          ///< in Update: axes come from an eigenvalue decomposition of the covariance
    bool last = false;           ///< in Update: this is the last update
    std::int32_t iteration = 0;  ///< with this number of components; 0 is the first assignment
    std::uint64_t at = 0;        ///< clusters or vectors of this step that are done
    double before = 0.0;         ///< error of the previous iteration
  };

  double weightOf(std::size_t point) const { return weights_.empty() ? 1.0 : weights_[point]; }
  Index members(Index cluster) const {
    return static_cast<Index>(members_[static_cast<std::size_t>(cluster)].size());
  }
  Rows axesOf(Index cluster) const { return basis_.middleRows(cluster * components_, components_); }

  template <typename State>
  void exchange(State& state);
  void begin(Step step, bool exact = false, bool last = false);
  void takeStep();
  void seedMean();
  void setComponents(Index count);
  void assignSome();
  void makeTable();
  void assignRows(std::size_t begin, std::size_t end);
  void collectMembers();
  void endIteration();
  void addComponents();
  void updateSome();
  void updateCluster(Index cluster, bool exact);
  void reseedEmpty();
  ClusterFit store();
  double total() const;

  const ClusterRequest request_;
  const std::span<const double> weights_;
  std::mt19937_64 random_;
  Rows points_;  ///< [vector][dimension], minus centre_
  Eigen::RowVectorXd centre_;
  Eigen::VectorXd squares_;
  Index clusters_ = 1, components_ = 0;
  Rows means_;  ///< [cluster][dimension]
  Rows basis_;  ///< [cluster * components + component][dimension]
  std::vector<std::uint32_t> clusterOf_;
  std::vector<double> errors_;               ///< [vector], squared, of the reconstruction
  std::vector<std::vector<Index>> members_;  ///< [cluster], ascending; follows from clusterOf_
  std::vector<double> distances_;  ///< [vector], squared, to the nearest mean so far; used while seeding
  Rows table_;                     ///< all means and axes as rows during assignment, else empty
  Eigen::VectorXd constants_;      ///< [row of the table], products with the mean
  std::vector<double> squaredErrors_;
  Course course_;
  Pace pace_{1, 1};
};

/// Writes or reads all state that does not follow from the vectors.
template <typename State>
void Fitter::exchange(State& state) {
  state.value(course_.step);
  state.value(course_.exact);
  state.value(course_.last);
  state.value(course_.iteration);
  state.value(course_.at);
  state.value(course_.before);
  state.value(components_);
  state.require(course_.step <= Step::Done && components_ >= 0 && components_ <= request_.components &&
                course_.iteration >= 0 && course_.at <= clusterOf_.size());
  basis_.resize(clusters_ * components_, points_.cols());
  state.elements(std::span(means_.data(), static_cast<std::size_t>(means_.size())));
  state.elements(std::span(basis_.data(), static_cast<std::size_t>(basis_.size())));
  state.sameSize(clusterOf_);
  state.sameSize(errors_);
  if (course_.step == Step::Seed) state.sameSize(distances_);
  state.values(squaredErrors_);
  for (const std::uint32_t cluster : clusterOf_) state.require(cluster < clusters_);
  if constexpr (std::is_same_v<State, StateReader>) {
    std::vector<char> random;
    state.values(random);
    std::istringstream text(std::string(random.begin(), random.end()));
    text >> random_;
    state.require(!text.fail() && means_.allFinite() && basis_.allFinite());
  } else {
    std::ostringstream text;
    text << random_;
    const std::string random = text.str();
    state.values(std::vector<char>(random.begin(), random.end()));
  }
}

void Fitter::begin(Step step, bool exact, bool last) {
  constexpr std::size_t all = std::numeric_limits<std::size_t>::max();
  course_.step = step;
  course_.exact = exact;
  course_.last = last;
  course_.at = 0;
  pace_ = Pace(step == Step::Assign ? rowGrain * hardwareThreads() : hardwareThreads(), all);
}

/// Does a part of the current step that takes about a quarter of a second.
void Fitter::takeStep() {
  if (course_.step == Step::Seed)
    seedMean();
  else if (course_.step == Step::Assign)
    assignSome();
  else
    updateSome();
}

/// Chooses the next mean by k-means++: a vector drawn by weight x squared distance to the nearest mean so
/// far.
void Fitter::seedMean() {
  const auto k = static_cast<Index>(course_.at);
  if (clusters_ > 1) {
    double sum = 0.0;
    for (std::size_t v = 0; v < distances_.size(); ++v) sum += weightOf(v) * distances_[v];
    double wanted = std::uniform_real_distribution<double>(0.0, sum)(random_);
    std::size_t chosen = 0;
    for (std::size_t v = 0; v < distances_.size(); ++v) {
      const double mass = weightOf(v) * distances_[v];
      if (mass > 0.0) chosen = v;
      wanted -= mass;
      if (wanted < 0.0) break;
    }
    means_.row(k) = points_.row(static_cast<Index>(chosen));
    const Eigen::VectorXd next = (points_.rowwise() - means_.row(k)).rowwise().squaredNorm();
    for (std::size_t v = 0; v < distances_.size(); ++v) {
      const double distance = next[static_cast<Index>(v)];
      distances_[v] = k == 0 ? distance : std::min(distances_[v], distance);
    }
  }
  if (++course_.at < static_cast<std::uint64_t>(clusters_)) return;
  distances_ = {};
  setComponents(0);
  begin(Step::Assign);
}

/// Sets the number of components. Existing axes stay; new ones are zero until the next update.
void Fitter::setComponents(Index count) {
  Rows next = Rows::Zero(clusters_ * count, points_.cols());
  const Index kept = std::min(count, components_);
  for (Index k = 0; k < clusters_; ++k)
    next.middleRows(k * count, kept) = basis_.middleRows(k * components_, kept);
  basis_ = std::move(next);
  components_ = count;
}

/// Assigns vectors to the cluster that reconstructs them best, the first if several are equal. With
/// orthonormal axes |x - m|^2 - sum_j ((x - m) . b_j)^2 = |x|^2 - 2 x.m + |m|^2 - sum_j (x.b_j - m.b_j)^2,
/// which matrix products evaluate.
void Fitter::assignSome() {
  if (table_.rows() == 0) makeTable();
  const std::size_t first = course_.at, count = pace_.next(clusterOf_.size() - first);
  parallelRanges(count, rowGrain,
                 [&](std::size_t begin, std::size_t end) { assignRows(first + begin, first + end); });
  course_.at += count;
  if (course_.at < clusterOf_.size()) return;
  table_ = Rows();
  collectMembers();
  endIteration();
}

void Fitter::makeTable() {
  const Index stride = 1 + components_;
  table_.resize(clusters_ * stride, points_.cols());
  constants_.resize(clusters_ * stride);
  for (Index k = 0; k < clusters_; ++k) {
    table_.row(k * stride) = means_.row(k);
    table_.middleRows(k * stride + 1, components_) = axesOf(k);
    constants_[k * stride] = means_.row(k).squaredNorm();
    constants_.segment(k * stride + 1, components_) = axesOf(k) * means_.row(k).transpose();
  }
}

void Fitter::collectMembers() {
  members_.assign(static_cast<std::size_t>(clusters_), {});
  for (std::size_t v = 0; v < clusterOf_.size(); ++v)
    members_[clusterOf_[v]].push_back(static_cast<Index>(v));
}

/// Continues with this number of components as long as the error falls, else doubles it or ends.
void Fitter::endIteration() {
  const double now = total();
  squaredErrors_.push_back(now);
  const bool ends = course_.iteration > 0 && now > course_.before * (1.0 - 1e-4);
  if (!ends) course_.before = now;
  if (!ends && course_.iteration < request_.iterations && course_.before > 0.0 && clusters_ > 1) {
    ++course_.iteration;
    return begin(Step::Update);
  }
  course_.iteration = 0;
  addComponents();
}

void Fitter::addComponents() {
  const bool last = components_ == request_.components;
  if (!last) setComponents(std::min<Index>(components_ == 0 ? 1 : 2 * components_, request_.components));
  begin(Step::Update, true, last);
}

void Fitter::assignRows(std::size_t begin, std::size_t end) {
  const Index stride = 1 + components_;
  const Rows products =
      points_.middleRows(static_cast<Index>(begin), static_cast<Index>(end - begin)) * table_.transpose();
  for (std::size_t v = begin; v < end; ++v) {
    const double* row = products.data() + static_cast<Index>(v - begin) * products.cols();
    double best = std::numeric_limits<double>::infinity();
    for (Index k = 0; k < clusters_; ++k) {
      double error = squares_[static_cast<Index>(v)] - 2.0 * row[k * stride] + constants_[k * stride];
      for (Index j = 1; j < stride; ++j) {
        const double along = row[k * stride + j] - constants_[k * stride + j];
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

/// Gives each cluster without members the vector with the worst reconstruction.
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

void Fitter::updateSome() {
  if (course_.at == 0) reseedEmpty();
  const std::size_t first = course_.at, count = pace_.next(static_cast<std::size_t>(clusters_) - first);
  parallelRanges(count, 1, [&](std::size_t k, std::size_t) {
    updateCluster(static_cast<Index>(first + k), course_.exact);
  });
  course_.at += count;
  if (course_.at == static_cast<std::uint64_t>(clusters_)) begin(course_.last ? Step::Done : Step::Assign);
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
  if (!(weight > 0.0)) return;  // all vectors have weight 0
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

ClusterFit Fitter::store() {
  ClusterFit out;
  out.squaredErrors = std::move(squaredErrors_);
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
