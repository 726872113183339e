#include "basis/sh_projection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "basis/quadrature.h"
#include "basis/sh_evaluate.h"
#include "basis/sh_rotation.h"
#include "prelight/error.h"

namespace prelight::sh {

std::vector<double> project(const DirectionFunction& f, int degree, int order) {
  checkOrder(order, "projection");
  if (degree < 0) throw UsageError("projection", "expected a degree >= 0, got " + std::to_string(degree));
  std::vector<double> values(coefficientCount(order));
  std::vector<double> sum(values.size(), 0.0);
  for (const SphereSample& s : sphereQuadrature(degree + order - 1)) {
    const double value = f(s.direction);
    if (!std::isfinite(value)) {
      throw Error(ExitCode::RuntimeFailure, "projection",
                  "the function is not finite in direction (" + std::to_string(s.direction.x) + ", " +
                      std::to_string(s.direction.y) + ", " + std::to_string(s.direction.z) + ")");
    }
    evaluate(s.direction, order, values);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += s.weight * value * values[i];
  }
  return sum;
}

Projection projectWithin(const DirectionFunction& f, double tolerance, int order, int largestDegree) {
  checkOrder(order, "projection");
  if (!(tolerance > 0.0)) {
    throw UsageError("projection", "expected a tolerance > 0, got " + std::to_string(tolerance));
  }
  int degree = std::min(2 * order, largestDegree);
  Projection result{project(f, degree, order), std::numeric_limits<double>::infinity(), degree};
  while (result.error > tolerance && 2 * degree <= largestDegree) {
    degree *= 2;
    std::vector<double> finer = project(f, degree, order);
    double change = 0.0;
    for (std::size_t i = 0; i < finer.size(); ++i) {
      change = std::max(change, std::abs(finer[i] - result.coefficients[i]));
    }
    result = {std::move(finer), change, degree};
  }
  return result;
}

namespace {

/// Returns the rotation from a frame whose polar axis is the sky's +Y to the world: (x', y', z') = (z, x, y).
/// In that frame a row of texels has one z' and a column one azimuth, which makes the projection separable.
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

/// Writes the integral over a row of the functions at azimuth 0 in the sky frame, by polar angle with its
/// sine.
void integrateRow(int row, int height, int order, std::span<double> polar) {
  const double step = std::numbers::pi / height;
  // The integrand oscillates order times over pi; a few more nodes than waves give full double precision.
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

/// Adds a row's part of the projection in the sky frame; `polar` holds the integrals of the functions at
/// azimuth 0.
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

/// Writes the integrals of the functions over a texel of a face seen along +z, with u along x and v along y.
void integrateCubeTexel(int row, int column, int faceSize, std::span<const LineSample> rule, int order,
                        std::span<double> out) {
  std::vector<double> values(out.size());
  std::fill(out.begin(), out.end(), 0.0);
  const double step = 2.0 / faceSize;
  for (const LineSample& across : rule) {
    for (const LineSample& down : rule) {
      const glm::dvec3 p(step * (column + 0.5 + 0.5 * across.position) - 1.0,
                         step * (row + 0.5 + 0.5 * down.position) - 1.0, 1.0);
      const double length = glm::length(p);
      const double weight = 0.25 * step * step * across.weight * down.weight / (length * length * length);
      evaluate(p / length, order, values);
      for (std::size_t i = 0; i < out.size(); ++i) out[i] += weight * values[i];
    }
  }
}

/// Returns the fewest nodes along a texel's side with which the integrals at a face's middle and corner are
/// exact up to rounding: two more nodes change nothing.
int cubeTexelNodes(int faceSize, int order) {
  std::vector<double> few(coefficientCount(order));
  std::vector<double> more(few.size());
  const double roundingOfTexel = 1e-14 * 4.0 / (static_cast<double>(faceSize) * faceSize);
  for (int nodes = 2;; ++nodes) {
    double worst = 0.0;
    for (const int texel : {0, faceSize / 2}) {
      integrateCubeTexel(texel, texel, faceSize, gaussLegendre(nodes), order, few);
      integrateCubeTexel(texel, texel, faceSize, gaussLegendre(nodes + 2), order, more);
      for (std::size_t i = 0; i < few.size(); ++i) worst = std::max(worst, std::abs(few[i] - more[i]));
    }
    if (worst <= roundingOfTexel) return nodes;
  }
}

/// Returns the rotation of functions from a face along +z to the direction of the face.
ShRotation turnToFace(int face, int order) {
  const CubeFace& frame = cubeFace(face);
  return {order, glm::dmat3(frame.right, frame.down, frame.axis)};
}

/// Adds the part of a face that was projected along +z.
void addFace(int face, std::span<const double> alongZ, int order, std::span<double> out) {
  std::vector<double> turned(alongZ.size());
  turnToFace(face, order).apply(alongZ, turned);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] += turned[i];
}

}  // namespace

void checkEnvironment(const Environment& environment) {
  const auto count =
      static_cast<std::size_t>(environment.width) * static_cast<std::size_t>(environment.height);
  if (environment.width < 1 || environment.height < 1 || environment.radiance.size() != count) {
    throw InputError("sky", "expected " + std::to_string(environment.width) + " x " +
                                std::to_string(environment.height) + " texels, at least one, got " +
                                std::to_string(environment.radiance.size()));
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (int c = 0; c < 3; ++c) {
      const float value = environment.radiance[i][c];
      if (std::isfinite(value) && value >= 0.0f) continue;
      const std::size_t width = environment.width;
      throw InputError("sky",
                       "texel at column " + std::to_string(i % width) + ", row " + std::to_string(i / width) +
                           " holds " + std::to_string(value),
                       "radiance is finite and not negative");
    }
  }
}

std::vector<double> projectEnvironment(const Environment& environment, int order) {
  checkOrder(order, "sky");
  checkEnvironment(environment);
  const int count = coefficientCount(order);
  const ColumnWaves waves(environment.width, order);
  std::vector<double> polar(count);
  std::vector<double> inSkyFrame(3 * static_cast<std::size_t>(count), 0.0);
  for (int row = 0; row < environment.height; ++row) {
    integrateRow(row, environment.height, order, polar);
    addRow(environment, row, waves, polar, order, inSkyFrame);
  }
  std::vector<double> result(inSkyFrame.size());
  ShRotation(order, worldFromSkyFrame()).apply(inSkyFrame, result);
  return result;
}

std::vector<double> projectEnvironment(const CubeMap& map, int order) {
  checkOrder(order, "sky");
  checkCubeMap(map, "sky");
  const std::size_t count = coefficientCount(order);
  const auto texels = static_cast<std::size_t>(map.faceSize) * static_cast<std::size_t>(map.faceSize);
  const auto rule = gaussLegendre(cubeTexelNodes(map.faceSize, order));
  std::vector<double> integrals(count);
  std::vector<double> faces(cubeFaces * 3 * count, 0.0);  // [face][channel][i]
  for (std::size_t t = 0; t < texels; ++t) {
    integrateCubeTexel(static_cast<int>(t) / map.faceSize, static_cast<int>(t) % map.faceSize, map.faceSize,
                       rule, order, integrals);
    for (std::size_t k = 0; k < cubeFaces * 3; ++k) {
      const double radiance = map.radiance[k / 3 * texels + t][static_cast<int>(k % 3)];
      for (std::size_t i = 0; i < count; ++i) faces[k * count + i] += radiance * integrals[i];
    }
  }
  std::vector<double> result(3 * count, 0.0);
  for (std::size_t face = 0; face < cubeFaces; ++face) {
    addFace(static_cast<int>(face), std::span<const double>(faces).subspan(face * 3 * count, 3 * count),
            order, result);
  }
  return result;
}

std::vector<double> cubeTexelIntegrals(int faceSize, int order) {
  checkOrder(order, "cube map");
  checkCubeFaceSize(faceSize, "cube map");
  const std::size_t count = coefficientCount(order);
  const auto texels = static_cast<std::size_t>(faceSize) * static_cast<std::size_t>(faceSize);
  const auto rule = gaussLegendre(cubeTexelNodes(faceSize, order));
  std::vector<double> alongZ(texels * count);
  for (std::size_t t = 0; t < texels; ++t)
    integrateCubeTexel(static_cast<int>(t) / faceSize, static_cast<int>(t) % faceSize, faceSize, rule, order,
                       std::span(alongZ).subspan(t * count, count));
  std::vector<double> integrals(cubeFaces * alongZ.size());
  for (std::size_t face = 0; face < cubeFaces; ++face)
    turnToFace(static_cast<int>(face), order)
        .apply(alongZ, std::span(integrals).subspan(face * alongZ.size(), alongZ.size()));
  return integrals;
}

}  // namespace prelight::sh
