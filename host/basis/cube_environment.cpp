#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/parallel.h"
#include "basis/cube_map.h"
#include "basis/quadrature.h"
#include "prelight/error.h"

// A texel of the cube is cut into slices of azimuth p from -Z towards +X, in which it reaches from one sine
// of latitude to another, s0(p) to s1(p). Since dw = dp ds, its integral of the sky is that of C(s1) - C(s0)
// over p, where C, the sky summed up along a column, is piecewise linear in s. Between the columns' borders,
// the texel's corners and the azimuths at which its edges pass from one row of the sky to the next, all of
// this is smooth.

namespace prelight {
namespace {

using std::numbers::pi;
constexpr double twoPi = 2.0 * pi;

/// Sums of the sky along its columns, from the south pole.
class ColumnSums {
 public:
  explicit ColumnSums(const Environment& sky) : height_(sky.height), width_(sky.width) {
    for (int k = 0; k <= height_; ++k) sines_.push_back(-std::cos(pi * k / height_));
    sums_.resize(static_cast<std::size_t>(width_) * (height_ + 1), glm::dvec3(0.0));
    for (int column = 0; column < width_; ++column) {
      for (int k = 0; k < height_; ++k) {
        const glm::dvec3 texel(sky.radiance[static_cast<std::size_t>(height_ - 1 - k) * width_ + column]);
        at(column, k + 1) = at(column, k) + (sines_[k + 1] - sines_[k]) * texel;
      }
    }
  }

  int width() const { return width_; }
  int height() const { return height_; }

  /// Returns the sine of latitude of the k-th border of rows, from the south pole at 0 to the north pole at
  /// height().
  double sine(int k) const { return sines_[k]; }

  /// Returns the row, counted from the south, that contains a sine of latitude.
  int rowOf(double sine) const {
    const double row = height_ * (0.5 + std::asin(std::clamp(sine, -1.0, 1.0)) / pi);
    return std::clamp(static_cast<int>(row), 0, height_ - 1);
  }

  glm::dvec3 upTo(int column, double sine) const {
    const int k = rowOf(sine);
    const double part = (sine - sines_[k]) / (sines_[k + 1] - sines_[k]);
    return glm::mix(at(column, k), at(column, k + 1), part);
  }

 private:
  glm::dvec3& at(int column, int k) { return sums_[static_cast<std::size_t>(column) * (height_ + 1) + k]; }
  const glm::dvec3& at(int column, int k) const {
    return sums_[static_cast<std::size_t>(column) * (height_ + 1) + k];
  }

  int height_;
  int width_;
  std::vector<double> sines_;
  std::vector<glm::dvec3> sums_;
};

/// A texel as seen from the vertical axis. Its edges rise or fall from end to end, because the quarters of a
/// face, of which texels of sizes from 2 on are parts, contain neither a pole nor the middle of a side in
/// their interior.
struct Slices {
  std::array<glm::dvec3, 4> edges;  ///< normals of the planes through its edges, pointing inwards
  std::array<double, 4> corners{};  ///< azimuths of the corners, rad
  double from = 0.0;                ///< least azimuth
  double to = 0.0;                  ///< greatest azimuth
  double low = 1.0;                 ///< least sine of latitude
  double high = -1.0;               ///< greatest sine of latitude

  Slices(int face, int row, int column, int size) {
    const auto corner = [&](int r, int c) { return cubeDirection(face, double(c) / size, double(r) / size); };
    const std::array<glm::dvec3, 4> points = {corner(row, column), corner(row, column + 1),
                                              corner(row + 1, column + 1), corner(row + 1, column)};
    const glm::dvec3 centre = cubeDirection(face, (column + 0.5) / size, (row + 0.5) / size);
    const double middle = std::atan2(centre.x, -centre.z);
    from = to = middle;
    for (int i = 0; i < 4; ++i) {
      const glm::dvec3& p = points[i];
      edges[i] = glm::cross(p, points[(i + 1) % 4]);
      if (glm::dot(edges[i], centre) < 0.0) edges[i] = -edges[i];
      low = std::min(low, p.y);
      high = std::max(high, p.y);
      corners[i] = middle;
      if (std::hypot(p.x, p.z) < 1e-9) continue;  // a pole has no azimuth
      corners[i] += std::atan2(centre.x * p.z - centre.z * p.x, centre.x * p.x + centre.z * p.z);
      from = std::min(from, corners[i]);
      to = std::max(to, corners[i]);
    }
  }

  /// Returns the sines of the latitudes between which the texel lies at an azimuth.
  glm::dvec2 at(double azimuth) const {
    double below = -std::numeric_limits<double>::infinity();
    double above = -below;
    for (const glm::dvec3& edge : edges) {
      if (isMeridian(edge)) continue;
      // w is parallel to (sin p, t, -cos p) with t the tangent of its latitude.
      const double t = -(edge.x * std::sin(azimuth) - edge.z * std::cos(azimuth)) / edge.y;
      if (edge.y > 0.0) below = std::max(below, t);
      if (edge.y < 0.0) above = std::min(above, t);
    }
    const auto sine = [](double t) {
      return std::isinf(t) ? std::copysign(1.0, t) : t / std::sqrt(1.0 + t * t);
    };
    return {sine(below), std::max(sine(below), sine(above))};
  }

  static bool isMeridian(const glm::dvec3& edge) { return std::abs(edge.y) < 1e-12; }
};

/// Adds the azimuths in the texel's range at which an edge has the tangent of latitude t.
void addCrossings(const Slices& slices, const glm::dvec3& edge, double t, std::vector<double>& borders) {
  const double sine = -edge.y * t / std::hypot(edge.x, edge.z);
  if (std::abs(sine) >= 1.0) return;
  const double turn = std::atan2(edge.z, edge.x);
  for (const double candidate : {turn + std::asin(sine), turn + pi - std::asin(sine)}) {
    const double azimuth = candidate - twoPi * std::floor((candidate - slices.from) / twoPi);
    if (azimuth < slices.to) borders.push_back(azimuth);
  }
}

/// Writes the azimuths between which the texel's slices change smoothly, ascending.
void findBorders(const Slices& slices, const ColumnSums& sky, std::vector<double>& borders) {
  borders.assign({slices.from, slices.to});
  for (int i = 0; i < 4; ++i) borders.push_back(slices.corners[i]);
  const double step = twoPi / sky.width();
  for (double k = std::ceil((slices.from + pi) / step); k * step - pi < slices.to; ++k) {
    borders.push_back(k * step - pi);
  }
  const int lastRow = std::min(sky.rowOf(slices.high) + 1, sky.height() - 1);
  for (int k = std::max(1, sky.rowOf(slices.low)); k <= lastRow; ++k) {
    const double sine = sky.sine(k);
    const double t = sine / std::sqrt(1.0 - sine * sine);
    for (const glm::dvec3& edge : slices.edges) {
      if (!Slices::isMeridian(edge)) addCrossings(slices, edge, t, borders);
    }
  }
  std::sort(borders.begin(), borders.end());
}

struct Rules {
  std::vector<LineSample> fine = gaussLegendre(10);
  std::vector<LineSample> coarse = gaussLegendre(4);  ///< for pieces so narrow that more nodes change nothing
};

glm::dvec3 integrate(const Slices& slices, const ColumnSums& sky, const Rules& rules,
                     std::vector<double>& borders) {
  findBorders(slices, sky, borders);
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    const double middle = 0.5 * (borders[i] + borders[i + 1]);
    const double half = 0.5 * (borders[i + 1] - borders[i]);
    if (half <= 0.0) continue;
    const double u = middle / twoPi + 0.5;
    const int column = std::min(static_cast<int>((u - std::floor(u)) * sky.width()), sky.width() - 1);
    for (const LineSample& node : half > 0.01 ? rules.fine : rules.coarse) {
      const glm::dvec2 sines = slices.at(middle + half * node.position);
      sum += half * node.weight * (sky.upTo(column, sines.y) - sky.upTo(column, sines.x));
    }
  }
  return sum;
}

void checkSky(const Environment& sky) {
  if (sky.width < 1 || sky.height < 1 ||
      sky.radiance.size() != static_cast<std::size_t>(sky.width) * static_cast<std::size_t>(sky.height)) {
    throw InputError("environment map",
                     fmt::format("got {} texels for {} x {}", sky.radiance.size(), sky.width, sky.height));
  }
  for (std::size_t i = 0; i < sky.radiance.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const float value = sky.radiance[i][c];
      if (std::isfinite(value) && value >= 0.0f) continue;
      throw InputError(
          "environment map",
          fmt::format("the radiance of row {}, column {}, channel {} is {}, expected finite and not "
                      "negative",
                      i / sky.width, i % sky.width, c, value),
          "replace such texels before the map is used");
    }
  }
}

}  // namespace

CubeMap cubeFromEnvironment(const Environment& environment, int faceSize) {
  checkCubeFaceSize(faceSize, "cube map");
  checkSky(environment);
  const int size = std::max(faceSize, 2);  // a whole face would contain a pole
  const ColumnSums sky(environment);
  const CubeTexels texels(size);
  const Rules rules;
  CubeMap map{size, std::vector<glm::vec3>(texels.count())};
  parallelRanges(static_cast<std::size_t>(cubeFaces) * size, 1, [&](std::size_t begin, std::size_t) {
    const int face = static_cast<int>(begin) / size, row = static_cast<int>(begin) % size;
    std::vector<double> borders;
    for (int column = 0; column < size; ++column) {
      const auto texel = static_cast<std::uint32_t>(begin * size + column);
      const glm::dvec3 integral = integrate({face, row, column, size}, sky, rules, borders);
      map.radiance[texel] = glm::vec3(glm::max(integral / texels.solidAngle(texel), glm::dvec3(0.0)));
    }
  });
  if (faceSize == size) return map;
  CubeMap whole{1, {}};
  for (std::size_t f = 0; f < cubeFaces; ++f) {  // the quarters of a face have equal areas
    const glm::vec3* q = map.radiance.data() + 4 * f;
    whole.radiance.push_back(0.25f * (q[0] + q[1] + q[2] + q[3]));
  }
  return whole;
}

}  // namespace prelight
