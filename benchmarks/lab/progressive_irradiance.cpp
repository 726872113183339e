#include "benchmarks/lab/progressive_irradiance.h"

#include <fmt/format.h>

#include <cmath>

#include "prelight/error.h"

namespace prelight {

ProgressiveIrradiance::ProgressiveIrradiance(std::vector<device::DensityQuery> queries, double alpha)
    : queries_(std::move(queries)), sums_(queries_.size(), glm::dvec3(0.0)), alpha_(alpha) {
  if (!(alpha >= 0.0 && alpha <= 1.0))
    throw UsageError("progressive density estimation", fmt::format("alpha {}; expected 0 to 1", alpha));
  for (const device::DensityQuery& query : queries_) firstRadii_.push_back(query.radius);
}

void ProgressiveIrradiance::addPass(const PhotonMaps& photons, DensityEstimator& estimator) {
  for (std::size_t i = 0; i < queries_.size(); ++i)
    queries_[i].radius = static_cast<float>(static_cast<double>(firstRadii_[i]) * radiusShare());
  estimator.setPhotons(photons);
  const std::vector<glm::vec3> pass = estimator.estimate(queries_);
  for (std::size_t i = 0; i < pass.size(); ++i) sums_[i] += glm::dvec3(pass[i]);
  ++passes_;
  squaredShare_ *= (passes_ + alpha_) / (passes_ + 1.0);
}

double ProgressiveIrradiance::radiusShare() const { return std::sqrt(squaredShare_); }

std::vector<glm::vec3> ProgressiveIrradiance::irradiance() const {
  std::vector<glm::vec3> means;
  for (const glm::dvec3& sum : sums_)
    means.emplace_back(passes_ > 0 ? sum / static_cast<double>(passes_) : sum);
  return means;
}

}  // namespace prelight
