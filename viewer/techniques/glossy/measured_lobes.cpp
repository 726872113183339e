#include "viewer/techniques/glossy/measured_lobes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "basis/quadrature.h"
#include "basis/sh_evaluate.h"
#include "fit/symmetric_solve.h"
#include "scene/lobes.h"
#include "scene/measured_brdf.h"
#include "viewer/scene/surface.h"

namespace prelight::viewer {
namespace {

using std::numbers::pi;

/// Harmonics that are even about the plane y = 0: their places among all.
std::vector<std::size_t> evenHarmonics(int order) {
  std::vector<std::size_t> places;
  for (int l = 0; l < order; ++l)
    for (int m = 0; m <= l; ++m) places.push_back(static_cast<std::size_t>(l * (l + 1) + m));
  return places;
}

/// Solves for the lobe's coefficients f with the least energy: the integral over directions above the surface
/// of cosine x Y_j x sum f_i Y_i is what is given.
SymmetricFactors hemisphereFactors(int order, const std::vector<std::size_t>& even) {
  constexpr double smallest = 1e-5;  // of the pivots: bands hardly differ over half of the sphere
  const std::size_t n = even.size();
  std::vector<double> matrix(n * n, 0.0), basis(static_cast<std::size_t>(order * order));
  const int azimuths = 2 * order + 1;
  for (const LineSample& node : gaussLegendre(order + 1)) {
    const double z = 0.5 * (node.position + 1.0), radius = std::sqrt(1.0 - z * z);
    const double weight = 0.5 * node.weight * z * 2.0 * pi / azimuths;
    for (int k = 0; k < azimuths; ++k) {
      const double turn = 2.0 * pi * k / azimuths;
      sh::evaluate({radius * std::cos(turn), radius * std::sin(turn), z}, order, basis);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) matrix[i * n + j] += weight * basis[even[i]] * basis[even[j]];
    }
  }
  return SymmetricFactors(std::move(matrix), smallest);
}

/// Fits the even harmonics by sums of zonal functions.
class AxisFit {
 public:
  explicit AxisFit(int order) : order_(order) {
    for (int axis = 0; axis < order; ++axis) {
      basis_.emplace_back(static_cast<std::size_t>(order * order));
      sh::evaluate(axisOf(axis, order), order, basis_.back());
    }
    for (int l = 0; l < order; ++l) factors_.push_back(factorsOf(l));
  }

  /// Least-squares fit of band l, given as [m][channel]; writes [axis].
  void fit(int l, std::vector<double> even, glm::vec4* factors) const {
    const auto band = static_cast<std::size_t>(l);
    factors_[band].solve(even, 3);
    for (int axis = 0; axis < order_; ++axis) {
      glm::dvec3 sum(0.0);
      for (int m = 0; m <= l; ++m)
        for (int c = 0; c < 3; ++c) sum[c] += value(axis, l, m) * even[static_cast<std::size_t>(3 * m + c)];
      factors[axis * order_ + l] = glm::vec4(glm::vec3(sum * pi), 0.0f);  // what arrives is over pi
    }
  }

 private:
  double value(int axis, int l, int m) const {
    return basis_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(l * (l + 1) + m)];
  }

  SymmetricFactors factorsOf(int l) const {
    const auto size = static_cast<std::size_t>(l + 1);
    std::vector<double> matrix(size * size, 0.0);
    for (int m = 0; m <= l; ++m)
      for (int k = 0; k <= l; ++k)
        for (int axis = 0; axis < order_; ++axis)
          matrix[static_cast<std::size_t>(m) * size + static_cast<std::size_t>(k)] +=
              value(axis, l, m) * value(axis, l, k);
    return SymmetricFactors(std::move(matrix), 1e-10);
  }

  int order_;
  std::vector<std::vector<double>> basis_;  ///< [axis][harmonic]
  std::vector<SymmetricFactors> factors_;   ///< [band]
};

double cosineOfStep(int step) { return std::max(double(step), 0.25) / (measuredSteps - 1); }

/// Reflected radiance of the BRDF under light of each even harmonic, [harmonic][channel].
std::vector<double> reflected(const MeasuredBrdf& brdf, const std::vector<HalfVector>& samples, double cosine,
                              int order, const std::vector<std::size_t>& even) {
  std::vector<double> sum(3 * even.size(), 0.0), basis(static_cast<std::size_t>(order * order));
  const glm::dvec3 wo = directionOfCosine(cosine);
  forReflected(samples, wo, [&](const glm::dvec3& wi, const glm::dvec3&, double weight) {
    const glm::dvec3 value = brdfAt(brdf.rest, wo, wi) * (wi.z * weight);
    sh::evaluate(glm::normalize(wi), order, basis);
    for (std::size_t i = 0; i < even.size(); ++i)
      for (int c = 0; c < 3; ++c) sum[3 * i + static_cast<std::size_t>(c)] += value[c] * basis[even[i]];
  });
  return sum;
}

/// [step][axis][band]
void addLobes(const MeasuredBrdf& brdf, int order, std::vector<glm::vec4>& lobes) {
  const std::vector<std::size_t> even = evenHarmonics(order);
  const SymmetricFactors hemisphere = hemisphereFactors(order, even);
  const AxisFit axes(order);
  const std::vector<HalfVector> samples = halfVectors();
  const std::size_t first = lobes.size(), size = static_cast<std::size_t>(order * order);
  lobes.resize(first + measuredSteps * size);
  parallelRanges(measuredSteps, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t step = begin; step < end; ++step) {
      std::vector<double> lobe = reflected(brdf, samples, cosineOfStep(static_cast<int>(step)), order, even);
      hemisphere.solve(lobe, 3);
      for (int l = 0, i = 0; l < order; i += 3 * (l + 1), ++l)
        axes.fit(l, {lobe.begin() + i, lobe.begin() + i + 3 * (l + 1)}, &lobes[first + step * size]);
    }
  });
}

}  // namespace

std::vector<glm::vec4> measuredLobes(const CompiledScene& scene, int order) {
  const std::vector<int> numbers = measuredNumbers(scene);
  std::vector<glm::vec4> lobes;
  int next = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] != next) continue;
    addLobes(*scene.materials[i].measured, order, lobes);
    ++next;
  }
  return lobes;
}

glm::dvec3 axisOf(int axis, int order) {
  const double angle = pi * ((axis + 0.5) / order - 0.5);
  return {std::sin(angle), 0.0, std::cos(angle)};
}

}  // namespace prelight::viewer
