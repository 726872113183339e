#include "basis/sh.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "basis/quadrature.h"

// [1] Ramamoorthi and Hanrahan, "An efficient representation for irradiance environment maps", 2001.
// [2] Press et al., "Numerical recipes", 3rd ed., 6.7: the normalised Legendre recurrence in l.
// [3] Sloan, "Efficient spherical harmonic evaluation", 2013: sectoral terms as Re and Im of (x + iy)^m.

namespace prelight::sh {
namespace {

/// Factors of the recurrence [2]: P(l) = a(l,m) (z P(l-1) - b(l,m) P(l-2)), of the functions divided by
/// sin^m.
struct Recurrence {
  std::array<std::array<double, maxOrder>, maxOrder> a{};
  std::array<std::array<double, maxOrder>, maxOrder> b{};
  std::array<double, maxOrder> sectoral{};  ///< P(m,m), with sqrt(2) for m > 0

  Recurrence() {
    double pmm = std::sqrt(0.25 * std::numbers::inv_pi);  // Y_00 = 1 / sqrt(4 pi)
    for (int m = 0; m < maxOrder; ++m) {
      if (m > 0) pmm *= std::sqrt((2.0 * m + 1.0) / (2.0 * m));
      sectoral[m] = m > 0 ? std::numbers::sqrt2 * pmm : pmm;
      for (int l = m + 1; l < maxOrder; ++l) {
        const double l2 = static_cast<double>(l) * l;
        const double m2 = static_cast<double>(m) * m;
        const double previous = (l - 1.0) * (l - 1.0);
        a[l][m] = std::sqrt((4.0 * l2 - 1.0) / (l2 - m2));
        b[l][m] = l > 1 ? std::sqrt((previous - m2) / (4.0 * previous - 1.0)) : 0.0;
      }
    }
  }
};

const Recurrence& recurrence() {
  static const Recurrence table;
  return table;
}

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

void evaluate(const glm::dvec3& direction, int order, std::span<double> values) {
  assert(order >= 1 && order <= maxOrder &&
         values.size() >= static_cast<std::size_t>(coefficientCount(order)));
  const Recurrence& table = recurrence();
  double real = 1.0;  // of (x + iy)^m [3]
  double imaginary = 0.0;
  for (int m = 0; m < order; ++m) {
    if (m > 0) {
      const double next = real * direction.x - imaginary * direction.y;
      imaginary = imaginary * direction.x + real * direction.y;
      real = next;
    }
    double before = 0.0;
    double p = table.sectoral[m];
    for (int l = m; l < order; ++l) {
      if (l > m) {
        const double next = table.a[l][m] * (direction.z * p - table.b[l][m] * before);
        before = p;
        p = next;
      }
      values[l * (l + 1) + m] = p * real;
      if (m > 0) values[l * (l + 1) - m] = p * imaginary;
    }
  }
}

double clampedCosine(int band) {
  assert(band >= 0);
  if (band == 1) return 2.0 / 3.0;
  if (band % 2 == 1) return 0.0;
  // [1] Eq. 8, over pi: A_0 = 1, and A_l = -A_(l-2) (l-3)/(l+2) for even l, from the ratio of its factorials.
  double value = 1.0;
  for (int l = 2; l <= band; l += 2) value *= -(l - 3.0) / (l + 2.0);
  return value;
}

void openTransfer(const glm::dvec3& normal, int order, std::span<double> values) {
  evaluate(normal, order, values);
  for (int l = 0; l < order; ++l) {
    const double factor = clampedCosine(l);
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) values[i] *= factor;
  }
}

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

std::vector<double> rotate(std::span<const double> coefficients, int order, const glm::dmat3& rotation) {
  assert(coefficients.size() == static_cast<std::size_t>(coefficientCount(order)));
  const int count = coefficientCount(order);
  const glm::dmat3 inverse = glm::transpose(rotation);
  std::vector<double> basis(count);
  std::vector<double> result(count, 0.0);
  for (const SphereSample& sample : sphereQuadrature(2 * order - 2)) {
    evaluate(inverse * sample.direction, order, basis);
    double value = 0.0;
    for (int i = 0; i < count; ++i) value += coefficients[i] * basis[i];
    evaluate(sample.direction, order, basis);
    for (int i = 0; i < count; ++i) result[i] += sample.weight * value * basis[i];
  }
  return result;
}

}  // namespace prelight::sh
