#include "basis/cube_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace prelight {
namespace {

/// A function of the corners of a texel whose double difference is the integral over the texel.
template <typename Antiderivative>
auto overRectangle(double a0, double a1, double b0, double b1, Antiderivative f) {
  return (f(a1, b1) - f(a0, b1)) - (f(a1, b0) - f(a0, b0));
}

/// Of dw = (1 + a^2 + b^2)^(-3/2) da db.
double solidAngleTo(double a, double b) { return std::atan2(a * b, std::sqrt(a * a + b * b + 1.0)); }

/// Of w dw = (a, b, 1) (1 + a^2 + b^2)^(-2) da db.
glm::dvec3 momentTo(double a, double b) {
  const double ra = 1.0 / std::sqrt(1.0 + a * a);
  const double rb = 1.0 / std::sqrt(1.0 + b * b);
  const double alongB = std::atan(b * ra);
  const double alongA = std::atan(a * rb);
  return 0.5 * glm::dvec3(-ra * alongB, -rb * alongA, a * ra * alongB + b * rb * alongA);
}

/// A convex polygon on a face's plane, of up to five corners: a texel of which the horizon may cut off one.
struct CutTexel {
  std::array<glm::dvec3, 5> corners;  ///< (a, b, 1)
  int count = 0;
};

/// The part of a texel where n.(a, b, 1) >= 0.
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

/// Integral of n.w over a spherical polygon: half the sum over its edges of the angle they subtend times the
/// cosine between n and the normal of their plane (Lambert 1760).
double lambert(const CutTexel& polygon, const glm::dvec3& normal) {
  double sum = 0.0;
  for (int i = 0; i < polygon.count; ++i) {
    const glm::dvec3& from = polygon.corners[i];
    const glm::dvec3& to = polygon.corners[(i + 1) % polygon.count];
    const glm::dvec3 across = glm::cross(from, to - from);
    const double sine = glm::length(across);
    if (sine > 0.0) sum += glm::dot(normal, across) / sine * std::atan2(sine, glm::dot(from, to));
  }
  return std::abs(0.5 * sum);
}

/// open() of one face. `n` is the normal along right, down and axis of the face.
template <typename T>
void openFace(int size, const std::vector<glm::dvec3>& moments, const glm::dvec3& n, T* out) {
  const double step = 2.0 / size;
  for (int row = 0; row < size; ++row) {
    const double b0 = -1.0 + row * step, b1 = -1.0 + (row + 1) * step;
    const double low = n.z + std::min(n.y * b0, n.y * b1);
    const double high = n.z + std::max(n.y * b0, n.y * b1);
    for (int column = 0; column < size; ++column) {
      const double a0 = -1.0 + column * step, a1 = -1.0 + (column + 1) * step;
      const std::size_t i = static_cast<std::size_t>(row) * size + column;
      double integral = 0.0;
      if (low + std::min(n.x * a0, n.x * a1) >= 0.0) {
        integral = glm::dot(n, moments[i]);
      } else if (high + std::max(n.x * a0, n.x * a1) > 0.0) {
        const std::array<glm::dvec3, 4> corners = {glm::dvec3(a0, b0, 1.0), glm::dvec3(a1, b0, 1.0),
                                                   glm::dvec3(a1, b1, 1.0), glm::dvec3(a0, b1, 1.0)};
        integral = lambert(cutAtHorizon(corners, n), n);
      }
      out[i] = static_cast<T>(integral * std::numbers::inv_pi);
    }
  }
}

template <typename T>
void openFaces(int size, const std::vector<glm::dvec3>& moments, const glm::dvec3& normal, std::span<T> out) {
  assert(out.size() == cubeTexelCount(size));
  for (int f = 0; f < cubeFaces; ++f) {
    const CubeFace& face = cubeFace(f);
    const glm::dvec3 n(glm::dot(normal, face.right), glm::dot(normal, face.down),
                       glm::dot(normal, face.axis));
    openFace(size, moments, n, out.data() + f * moments.size());
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
  moments_.reserve(solidAngles_.capacity());
  for (int row = 0; row < faceSize; ++row) {
    const double b0 = -1.0 + row * step, b1 = -1.0 + (row + 1) * step;
    for (int column = 0; column < faceSize; ++column) {
      const double a0 = -1.0 + column * step, a1 = -1.0 + (column + 1) * step;
      solidAngles_.push_back(overRectangle(a0, a1, b0, b1, solidAngleTo));
      moments_.push_back(overRectangle(a0, a1, b0, b1, momentTo));
    }
  }
}

glm::dvec3 CubeTexels::moment(std::uint32_t texel) const {
  const CubeFace& face = cubeFace(static_cast<int>(texel / moments_.size()));
  const glm::dvec3& local = moments_[texel % moments_.size()];
  return local.x * face.right + local.y * face.down + local.z * face.axis;
}

void CubeTexels::open(const glm::dvec3& normal, std::span<double> out) const {
  openFaces(faceSize_, moments_, normal, out);
}

void CubeTexels::open(const glm::dvec3& normal, std::span<float> out) const {
  openFaces(faceSize_, moments_, normal, out);
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
