#include "basis/cube_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>

#include "prelight/error.h"

namespace prelight {
namespace {

/// Returns the integral over a texel of the function whose antiderivative is f, as a double difference over
/// its corners.
template <typename Antiderivative>
auto overRectangle(double a0, double a1, double b0, double b1, Antiderivative f) {
  return (f(a1, b1) - f(a0, b1)) - (f(a1, b0) - f(a0, b0));
}

/// Returns the integral from (0, 0) to (a, b) of dw = (1 + a^2 + b^2)^(-3/2) da db.
double solidAngleTo(double a, double b) { return std::atan2(a * b, std::sqrt(a * a + b * b + 1.0)); }

/// Returns the integral from (0, 0) to (a, b) of w dw = (a, b, 1) (1 + a^2 + b^2)^(-2) da db.
glm::dvec3 momentTo(double a, double b) {
  const double ra = 1.0 / std::sqrt(1.0 + a * a);
  const double rb = 1.0 / std::sqrt(1.0 + b * b);
  const double alongB = std::atan(b * ra);
  const double alongA = std::atan(a * rb);
  return 0.5 * glm::dvec3(-ra * alongB, -rb * alongA, a * ra * alongB + b * rb * alongA);
}

/// A convex polygon on a face's plane, with up to five corners: a texel of which the horizon may cut one off.
struct CutTexel {
  std::array<glm::dvec3, 5> corners;  ///< (a, b, 1)
  int count = 0;
};

/// Returns the part of a texel where n.(a, b, 1) >= 0.
CutTexel cutAtHorizon(const std::array<glm::dvec3, 4>& corners, const glm::dvec3& normal) {
  CutTexel part;
  for (int i = 0; i < 4; ++i) {
    const glm::dvec3& from = corners[i];
    const glm::dvec3& to = corners[(i + 1) % 4];
    const double atFrom = glm::dot(normal, from), atTo = glm::dot(normal, to);
    if (atFrom >= 0.0) part.corners[part.count++] = from;
    if ((atFrom >= 0.0) != (atTo >= 0.0)) {
      part.corners[part.count++] = from + (atFrom / (atFrom - atTo)) * (to - from);
    }
    if (part.count == 5) break;
  }
  return part;
}

/// Returns the angle between two vectors divided by the length of their cross product, given the square of
/// that length and their dot product.
double angleOverSine(double crossSquare, double dot) {
  const double x = crossSquare / (dot * dot);  // square of the tangent
  if (dot > 0.0 && x < 0.01)                   // atan(t) / t; the truncation error is below 1e-15
    return (1.0 - x * (1.0 / 3 - x * (1.0 / 5 - x * (1.0 / 7 - x * (1.0 / 9 - x * (1.0 / 11 - x / 13)))))) /
           dot;
  const double sine = std::sqrt(crossSquare);
  return sine > 0.0 ? std::atan2(sine, dot) / sine : 0.0;
}

/// Returns the integral of n.w over a spherical polygon: half the sum over its edges of the angle that they
/// subtend times the cosine between n and the normal of their plane (Lambert 1760).
double lambert(const CutTexel& polygon, const glm::dvec3& normal) {
  double sum = 0.0;
  for (int i = 0; i < polygon.count; ++i) {
    const glm::dvec3& from = polygon.corners[i];
    const glm::dvec3& to = polygon.corners[(i + 1) % polygon.count];
    const glm::dvec3 across = glm::cross(from, to - from);
    sum += glm::dot(normal, across) * angleOverSine(glm::dot(across, across), glm::dot(from, to));
  }
  return std::abs(0.5 * sum);
}

/// Computes open() for one row of a face. `n` is the normal in the face's frame of right, down and axis; the
/// row reaches from b0 to b1.
class OpenRow {
 public:
  OpenRow(int size, const glm::dvec3& n, double b0, double b1)
      : step_(2.0 / size),
        n_(n),
        b0_(b0),
        b1_(b1),
        low_(n.z + std::min(n.y * b0, n.y * b1)),
        high_(n.z + std::max(n.y * b0, n.y * b1)) {}

  bool whole(int column) const {
    return low_ + std::min(n_.x * left(column), n_.x * left(column + 1)) >= 0.0;
  }
  bool any(int column) const { return high_ + std::max(n_.x * left(column), n_.x * left(column + 1)) > 0.0; }

  /// Returns the integral for a texel that the horizon cuts, not yet divided by pi.
  double cut(int column) const {
    const double a0 = left(column), a1 = left(column + 1);
    const std::array<glm::dvec3, 4> corners = {glm::dvec3(a0, b0_, 1.0), glm::dvec3(a1, b0_, 1.0),
                                               glm::dvec3(a1, b1_, 1.0), glm::dvec3(a0, b1_, 1.0)};
    return lambert(cutAtHorizon(corners, n_), n_);
  }

 private:
  double left(int column) const { return -1.0 + column * step_; }

  double step_;
  glm::dvec3 n_;
  double b0_, b1_, low_, high_;
};

/// Returns how many of the first `size` numbers satisfy a condition that fails for all numbers after the
/// first failure.
template <typename Condition>
int countWhile(int size, const Condition& holds) {
  int count = 0;
  for (int more = size; more > 0;) {
    const int half = more / 2;
    if (holds(count + half)) {
      count += half + 1;
      more -= half + 1;
    } else {
      more = half;
    }
  }
  return count;
}

/// Computes open() for one face. Along a row, fully visible texels, those that the horizon cuts and those
/// below it follow one another, starting from the side to which the normal leans.
template <typename T>
void openFace(int size, const CubeMoments<T>& moments, const glm::dvec3& n, T* out) {
  const double step = 2.0 / size;
  const glm::vec<3, T> scaled = n * std::numbers::inv_pi;
  for (int r = 0; r < size; ++r, out += size) {
    const OpenRow row(size, n, -1.0 + r * step, -1.0 + (r + 1) * step);
    const int from = n.x >= 0.0 ? size - 1 : 0, toward = n.x >= 0.0 ? -1 : 1;
    const int count = countWhile(size, [&](int k) { return row.whole(from + k * toward); });
    const int seen = countWhile(size, [&](int k) { return row.any(from + k * toward); });
    const std::size_t first = static_cast<std::size_t>(r) * size;
    for (int c = n.x >= 0.0 ? size - count : 0, end = c + count; c < end; ++c) {
      const std::size_t i = first + c;
      // At the horizon, rounding may make it negative.
      out[c] = std::max(scaled.x * moments.x[i] + scaled.y * moments.y[i] + scaled.z * moments.z[i], T(0));
    }
    for (int k = count; k < seen; ++k)
      out[from + k * toward] = static_cast<T>(row.cut(from + k * toward) * std::numbers::inv_pi);
    std::fill_n(out + (n.x >= 0.0 ? 0 : seen), size - seen, T(0));
  }
}

template <typename T>
void openFaces(int size, const CubeMoments<T>& moments, const glm::dvec3& normal, std::span<T> out) {
  assert(out.size() == cubeTexelCount(size));
  for (int f = 0; f < cubeFaces; ++f) {
    const CubeFace& face = cubeFace(f);
    const glm::dvec3 n(glm::dot(normal, face.right), glm::dot(normal, face.down),
                       glm::dot(normal, face.axis));
    openFace(size, moments, n, out.data() + f * moments.x.size());
  }
}

}  // namespace

const CubeFace& cubeFace(int face) {
  static constexpr std::array<CubeFace, cubeFaces> faces = {{
      {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
      {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
      {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
      {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
      {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
      {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},
  }};
  assert(face >= 0 && face < cubeFaces);
  return faces[static_cast<std::size_t>(face)];
}

void checkCubeFaceSize(int faceSize, const std::string& where) {
  if (faceSize >= 1 && faceSize <= maxCubeFaceSize && std::has_single_bit(static_cast<unsigned>(faceSize))) {
    return;
  }
  throw UsageError(
      where,
      fmt::format("got faces of {} texels, expected a power of two from 1 to {}", faceSize, maxCubeFaceSize),
      "64 suits most scenes");
}

glm::dvec3 cubeDirection(int face, double u, double v) {
  const CubeFace& frame = cubeFace(face);
  return glm::normalize(frame.axis + (2.0 * u - 1.0) * frame.right + (2.0 * v - 1.0) * frame.down);
}

glm::dvec3 cubeTexelDirection(std::uint32_t texel, int faceSize) {
  const auto size = static_cast<std::uint32_t>(faceSize);
  assert(texel < cubeTexelCount(faceSize));
  return cubeDirection(static_cast<int>(texel / (size * size)), (texel % size + 0.5) / size,
                       (texel / size % size + 0.5) / size);
}

std::uint32_t cubeTexel(const glm::dvec3& direction, int faceSize) {
  const glm::dvec3 length = glm::abs(direction);
  assert(length.x + length.y + length.z > 0.0);
  int axis = 0;
  if (length.y > length[axis]) axis = 1;
  if (length.z > length[axis]) axis = 2;
  const int face = 2 * axis + (direction[axis] < 0.0 ? 1 : 0);
  const CubeFace& frame = cubeFace(face);
  const auto place = [&](const glm::dvec3& along) {
    const double coordinate = 0.5 + 0.5 * glm::dot(direction, along) / length[axis];
    return static_cast<std::uint32_t>(std::clamp(static_cast<int>(coordinate * faceSize), 0, faceSize - 1));
  };
  const auto size = static_cast<std::uint32_t>(faceSize);
  return (static_cast<std::uint32_t>(face) * size + place(frame.down)) * size + place(frame.right);
}

CubeTexels::CubeTexels(int faceSize) : faceSize_(faceSize) {
  checkCubeFaceSize(faceSize, "cube map");
  const double step = 2.0 / faceSize;
  solidAngles_.reserve(static_cast<std::size_t>(faceSize) * faceSize);
  for (int row = 0; row < faceSize; ++row) {
    const double b0 = -1.0 + row * step, b1 = -1.0 + (row + 1) * step;
    for (int column = 0; column < faceSize; ++column) {
      const double a0 = -1.0 + column * step, a1 = -1.0 + (column + 1) * step;
      solidAngles_.push_back(overRectangle(a0, a1, b0, b1, solidAngleTo));
      const glm::dvec3 moment = overRectangle(a0, a1, b0, b1, momentTo);
      moments_.x.push_back(moment.x);
      moments_.y.push_back(moment.y);
      moments_.z.push_back(moment.z);
      shortMoments_.x.push_back(static_cast<float>(moment.x));
      shortMoments_.y.push_back(static_cast<float>(moment.y));
      shortMoments_.z.push_back(static_cast<float>(moment.z));
    }
  }
}

glm::dvec3 CubeTexels::moment(std::uint32_t texel) const {
  const std::size_t i = texel % moments_.x.size();
  const CubeFace& face = cubeFace(static_cast<int>(texel / moments_.x.size()));
  return moments_.x[i] * face.right + moments_.y[i] * face.down + moments_.z[i] * face.axis;
}

void CubeTexels::open(const glm::dvec3& normal, std::span<double> out) const {
  openFaces(faceSize_, moments_, normal, out);
}

void CubeTexels::open(const glm::dvec3& normal, std::span<float> out) const {
  openFaces(faceSize_, shortMoments_, normal, out);
}

void checkCubeMap(const CubeMap& map, const std::string& where) {
  checkCubeFaceSize(map.faceSize, where);
  if (map.radiance.size() != cubeTexelCount(map.faceSize)) {
    throw InputError(where,
                     fmt::format("got {} texels, expected {} for six faces of {} x {}", map.radiance.size(),
                                 cubeTexelCount(map.faceSize), map.faceSize, map.faceSize));
  }
  const auto size = static_cast<std::size_t>(map.faceSize);
  for (std::size_t i = 0; i < map.radiance.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const float value = map.radiance[i][c];
      if (std::isfinite(value) && value >= 0.0f) continue;
      throw InputError(
          where,
          fmt::format("the radiance of face {}, row {}, column {}, channel {} is {}, expected finite "
                      "and not negative",
                      i / (size * size), i / size % size, i % size, c, value),
          "replace such texels before the map is used");
    }
  }
}

}  // namespace prelight
