#include "fit/error_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/parallel.h"

namespace prelight {

namespace {

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

/// [slot][group], deviations of AO whose squares sum to its variance.
using Deviations = std::vector<float>;

constexpr std::size_t slotGrain = 4096;

/// Deviations are wanted to a percent; the noise that they are made of is not known as well.
SolveLimits roughly(std::size_t threads = hardwareThreads()) { return {1e-2, 32, threads}; }

/// Takes the groups' mean off every slot's values, and scales them.
Deviations centred(std::vector<float> values, double factor) {
  parallelRanges(values.size() / errorGroups, slotGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t first = begin * errorGroups; first < end * errorGroups; first += errorGroups) {
      double mean = 0.0;
      for (std::size_t g = 0; g < errorGroups; ++g) mean += values[first + g] / double(errorGroups);
      for (std::size_t g = 0; g < errorGroups; ++g)
        values[first + g] = static_cast<float>(factor * (values[first + g] - mean));
    }
  });
  return values;
}

/// What is fitted: AO relative to an open receiver's.
double valueOf(const SampleRecord& record) { return double(record.open) - 1.0; }

/// Calls use(samples, values) for records that follow one another and of which wanted(record) is true.
template <typename Wanted, typename Use>
void forParts(const std::vector<SampleRecord>& records, const Wanted& wanted, const Use& use) {
  constexpr std::size_t partSize = 4096;
  std::vector<SurfaceSample> samples;
  std::vector<double> values;
  const auto end = [&] {
    use(samples, values);
    samples.clear();
    values.clear();
  };
  for (const SampleRecord& record : records) {
    if (!wanted(record)) continue;
    samples.push_back(record.sample);
    values.push_back(valueOf(record));
    if (samples.size() == partSize) end();
  }
  end();
}

/// How far the residuals of each group alone move the fit to all records, whose values are given. What all groups share is the pull of the
/// smoothing, not noise.
Deviations sandwich(const FitMesh& mesh, const VertexFit& fit, const std::vector<SampleRecord>& records,
                    const std::vector<float>& values) {
  std::vector<float> scores(std::size_t{mesh.slotCount()} * errorGroups, 0.0f);
  for (const auto& record : records) {
    const auto& slots = mesh.triangles[record.sample.triangle];
    const auto b = cornerWeights(record.sample);
    const double expected = b[0] * values[slots[0]] + b[1] * values[slots[1]] + b[2] * values[slots[2]];
    const double residual = valueOf(record) - expected;
    for (std::size_t k = 0; k < 3; ++k)
      scores[slots[k] * errorGroups + record.group] +=
          static_cast<float>(fit.weightOf(record.sample) * b[k] * residual);
  }
  constexpr double groups = errorGroups;
  return centred(fit.solve(defaultSmoothing, scores, errorGroups, roughly()),
                 std::sqrt(groups / (groups - 1.0)));
}

/// How far leaving each group out moves the fit to all records from its values.
Deviations jackknife(const VertexFit& fit, const std::vector<SampleRecord>& records,
                     const std::vector<float>& values) {
  Deviations deviations(values.size() * errorGroups);
  const std::size_t threads = std::min<std::size_t>(hardwareThreads(), errorGroups);
  parallelRanges(errorGroups, (errorGroups + threads - 1) / threads, [&](std::size_t begin, std::size_t end) {
    VertexFit rest = fit;
    for (std::size_t group = begin; group < end; ++group) {
      if (group > begin) rest = fit;
      forParts(
          records, [&](const SampleRecord& record) { return record.group == group; },
          [&](const auto& samples, const auto& gone) { rest.remove(samples, gone); });
      const std::vector<float> without = rest.solveFrom(defaultSmoothing, values, roughly(1));
      for (std::size_t s = 0; s < values.size(); ++s)
        deviations[s * errorGroups + group] = without[s] - values[s];
    }
  });
  constexpr double groups = errorGroups;
  return centred(std::move(deviations), std::sqrt((groups - 1.0) / groups));
}

/// Mean square over the surface of the interpolated deviations. The mean of a linear function's square over a
/// triangle is (a^2 + b^2 + c^2 + ab + bc + ca) / 6.
double surfaceMeanSquare(const FitMesh& mesh, const std::vector<double>& areas,
                         const Deviations& deviations) {
  struct Part {
    double sum = 0.0, area = 0.0;
  };
  std::vector<Part> parts((areas.size() + slotGrain - 1) / slotGrain);
  parallelRanges(areas.size(), slotGrain, [&](std::size_t begin, std::size_t end) {
    Part& part = parts[begin / slotGrain];
    for (std::size_t t = begin; t < end; ++t) {
      const auto& slots = mesh.triangles[t];
      double squares = 0.0;
      for (std::size_t g = 0; g < errorGroups; ++g) {
        const double a = deviations[slots[0] * errorGroups + g], b = deviations[slots[1] * errorGroups + g],
                     c = deviations[slots[2] * errorGroups + g];
        squares += (a * a + b * b + c * c + a * b + b * c + c * a) / 6.0;
      }
      part.sum += areas[t] * squares;
      part.area += areas[t];
    }
  });
  Part total;
  for (const Part& part : parts) total = {total.sum + part.sum, total.area + part.area};
  return total.area > 0.0 ? total.sum / total.area : 0.0;
}

/// How much smaller the variance of all groups together is than their scatter says. The scatter of m groups,
/// each with an m-th of the receivers, exceeds the variance (m^(1 + b) - 1) / (m - 1) times when that falls
/// like n^-(1 + b); consecutive groups make up the halves.
double complementFactor(const FitMesh& mesh, const std::vector<double>& areas, const Deviations& groups) {
  Deviations halves(groups.size(), 0.0f);
  for (std::size_t i = 0; i < groups.size(); ++i)
    halves[i - i % errorGroups] += i % errorGroups < errorGroups / 2 ? groups[i] : -groups[i];
  const double unscale = (errorGroups - 1.0) / errorGroups;  // deviations carry the root of its inverse
  const double ofGroups = surfaceMeanSquare(mesh, areas, groups);
  const double ofHalves = unscale * surfaceMeanSquare(mesh, areas, halves);
  const auto excess = [](double m, double b) { return (std::pow(m, 1.0 + b) - 1.0) / (m - 1.0); };
  double low = 0.0, high = 1.0;  // from independent samples to the best that (0,2)-sequences do for edges
  for (int i = 0; i < 30; ++i) {
    const double b = 0.5 * (low + high);
    (ofGroups * excess(2.0, b) > ofHalves * excess(errorGroups, b) ? low : high) = b;
  }
  return 1.0 / excess(errorGroups, low);
}

/// [slot], sums of squares.
std::vector<double> variances(const Deviations& deviations) {
  std::vector<double> sums(deviations.size() / errorGroups, 0.0);
  for (std::size_t i = 0; i < deviations.size(); ++i) sums[i / errorGroups] += double(deviations[i]) * deviations[i];
  return sums;
}

}  // namespace

ErrorEstimate estimateAoError(const FitMesh& mesh, const VertexFit& empty, const std::vector<double>& areas,
                              const std::vector<SampleRecord>& records, std::uint64_t receivers,
                              bool independent) {
  VertexFit fit = empty;
  forParts(
      records, [](const SampleRecord&) { return true; },
      [&](const auto& samples, const auto& open) { fit.add(samples, open); });
  const std::vector<float> values = fit.solve(defaultSmoothing);
  const Deviations low = sandwich(mesh, fit, records, values),
                   high = jackknife(fit, records, values);
  // The receivers without a record make the variance smaller in proportion.
  double share = receivers > 0 ? static_cast<double>(records.size()) / static_cast<double>(receivers) : 1.0;
  if (!independent) share *= complementFactor(mesh, areas, low);
  ErrorEstimate estimate;
  estimate.rms = std::sqrt(
      share * std::sqrt(surfaceMeanSquare(mesh, areas, low) * surfaceMeanSquare(mesh, areas, high)));
  const std::vector<double> lowSlots = neighbourMean(mesh, variances(low)),
                            highSlots = neighbourMean(mesh, variances(high));
  for (std::size_t s = 0; s < lowSlots.size(); ++s) {
    estimate.slots.push_back(std::sqrt(share * std::sqrt(lowSlots[s] * highSlots[s])));
    estimate.max = std::max(estimate.max, estimate.slots.back());
  }
  return estimate;
}

}  // namespace prelight
