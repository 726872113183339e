#include "benchmarks/suites/indirect/caustic_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "base/parallel.h"
#include "benchmarks/run/measure.h"
#include "benchmarks/suites/indirect/mirrored_cylinder.h"
#include "benchmarks/suites/indirect/photon_samples.h"
#include "photon/caustic_light.h"

namespace prelight::benchmarks {

namespace {

using device::DensityQuery;

constexpr int subPixels = 4;      // a side, of the truth
constexpr double trusted = 0.99;  // share of the pixels, the others being on the infinite caustic

/// A picture of the cylinder's floor, from above.
class CausticTrial {
 public:
  CausticTrial(const Device& device, const IndirectOptions& options)
      : device_(device), options_(options), side_(options.causticSide) {
    const CompiledScene scene = makeSquares(1);
    surface_ = makeDensitySurface(scene, wholeRegion(scene));
    truth_.resize(static_cast<std::size_t>(side_ * side_));
    parallelRanges(truth_.size(), 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) truth_[i] = meanIrradiance(i);
    });
  }

  void run(std::size_t count, std::vector<BenchmarkResult>& results) {
    std::mt19937 random(1);
    const std::vector<device::Photon> photons = MirroredCylinder::photons(count, random);
    const PhotonMaps maps = makePhotonMaps(photons, surface_);
    const CausticFilter chosen = chooseCausticFilter(maps, 1.0 / side_);
    add(fmt::format("caustic/{}/chosen", count), maps, chosen, results);
    for (const int nearest : options_.causticNearest) {
      CausticFilter filter = chosen;
      filter.density.nearest = nearest;
      filter.radius = chosen.radius * std::sqrt(static_cast<double>(nearest) / chosen.density.nearest);
      add(fmt::format("caustic/{}/k {}", count, nearest), maps, filter, results);
      filter.density.kernel = DensityKernel::Cone;
      add(fmt::format("caustic/{}/k {}, cone", count, nearest), maps, filter, results);
      filter.density.kernel = DensityKernel::Constant;
      add(fmt::format("caustic/{}/k {}, constant", count, nearest), maps, filter, results);
    }
    for (const double pixels : options_.causticRadii)
      add(fmt::format("caustic/{}/radius of {} pixels", count, pixels), maps, {{}, pixels / side_}, results);
  }

 private:
  double meanIrradiance(std::size_t pixel) const {
    const auto x = static_cast<double>(pixel % static_cast<std::size_t>(side_));
    const auto z = static_cast<double>(pixel / static_cast<std::size_t>(side_));
    double sum = 0.0;
    for (int j = 0; j < subPixels; ++j)
      for (int i = 0; i < subPixels; ++i)
        sum += MirroredCylinder::irradiance((x + (i + 0.5) / subPixels) / side_,
                                            (z + (j + 0.5) / subPixels) / side_);
    return sum / (subPixels * subPixels);
  }

  void add(const std::string& name, const PhotonMaps& maps, const CausticFilter& filter,
           std::vector<BenchmarkResult>& results) {
    DensityEstimator estimator(surface_, filter.density, device_);
    estimator.setPhotons(maps);
    std::vector<DensityQuery> queries;
    for (int z = 0; z < side_; ++z)
      for (int x = 0; x < side_; ++x) {
        const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(side_);
        const float v = (static_cast<float>(z) + 0.5f) / static_cast<float>(side_);
        queries.push_back({{u, 0.0f, v},
                           v > u ? 0u : 1u,
                           {0, 1, 0},
                           static_cast<float>(filter.radius),
                           PRELIGHT_WHOLE_REGION});
      }
    std::vector<glm::vec3> found = estimator.estimate(queries);
    const std::clock_t before = std::clock();
    found = estimator.estimate(queries);
    const double seconds = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
    results.push_back({name, "relMSE", relativeError(found), "1", {}, {}});
    results.push_back({name, "processor time", seconds, "s", {}, {}});
  }

  /// Over the pixels within the cylinder but for those that err most.
  double relativeError(const std::vector<glm::vec3>& found) const {
    double squares = 0.0;
    for (const double truth : truth_) squares += std::min(truth, 20.0) * std::min(truth, 20.0);
    const double floor = 0.01 * squares / static_cast<double>(truth_.size());
    std::vector<double> errors;
    for (std::size_t i = 0; i < found.size(); ++i)
      if (truth_[i] > 0.0)
        errors.push_back(std::pow(static_cast<double>(found[i].x) - truth_[i], 2.0) /
                         (truth_[i] * truth_[i] + floor));
    std::sort(errors.begin(), errors.end());
    errors.resize(static_cast<std::size_t>(trusted * static_cast<double>(errors.size())));
    double sum = 0.0;
    for (const double error : errors) sum += error;
    return sum / static_cast<double>(errors.size());
  }

  const Device& device_;
  const IndirectOptions& options_;
  int side_;
  DensitySurface surface_;
  std::vector<double> truth_;  ///< [pixel]
};

}  // namespace

void measureCaustic(const Device& device, const IndirectOptions& options,
                    std::vector<BenchmarkResult>& results) {
  CausticTrial trial(device, options);
  for (const std::uint64_t count : options.causticPhotons) trial.run(count, results);
}

}  // namespace prelight::benchmarks
