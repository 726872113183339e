#include "basis/lights/sh_lights.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "basis/quadrature.h"
#include "basis/sh_evaluate.h"
#include "basis/sh_zonal.h"
#include "prelight/error.h"

// Y_lm is an eigenfunction of the sphere's Laplacian, laplacian Y = -l (l + 1) Y, so by the divergence
// theorem
//     integral_region Y dw = -1 / (l (l + 1)) integral_outline dY/dn ds,        n the outward normal, l > 0.
// On a great arc n is the normal of its plane, a constant. This is exact for any outline, as [1] is, without
// the detour over zonal functions. [1] Wang and Ramamoorthi, "Analytic spherical harmonic coefficients for
// polygonal area lights", 2018. [2] Van Oosterom and Strackee, "The solid angle of a plane triangle", 1983.

namespace prelight::sh {
namespace {

/// A polygon whose vertices all lie this close (radians) to the first is small: its outline integrals would
/// cancel, and its area is integrated instead.
constexpr double smallPolygon = 0.1;

glm::dvec3 checkedDirection(const glm::dvec3& v, const char* where) {
  const double length = glm::length(v);
  if (std::isfinite(length) && length > 0.0) return v / length;
  throw UsageError(where, "expected a finite vector that is not 0, got (" + std::to_string(v.x) + ", " +
                              std::to_string(v.y) + ", " + std::to_string(v.z) + ")");
}

void checkRadius(double radius, const char* where) {
  if (std::isfinite(radius) && radius > 0.0) return;
  throw UsageError(where, "expected a radius > 0, got " + std::to_string(radius));
}

/// Divides the results of an outline integral of inward derivatives by l (l + 1), and puts the solid angle
/// into band 0.
void finishOutline(double solidAngle, double sign, int order, std::span<double> values) {
  values[0] = sign * solidAngle * 0.5 * std::sqrt(std::numbers::inv_pi);
  for (int l = 1; l < order; ++l) {
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) values[i] *= sign / (l * (l + 1.0));
  }
}

/// Returns the signed solid angle of a triangle of unit vectors [2], positive when they turn to the left as
/// seen from outside.
double triangleSolidAngle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double volume = glm::dot(a, glm::cross(b - a, c - a));
  return 2.0 * std::atan2(volume, 1.0 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
}

/// Returns the signed solid angle, from -2 pi to 2 pi, of the smaller of the two sides of the outline.
double polygonSolidAngle(std::span<const glm::dvec3> v) {
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < v.size(); ++i) sum += triangleSolidAngle(v[0], v[i], v[i + 1]);
  return std::remainder(sum, 4.0 * std::numbers::pi);
}

/// Adds the integral of the derivative along `inward` over the great arc from a to b.
void addArc(const glm::dvec3& a, const glm::dvec3& b, int order, std::span<double> sum) {
  const glm::dvec3 normal = glm::cross(a, b - a);
  const double sine = glm::length(normal);
  if (sine == 0.0) return;
  const double angle = std::atan2(sine, glm::dot(a, b));
  const glm::dvec3 inward = normal / sine;  // left of the way from a to b
  const glm::dvec3 ahead = glm::cross(inward, a);
  // The integrand is a sum of waves of up to order - 1 periods a turn.
  const int nodes = 12 + static_cast<int>(std::ceil(0.5 * order * angle));
  std::vector<double> slope(sum.size());
  for (const LineSample& s : gaussLegendre(nodes)) {
    const double t = 0.5 * angle * (1.0 + s.position);
    evaluateDerivative(std::cos(t) * a + std::sin(t) * ahead, inward, order, slope);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += 0.5 * angle * s.weight * slope[i];
  }
}

/// Adds the signed integral over a small triangle: w = p / |p| and dw = det(a, b, c) / |p|^3 for points p of
/// the chord triangle.
void addSmallTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, int order,
                      std::span<double> sum) {
  const double volume = glm::dot(a, glm::cross(b - a, c - a));
  const auto nodes = gaussLegendre(8 + order / 4);
  std::vector<double> values(sum.size());
  for (const LineSample& along : nodes) {
    const double u = 0.5 * (1.0 + along.position);
    for (const LineSample& across : nodes) {
      const double v = 0.5 * (1.0 + across.position);
      const glm::dvec3 p = a + u * ((b - a) + v * (c - b));  // the unit square, folded to a triangle at a
      const double length = glm::length(p);
      evaluate(p / length, order, values);
      const double weight = 0.25 * along.weight * across.weight * u * volume / (length * length * length);
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * values[i];
    }
  }
}

std::vector<glm::dvec3> checkedOutline(std::span<const glm::dvec3> vertices) {
  constexpr const char* where = "polygon light";
  if (vertices.size() < 3) {
    throw UsageError(where, "expected at least 3 vertices, got " + std::to_string(vertices.size()));
  }
  std::vector<glm::dvec3> directions;
  for (const glm::dvec3& v : vertices) directions.push_back(checkedDirection(v, where));
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const std::size_t next = (i + 1) % directions.size();
    if (glm::length(directions[i] + directions[next]) > 1e-12) continue;
    throw UsageError(where, "vertices " + std::to_string(i) + " and " + std::to_string(next) +
                                " are opposite each other: the point lies on the edge");
  }
  return directions;
}

/// A disk's outline as directions, and the contribution of dt to the integrals.
struct Rim {
  glm::dvec3 centre;
  glm::dvec3 right;  ///< radius times a unit vector in the plane
  glm::dvec3 up;

  struct Point {
    glm::dvec3 direction;
    glm::dvec3 inward;  ///< w x dw/dt
  };

  Point at(double t) const {
    const glm::dvec3 p = centre + std::cos(t) * right + std::sin(t) * up;
    const glm::dvec3 ahead = std::cos(t) * up - std::sin(t) * right;
    const double length = glm::length(p);
    return {p / length, glm::cross(p, ahead) / (length * length)};
  }
};

/// Returns the solid angle of a rim around `axis`, a direction inside: integral (1 - cos) d phi = axis.(w x
/// dw) / (1 + cos).
double rimSolidAngle(const Rim& rim, int nodes) {
  const glm::dvec3 axis = glm::normalize(rim.centre);
  double sum = 0.0;
  for (int i = 0; i < nodes; ++i) {
    const Rim::Point p = rim.at(2.0 * std::numbers::pi * i / nodes);
    sum += glm::dot(axis, p.inward) / (1.0 + glm::dot(axis, p.direction));
  }
  return sum * 2.0 * std::numbers::pi / nodes;
}

void integrateRim(const Rim& rim, int nodes, int order, std::span<double> sum) {
  std::fill(sum.begin(), sum.end(), 0.0);
  std::vector<double> slope(sum.size());
  for (int i = 0; i < nodes; ++i) {
    const Rim::Point p = rim.at(2.0 * std::numbers::pi * i / nodes);
    evaluateDerivative(p.direction, p.inward, order, slope);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += slope[k];
  }
  for (double& v : sum) v *= 2.0 * std::numbers::pi / nodes;
}

/// Returns the number of nodes that integrates the solid angle up to rounding: equal steps converge
/// geometrically, the faster the farther the point is from the rim.
int rimNodes(const Rim& rim) {
  for (int nodes = 32; nodes <= 65536; nodes *= 2) {
    if (std::abs(rimSolidAngle(rim, nodes) - rimSolidAngle(rim, 2 * nodes)) < 1e-13) return 2 * nodes;
  }
  throw UsageError("disk light", "the point lies on the disk's rim");
}

}  // namespace

void directionalLight(const glm::dvec3& towards, int order, std::span<double> values) {
  checkOrder(order, "directional light");
  evaluate(checkedDirection(towards, "directional light"), order, values);
}

void pointLight(const glm::dvec3& position, int order, std::span<double> values) {
  checkOrder(order, "point light");
  evaluate(checkedDirection(position, "point light"), order, values);
  const double squared = glm::dot(position, position);
  for (int i = 0; i < coefficientCount(order); ++i) values[i] /= squared;
}

void capLight(const glm::dvec3& towards, double halfAngle, int order, std::span<double> values) {
  checkOrder(order, "cap light");
  const glm::dvec3 axis = checkedDirection(towards, "cap light");
  std::vector<double> zonal(order);
  capZonal(halfAngle, zonal);
  turnZonal(zonal, axis, values.first(coefficientCount(order)));
}

void sphereLight(const glm::dvec3& centre, double radius, int order, std::span<double> values) {
  checkRadius(radius, "sphere light");
  const double distance = glm::length(centre);
  if (distance <= radius) {
    capLight({0.0, 0.0, 1.0}, std::numbers::pi, order, values);
    return;
  }
  capLight(centre, std::asin(radius / distance), order, values);
}

void polygonLight(std::span<const glm::dvec3> vertices, int order, std::span<double> values) {
  checkOrder(order, "polygon light");
  const std::vector<glm::dvec3> outline = checkedOutline(vertices);
  const std::span<double> sum = values.first(coefficientCount(order));
  std::fill(sum.begin(), sum.end(), 0.0);
  const bool isSmall = std::all_of(outline.begin(), outline.end(), [&](const glm::dvec3& v) {
    return glm::distance(v, outline.front()) < smallPolygon;
  });
  if (isSmall) {
    for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
      addSmallTriangle(outline[0], outline[i], outline[i + 1], order, sum);
    }
    if (sum[0] < 0.0) {
      for (double& v : sum) v = -v;
    }
    return;
  }
  const double solidAngle = polygonSolidAngle(outline);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    addArc(outline[i], outline[(i + 1) % outline.size()], order, sum);
  }
  finishOutline(solidAngle, solidAngle < 0.0 ? -1.0 : 1.0, order, sum);
}

void diskLight(const glm::dvec3& centre, const glm::dvec3& normal, double radius, int order,
               std::span<double> values) {
  checkOrder(order, "disk light");
  checkRadius(radius, "disk light");
  checkedDirection(centre, "disk light");
  const glm::dvec3 n = checkedDirection(normal, "disk light");
  const std::span<double> sum = values.first(coefficientCount(order));
  if (std::abs(glm::dot(n, centre)) <= 1e-14 * (glm::length(centre) + radius)) {
    std::fill(sum.begin(), sum.end(), 0.0);
    return;
  }
  const glm::dvec3 other = std::abs(n.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 right = glm::normalize(glm::cross(other, n));
  const Rim rim{centre, radius * right, radius * glm::cross(n, right)};
  const int nodes = std::max(rimNodes(rim), 8 * order);
  const double solidAngle = rimSolidAngle(rim, nodes);
  integrateRim(rim, nodes, order, sum);
  finishOutline(solidAngle, solidAngle < 0.0 ? -1.0 : 1.0, order, sum);
}

}  // namespace prelight::sh
