#include "basis/sh_environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "basis/quadrature.h"
#include "basis/sh_evaluate.h"
#include "basis/sh_rotation.h"

namespace prelight::sh {
namespace {

/// Turns a frame whose polar axis is the sky's +Y into the world: (x', y', z') = (z, x, y). A row of texels
/// has one z' in it, and a column one azimuth, which makes the projection separable.
glm::dmat3 worldFromSkyFrame() { return {{0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}; }

/// Integrals of cos(m phi) and sin(m phi) over every column of the sky frame, [m][column].
struct ColumnWaves {
  std::vector<std::vector<double>> cosine;
  std::vector<std::vector<double>> sine;

  ColumnWaves(int width, int order)
      : cosine(order, std::vector<double>(width, 1.0)), sine(order, std::vector<double>(width, 0.0)) {
    for (int column = 0; column < width; ++column) {
      // Halfway down the map lies the equator, where the sky frame's (x', y') is the unit circle.
      const glm::dvec3 w = Environment::direction((column + 0.5) / width, 0.5);
      for (int m = 1; m < order; ++m) {
        cosine[m][column] = cosine[m - 1][column] * w.z - sine[m - 1][column] * w.x;
        sine[m][column] = sine[m - 1][column] * w.z + cosine[m - 1][column] * w.x;
      }
    }
    for (int m = 0; m < order; ++m) {
      // Over a column of width d about phi the wave integrates to its value at phi times 2 sin(m d / 2) / m.
      const double step = 2.0 * std::numbers::pi / width;
      const double integral = m == 0 ? step : 2.0 * std::sin(0.5 * m * step) / m;
      for (double& value : cosine[m]) value *= integral;
      for (double& value : sine[m]) value *= integral;
    }
  }
};

/// Integral over a row of the functions at azimuth 0 in the sky frame, by polar angle with its sine.
void integrateRow(int row, int height, int order, std::span<double> polar) {
  const double step = std::numbers::pi / height;
  // The integrand oscillates order times over pi; a few nodes more than it has waves give full double
  // precision.
  const int nodes = 6 + static_cast<int>(std::ceil(order * step));
  std::vector<double> basis(polar.size());
  std::fill(polar.begin(), polar.end(), 0.0);
  for (const LineSample& node : gaussLegendre(nodes)) {
    const double angle = step * (row + 0.5 + 0.5 * node.position);
    evaluate(glm::dvec3(std::sin(angle), 0.0, std::cos(angle)), order, basis);
    const double weight = 0.5 * step * node.weight * std::sin(angle);
    for (std::size_t i = 0; i < polar.size(); ++i) polar[i] += weight * basis[i];
  }
}

/// Adds a row's part of the projection in the sky frame; `polar` holds the functions at azimuth 0,
/// integrated.
void addRow(const Environment& environment, int row, const ColumnWaves& waves, std::span<const double> polar,
            int order, std::span<double> out) {
  const glm::vec3* texels = environment.radiance.data() + static_cast<std::size_t>(row) * environment.width;
  const int count = coefficientCount(order);
  for (int m = 0; m < order; ++m) {
    glm::dvec3 even(0.0);
    glm::dvec3 odd(0.0);
    for (int column = 0; column < environment.width; ++column) {
      const glm::dvec3 texel(texels[column]);
      even += waves.cosine[m][column] * texel;
      odd += waves.sine[m][column] * texel;
    }
    for (int l = m; l < order; ++l) {
      const double p = polar[l * (l + 1) + m];
      for (int c = 0; c < 3; ++c) {
        out[c * count + l * (l + 1) + m] += p * even[c];
        if (m > 0) out[c * count + l * (l + 1) - m] += p * odd[c];
      }
    }
  }
}

}  // namespace

std::vector<double> projectEnvironment(const Environment& environment, int order) {
  assert(order >= 1 && order <= maxOrder);
  const int count = coefficientCount(order);
  const ColumnWaves waves(environment.width, order);
  std::vector<double> polar(count);
  std::vector<double> inSkyFrame(3 * static_cast<std::size_t>(count), 0.0);
  for (int row = 0; row < environment.height; ++row) {
    integrateRow(row, environment.height, order, polar);
    addRow(environment, row, waves, polar, order, inSkyFrame);
  }
  std::vector<double> result;
  result.reserve(inSkyFrame.size());
  for (int c = 0; c < 3; ++c) {
    const auto channel =
        rotate(std::span<const double>(inSkyFrame).subspan(c * count, count), order, worldFromSkyFrame());
    result.insert(result.end(), channel.begin(), channel.end());
  }
  return result;
}

}  // namespace prelight::sh
