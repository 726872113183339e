#include "stress/hit_bounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace prelight::test {

namespace {

constexpr double unit = 0x1p-24;             // Half an ulp of 1: the error of one rounding.
constexpr double division = 2.5 * 2 * unit;  // OpenCL C 1.2, table 7.4.
constexpr double tiniest = 0x1p-126;         // Products below this are rounded absolutely, not relatively.

struct Sheared {
  std::array<double, 3> x, y, z;
  double error = 0.0;  // Error of x and y in single precision.
};

// The ray becomes the z axis. A coordinate is a rounded difference less a rounded product with the rounded
// shear: p - o (1 rounding), s (a division), s z (1 + 1), the difference (1 on the result).
Sheared shear(const std::array<glm::dvec3, 3>& corner, const glm::dvec3& d, int kz) {
  const int kx = (kz + 1) % 3, ky = (kx + 1) % 3;
  const double sx = d[kx] / d[kz], sy = d[ky] / d[kz];
  Sheared s;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3& p = corner[i];
    s.z[i] = p[kz];
    s.x[i] = p[kx] - sx * p[kz];
    s.y[i] = p[ky] - sy * p[kz];
    const auto error = [&](double difference, double product, double result) {
      return unit * std::abs(difference) + (division + 2 * unit) * std::abs(product) +
             unit * std::abs(result) + 3 * tiniest;
    };
    s.error = std::max({s.error, error(p[kx], sx * p[kz], s.x[i]), error(p[ky], sy * p[kz], s.y[i])});
  }
  s.error *= 1.0001;  // Adds terms of second order.
  return s;
}

int dominantAxis(const glm::dvec3& d) {
  const glm::dvec3 size = glm::abs(d);
  return size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
}

/// Whether the ray's line misses the ball around the triangle by far, as a quick test.
bool passesBy(const CompiledScene& scene, std::uint32_t triangle, const device::Ray& ray) {
  const auto& t = scene.triangles[triangle];
  const glm::dvec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
  const glm::dvec3 o(ray.origin[0], ray.origin[1], ray.origin[2]);
  const glm::dvec3 d(ray.direction[0], ray.direction[1], ray.direction[2]);
  const double radius2 = std::max(glm::dot(b - a, b - a), glm::dot(c - a, c - a));
  const glm::dvec3 across = glm::cross(a - o, d);
  return glm::dot(across, across) > 2.0 * radius2 * glm::dot(d, d);
}

}  // namespace

double Crossing::leastWeight() const { return std::min({u, v, 1.0 - u - v}); }

Crossing crossingOf(const CompiledScene& scene, std::uint32_t triangle, const device::Ray& ray) {
  const glm::dvec3 o(ray.origin[0], ray.origin[1], ray.origin[2]);
  const glm::dvec3 d(ray.direction[0], ray.direction[1], ray.direction[2]);
  const auto& t = scene.triangles[triangle];
  std::array<glm::dvec3, 3> corner;
  for (int k = 0; k < 3; ++k) corner[static_cast<std::size_t>(k)] = glm::dvec3(scene.positions[t[k]]) - o;
  const int kz = dominantAxis(d);
  const Sheared s = shear(corner, d, kz);

  Crossing crossing;
  const auto [zLow, zHigh] = std::minmax({s.z[0], s.z[1], s.z[2]});
  const double scale = 1.0 / std::abs(d[kz]);
  const double farthest = std::max(std::abs(zLow), std::abs(zHigh));
  // z has 1 rounding; the weighted sum 1 + 2 per term; the factors 1/dz and 1/det two divisions and two
  // roundings; det 2.
  const double relative = 8 * unit + 2 * division;
  crossing.tLow = (d[kz] > 0 ? zLow : -zHigh) * scale;
  crossing.tHigh = (d[kz] > 0 ? zHigh : -zLow) * scale;
  crossing.tError = scale * (relative * farthest + tiniest);

  const double eu = s.x[2] * s.y[1] - s.y[2] * s.x[1];
  const double ev = s.x[0] * s.y[2] - s.y[0] * s.x[2];
  const double ew = s.x[1] * s.y[0] - s.y[1] * s.x[0];
  const double determinant = eu + ev + ew;
  double extent = 0.0;
  for (std::size_t i = 0; i < 3; ++i) extent = std::max({extent, std::abs(s.x[i]), std::abs(s.y[i])});
  // The edge function is a difference of two products of coordinates. Each coordinate is off by s.error; each
  // product and the difference add a rounding.
  const double edgeError =
      4 * extent * s.error + 2 * s.error * s.error + 4 * unit * extent * extent + 3 * tiniest;
  if (!(std::abs(determinant) > 8 * edgeError)) return crossing;
  crossing.degenerate = false;
  crossing.u = ev / determinant;
  crossing.v = ew / determinant;
  crossing.t = (eu * s.z[0] + ev * s.z[1] + ew * s.z[2]) / determinant / d[kz];
  // The numerator is off by edgeError, the denominator by three times that. Weights that matter here are at
  // most about 1, and the denominator shrinks by 3/8 at most.
  const double largest = 1.0 + std::max({std::abs(crossing.u), std::abs(crossing.v)});
  crossing.weightError =
      std::min(1.0, 1.6 * (1 + 3 * largest) * edgeError / std::abs(determinant) + division + 4 * unit);
  crossing.tError += scale * std::min(1.0, 3 * crossing.weightError) * (zHigh - zLow);
  return crossing;
}

std::string disagreement(const CompiledScene& scene, const device::Ray& ray, const device::Hit& closest,
                         const device::Hit& any) {
  const bool hit = closest.triangle != PRELIGHT_NO_TRIANGLE;
  if (hit != (any.triangle != PRELIGHT_NO_TRIANGLE)) return "closest and any hit differ";
  if (!std::isfinite(closest.t) || !std::isfinite(closest.u) || !std::isfinite(closest.v))
    return "not finite";
  if (!hit && (closest.t != 0.0f || closest.u != 0.0f || closest.v != 0.0f)) return "a miss that says where";
  if (hit) {
    if (closest.triangle >= scene.triangleCount() || closest.triangle == ray.sourceTriangle)
      return fmt::format("hits triangle {}", closest.triangle);
    if (closest.t < 0.0f || closest.t > ray.tMax) return fmt::format("t is {} of {}", closest.t, ray.tMax);
    const Crossing c = crossingOf(scene, closest.triangle, ray);
    if (!c.possible())
      return fmt::format("hits triangle {} that is {} beside (bound {})", closest.triangle, c.leastWeight(),
                         c.weightError);
    if (closest.t < c.tLow - c.tError || closest.t > c.tHigh + c.tError)
      return fmt::format("t is {}, its triangle lies in {} .. {}", closest.t, c.tLow, c.tHigh);
    if (!c.degenerate && (std::abs(closest.u - c.u) > c.weightError ||
                          std::abs(closest.v - c.v) > c.weightError || std::abs(closest.t - c.t) > c.tError))
      return fmt::format("t, u, v are {}, {}, {} instead of {} (bound {}), {}, {} (bound {})", closest.t,
                         closest.u, closest.v, c.t, c.tError, c.u, c.v, c.weightError);
  }
  for (std::uint32_t i = 0; i < scene.triangleCount(); ++i) {
    if (i == ray.sourceTriangle || passesBy(scene, i, ray)) continue;
    const Crossing c = crossingOf(scene, i, ray);
    if (!c.certain() || c.t - c.tError <= 0.0 || c.t + c.tError > std::min<double>(ray.tMax, 3.4e38))
      continue;
    if (!hit) return fmt::format("misses triangle {} at {}", i, c.t);
    if (c.t + c.tError < closest.t)
      return fmt::format("hits triangle {} at {}, triangle {} is nearer at {}", closest.triangle, closest.t,
                         i, c.t);
  }
  return {};
}

}  // namespace prelight::test
