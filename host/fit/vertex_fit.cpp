#include "fit/vertex_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/spans.h"

namespace prelight {

namespace {

/// Numbers of samples ahead at which triangles and slots are prefetched, as they are scattered in memory.
constexpr std::size_t trianglesAhead = 16, slotsAhead = 8;

/// Calls use(first, count) for every run of consecutive samples of one triangle, and ask(i) before sample i.
template <typename Ask, typename Use>
void forRuns(std::span<const SurfaceSample> samples, const Ask& ask, const Use& use) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    ask(i);
    if (samples[i].triangle == samples[first].triangle) continue;
    use(first, i - first);
    first = i;
  }
  if (!samples.empty()) use(first, samples.size() - first);
}

/// Adds to a row of `right` what a run of samples, whose values are [sample][column], contributes by one of
/// its triangle's corners, times `scale`.
template <typename Value>
void addCorner(std::span<const SurfaceSample> run, const Value* values, std::size_t columns,
               std::size_t corner, double scale, float* right) {
  constexpr std::size_t atOnce = 32;
  for (std::size_t first = 0; first < columns; first += atOnce) {
    const std::size_t count = std::min(atOnce, columns - first);
    std::array<double, atOnce> sum{};
    for (std::size_t i = 0; i < run.size(); ++i) {
      const double weight = run[i].weight * cornerWeights(run[i])[corner];
      const Value* row = values + i * columns + first;
      for (std::size_t c = 0; c < count; ++c) sum[c] += weight * row[c];
    }
    for (std::size_t c = 0; c < count; ++c) right[first + c] += static_cast<float>(scale * sum[c]);
  }
}

/// Adds the products of the corners' weights: of each with itself, then of each with the next.
void addMass(std::span<const SurfaceSample> run, TriangleMass& mass) {
  std::array<double, 6> sum{};
  for (const SurfaceSample& sample : run) {
    const std::array<double, 3> b = cornerWeights(sample);
    const double weight = sample.weight;
    for (std::size_t k = 0; k < 3; ++k) {
      sum[k] += weight * b[k] * b[k];
      sum[3 + k] += weight * b[k] * b[(k + 1) % 3];
    }
  }
  for (std::size_t k = 0; k < 6; ++k) mass[k] += static_cast<float>(sum[k]);
}

}  // namespace

VertexFit::VertexFit(const FitMesh& mesh, std::size_t columns)
    : mesh_(&mesh),
      columns_(columns),
      mass_(mesh.triangles.size()),
      right_(mesh.slotCount() * columns, 0.0f) {}

VertexFit::VertexFit(const FitMesh& mesh, std::size_t columns, std::vector<double> triangleWeights)
    : mesh_(&mesh),
      columns_(columns),
      triangleWeights_(std::move(triangleWeights)),
      mass_(mesh.triangles.size()),
      right_(3 * mesh.triangles.size() * columns, 0.0f) {}

std::size_t VertexFit::rowOf(std::size_t triangle, std::size_t corner) const {
  return triangleWeights_.empty() ? mesh_->triangles[triangle][corner] : 3 * triangle + corner;
}

template <typename Value>
void VertexFit::addValues(std::span<const SurfaceSample> samples, std::span<const Value> values) {
  const auto ask = [&](std::size_t i) {
    if (i + trianglesAhead < samples.size()) {
      const std::uint32_t triangle = samples[i + trianglesAhead].triangle;
      prefetch(&mesh_->triangles[triangle]);
      prefetch(&mass_[triangle]);
    }
    if (i + slotsAhead >= samples.size()) return;
    for (std::size_t k = 0; k < 3; ++k)
      prefetch(&right_[rowOf(samples[i + slotsAhead].triangle, k) * columns_], columns_);
  };
  forRuns(samples, ask, [&](std::size_t first, std::size_t count) {
    const std::span<const SurfaceSample> run = samples.subspan(first, count);
    addMass(run, mass_[run[0].triangle]);
    for (std::size_t k = 0; k < 3; ++k)
      addCorner(run, &values[first * columns_], columns_, k, 1.0,
                &right_[rowOf(run[0].triangle, k) * columns_]);
  });
  added_ += samples.size();
}

void VertexFit::add(std::span<const SurfaceSample> samples, std::span<const double> values) {
  addValues(samples, values);
}

void VertexFit::add(std::span<const SurfaceSample> samples, std::span<const float> values) {
  addValues(samples, values);
}

void VertexFit::addTo(std::span<float> rightSide, std::span<const SurfaceSample> samples,
                      std::span<const float> values) const {
  const std::size_t columns = values.size() / samples.size();
  const auto ask = [&](std::size_t i) {
    if (i + trianglesAhead < samples.size())
      prefetch(&mesh_->triangles[samples[i + trianglesAhead].triangle]);
    if (i + slotsAhead >= samples.size()) return;
    for (const std::uint32_t slot : mesh_->triangles[samples[i + slotsAhead].triangle])
      prefetch(&rightSide[slot * columns], columns);
  };
  forRuns(samples, ask, [&](std::size_t first, std::size_t count) {
    const std::span<const SurfaceSample> run = samples.subspan(first, count);
    const double scale = scaleOf(run[0].triangle);
    for (std::size_t k = 0; k < 3; ++k)
      addCorner(run, &values[first * columns], columns, k, scale,
                &rightSide[mesh_->triangles[run[0].triangle][k] * columns]);
  });
}

std::vector<TriangleMass> VertexFit::parkedMass() const {
  std::vector<TriangleMass> mass(mesh_->triangles.size());
  parked_->read(0, std::as_writable_bytes(std::span(mass)));
  return mass;
}

std::vector<float> VertexFit::parkedRight() const {
  std::vector<float> right(mesh_->slotCount() * columns_);
  parked_->read(massBytes(), std::as_writable_bytes(std::span(right)));
  return right;
}

void VertexFit::park() {
  if (parked_ || !triangleWeights_.empty()) return;
  parked_ = std::make_shared<SpillFile>();
  parked_->write(0, std::as_bytes(std::span(mass_)));
  parked_->write(massBytes(), std::as_bytes(std::span(right_)));
  mass_ = std::vector<TriangleMass>();  // assigning {} would keep the memory
  right_ = std::vector<float>();
}

void VertexFit::fetch() {
  if (!parked_) return;
  mass_ = parkedMass();
  right_ = parkedRight();
  parked_.reset();
}

void VertexFit::save(StateWriter& state) const {
  if (parked_) {
    VertexFit fetched = *this;
    fetched.fetch();
    return fetched.save(state);
  }
  // The sums change only when samples are added.
  state.value(added_);
  state.growing(mass_, mass_.size(), added_);
  state.growing(right_, right_.size(), added_);
  state.values(stiffness_);
}

void VertexFit::load(StateReader& state) {
  fetch();
  state.value(added_);
  state.growing(mass_, mass_.size());
  state.growing(right_, right_.size());
  state.values(stiffness_);
  state.require(stiffness_.empty() || stiffness_.size() == mesh_->slotCount());
  for (const TriangleMass& mass : mass_) state.requireFinite(mass);
  state.requireFinite(right_);
  state.requireFinite(stiffness_);
  for (const double stiffness : stiffness_) state.require(stiffness > 0.0);
}

double VertexFit::scaleOf(std::size_t triangle) const {
  if (triangleWeights_.empty()) return 1.0;
  const double weight = totalWeight(mass_[triangle]) + (unseen_ ? double((*unseen_)[triangle]) : 0.0);
  return weight > 0.0 ? triangleWeights_[triangle] / weight : 0.0;
}

/// Returns columns [firstColumn, firstColumn + count) of the right side, [slot][count].
std::vector<float> VertexFit::rightSide(std::size_t firstColumn, std::size_t count) const {
  const std::vector<float> read = parked_ ? parkedRight() : std::vector<float>();
  const std::vector<float>& sums = parked_ ? read : right_;
  std::vector<float> right(mesh_->slotCount() * count, 0.0f);
  const auto addRow = [&](std::size_t slot, double scale, std::size_t row) {
    for (std::size_t c = 0; c < count; ++c)
      right[slot * count + c] += static_cast<float>(scale * sums[row * columns_ + firstColumn + c]);
  };
  if (triangleWeights_.empty())
    for (std::size_t slot = 0; slot < mesh_->slotCount(); ++slot) addRow(slot, 1.0, slot);
  else
    for (std::size_t t = 0; t < mass_.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) addRow(mesh_->triangles[t][k], scaleOf(t), 3 * t + k);
  return right;
}

std::vector<float> VertexFit::solve(double lambda, const SolveLimits& limits) const {
  return solve(equations(lambda), limits);
}

std::vector<float> VertexFit::solveColumn(double lambda, std::size_t column,
                                          const SolveLimits& limits) const {
  return solveColumn(equations(lambda), column, limits);
}

std::vector<float> VertexFit::solve(const NormalEquations& equations, const SolveLimits& limits) const {
  if (parked_) return solve(equations, parkedRight(), columns_, limits);
  return triangleWeights_.empty() ? solve(equations, right_, columns_, limits)
                                  : solve(equations, rightSide(0, columns_), columns_, limits);
}

std::vector<float> VertexFit::solveColumn(const NormalEquations& equations, std::size_t column,
                                          const SolveLimits& limits) const {
  return solve(equations, rightSide(column, 1), 1, limits);
}

std::vector<float> VertexFit::solve(const NormalEquations& equations, std::vector<float> rightSide,
                                    std::size_t columns, const SolveLimits& limits) const {
  std::vector<float> values = std::move(rightSide);
  conjugateGradients(equations, values, columns, limits);
  for (std::uint32_t slot = 0; slot < mesh_->slotCount(); ++slot)
    if (equations.rowOf(slot) == NormalEquations::noRow)
      std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(slot * columns), columns, 0.0f);
  extendFit(*mesh_, equations, extent_, columns, values);
  return values;
}

NormalEquations VertexFit::equations(double lambda) const {
  if (parked_) return {*mesh_, parkedMass(), lambda, stiffness_, unseen()};
  if (triangleWeights_.empty()) return {*mesh_, mass_, lambda, stiffness_, unseen()};
  std::vector<TriangleMass> mass = mass_;
  std::vector<float> unseenWeights(unseen().begin(), unseen().end());
  for (std::size_t t = 0; t < mass.size(); ++t) {
    const double scale = scaleOf(t);
    for (float& m : mass[t]) m = static_cast<float>(scale * m);
    if (!unseenWeights.empty()) unseenWeights[t] = static_cast<float>(scale * unseenWeights[t]);
  }
  return {*mesh_, mass, lambda, stiffness_, unseenWeights};
}

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

namespace {

// Variance of a value minus the mean of its six neighbours, over the variance of the value.
constexpr double noiseOfLaplacian = 1.2;
constexpr double gain = 0.8;          // best strength where curvature and noise are equal
constexpr double leastSignal = 0.02;  // least curvature to assume, relative to the noise

}  // namespace

std::vector<double> stiffnessOf(const FitMesh& mesh, std::span<const double> laplacian,
                                std::span<const double> standardError) {
  std::vector<double> stiffness(mesh.slotCount(), 1.0);
  for (std::uint32_t s = 0; s < mesh.slotCount(); ++s) {
    // The mean over the neighbours is used, whose curvature is similar: a single value is too often small by
    // chance.
    double bending = laplacian[s] * laplacian[s], variance = standardError[s] * standardError[s];
    for (std::uint32_t e = mesh.rowStart[s]; e < mesh.rowStart[s + 1]; ++e) {
      const std::uint32_t n = mesh.columns[e];
      bending += laplacian[n] * laplacian[n];
      variance += standardError[n] * standardError[n];
    }
    const double noise = noiseOfLaplacian * variance;
    const double signal = std::max(bending - noise, leastSignal * noise);
    if (noise > 0.0)
      stiffness[s] = std::clamp(gain * noise / (defaultSmoothing * signal), 1.0, mostStiffness);
  }
  return stiffness;
}

}  // namespace prelight
