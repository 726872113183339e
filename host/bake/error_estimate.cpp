#include "bake/error_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace prelight {

namespace {

std::array<double, 3> weightsOf(const SurfaceSample& s) {
  return {1.0 - double(s.b1) - double(s.b2), s.b1, s.b2};
}

/// Mean of each slot's value and its neighbours': eight groups alone make a variance that is good to a factor
/// of 2.
std::vector<double> neighbourMean(const FitMesh& mesh, const std::vector<double>& values) {
  std::vector<double> means(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    double sum = values[i];
    for (std::uint32_t e = mesh.rowStart[i]; e < mesh.rowStart[i + 1]; ++e) sum += values[mesh.columns[e]];
    means[i] = sum / static_cast<double>(1 + mesh.rowStart[i + 1] - mesh.rowStart[i]);
  }
  return means;
}

/// Takes the groups' mean off every slot's shifts: what all groups share is the pull of the smoothing, not
/// noise.
std::vector<double> centred(std::vector<double> shifts) {
  for (std::size_t first = 0; first < shifts.size(); first += errorGroups) {
    double mean = 0.0;
    for (std::size_t g = 0; g < errorGroups; ++g) mean += shifts[first + g] / errorGroups;
    for (std::size_t g = 0; g < errorGroups; ++g) shifts[first + g] -= mean;
  }
  return shifts;
}

}  // namespace

ErrorEstimate estimateAoError(const FitMesh& mesh, const VertexFit& fit, const std::vector<double>& fitted,
                              const std::vector<SampleRecord>& records) {
  std::vector<double> scores(std::size_t{mesh.slotCount()} * errorGroups, 0.0);
  for (const auto& record : records) {
    const auto& slots = mesh.triangles[record.sample.triangle];
    const auto b = weightsOf(record.sample);
    const double expected = b[0] * fitted[slots[0]] + b[1] * fitted[slots[1]] + b[2] * fitted[slots[2]];
    const double residual = double(record.open) - 1.0 - expected;
    for (std::size_t k = 0; k < 3; ++k)
      scores[slots[k] * errorGroups + record.group] += fit.weightOf(record.sample) * b[k] * residual;
  }
  const std::vector<double> shifts = centred(fit.solve(defaultSmoothing, scores, errorGroups));
  constexpr double correction = double(errorGroups) / (errorGroups - 1);
  std::vector<double> variance(mesh.slotCount(), 0.0);
  for (std::size_t i = 0; i < variance.size(); ++i)
    for (std::size_t g = 0; g < errorGroups; ++g)
      variance[i] += correction * shifts[i * errorGroups + g] * shifts[i * errorGroups + g];

  double sum = 0.0, area = 0.0;
  for (const auto& record : records) {
    const auto& slots = mesh.triangles[record.sample.triangle];
    const auto b = weightsOf(record.sample);
    for (std::size_t g = 0; g < errorGroups; ++g) {
      double shift = 0.0;
      for (std::size_t k = 0; k < 3; ++k) shift += b[k] * shifts[slots[k] * errorGroups + g];
      sum += correction * fit.weightOf(record.sample) * shift * shift;
    }
    area += fit.weightOf(record.sample);
  }
  ErrorEstimate estimate;
  estimate.slots = neighbourMean(mesh, variance);
  for (double& v : estimate.slots) {
    v = std::sqrt(v);
    estimate.max = std::max(estimate.max, v);
  }
  estimate.rms = area > 0.0 ? std::sqrt(sum / area) : 0.0;
  return estimate;
}

}  // namespace prelight
