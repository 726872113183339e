#include "basis/cube_overlap.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "basis/cube_map.h"
#include "prelight/error.h"

// [1] Sutherland and Hodgman, "Reentrant polygon clipping", 1974.
// [2] Van Oosterom and Strackee, "The solid angle of a plane triangle", 1983.

namespace prelight {

namespace {

constexpr std::size_t maxCorners = 128;

/// A convex polygon. Each half-space by which it is clipped adds at most one corner.
template <typename Point>
struct Polygon {
  std::array<Point, maxCorners + 8> corners;
  std::size_t count = 0;

  void add(const Point& p) {
    assert(count < corners.size());
    corners[count++] = p;
  }
};

/// Writes the part where `side`, a linear function of the point, is at least 0 [1].
template <typename Point, typename Side>
void clip(const Polygon<Point>& polygon, Side side, Polygon<Point>& part) {
  part.count = 0;
  if (polygon.count == 0) return;
  const Point* from = &polygon.corners[polygon.count - 1];
  double atFrom = side(*from);
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Point* to = &polygon.corners[i];
    const double atTo = side(*to);
    if ((atFrom >= 0.0) != (atTo >= 0.0)) part.add(*from + (atFrom / (atFrom - atTo)) * (*to - *from));
    if (atTo >= 0.0) part.add(*to);
    from = to;
    atFrom = atTo;
  }
}

/// Returns the solid angle of a polygon on the plane z = 1, by triangles [2]; their determinants are planar,
/// so that small ones lose no digits.
double solidAngle(const Polygon<glm::dvec2>& polygon) {
  double sum = 0.0;
  const auto length = [](const glm::dvec2& p) { return std::sqrt(1.0 + glm::dot(p, p)); };
  const glm::dvec2& o = polygon.corners[0];
  const double lo = length(o);
  for (std::size_t i = 1; i + 1 < polygon.count; ++i) {
    const glm::dvec2& p = polygon.corners[i];
    const glm::dvec2& q = polygon.corners[i + 1];
    const double determinant = (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
    const double lp = length(p), lq = length(q);
    const double cosines = lo * lp * lq + (1.0 + glm::dot(o, p)) * lq + (1.0 + glm::dot(o, q)) * lp +
                           (1.0 + glm::dot(p, q)) * lo;
    sum += 2.0 * std::atan2(determinant, cosines);
  }
  return std::abs(sum);
}

struct TexelSpan {
  int first = 0;
  int last = -1;
};

/// Returns the texels along an axis into which a polygon on the face plane reaches.
TexelSpan texelsAlong(const Polygon<glm::dvec2>& polygon, int axis, int size) {
  double least = 1.0, greatest = -1.0;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    least = std::min(least, polygon.corners[i][axis]);
    greatest = std::max(greatest, polygon.corners[i][axis]);
  }
  const auto texel = [&](double p) {
    return std::clamp(static_cast<int>((p + 1.0) * 0.5 * size), 0, size - 1);
  };
  return {texel(least), texel(greatest)};
}

/// Writes the part of a polygon that lies in the texels of index `k` along an axis.
void cutStrip(const Polygon<glm::dvec2>& polygon, int axis, int k, int size, Polygon<glm::dvec2>& strip) {
  Polygon<glm::dvec2> below;
  const double low = -1.0 + 2.0 * k / size, high = -1.0 + 2.0 * (k + 1) / size;
  clip(
      polygon, [&](const glm::dvec2& p) { return p[axis] - low; }, below);
  clip(
      below, [&](const glm::dvec2& p) { return high - p[axis]; }, strip);
}

void overlapFace(const Polygon<glm::dvec2>& polygon, int face, int size,
                 std::vector<TexelOverlap>& overlaps) {
  Polygon<glm::dvec2> strip, cell;
  const TexelSpan rows = texelsAlong(polygon, 1, size);
  for (int row = rows.first; row <= rows.last; ++row) {
    cutStrip(polygon, 1, row, size, strip);
    if (strip.count < 3) continue;
    const TexelSpan columns = texelsAlong(strip, 0, size);
    for (int column = columns.first; column <= columns.last; ++column) {
      cutStrip(strip, 0, column, size, cell);
      if (cell.count < 3) continue;
      const double overlap = solidAngle(cell);
      if (overlap <= 0.0) continue;
      overlaps.push_back({static_cast<std::uint32_t>((face * size + row) * size + column), overlap});
    }
  }
}

}  // namespace

void overlapTexels(std::span<const glm::dvec3> corners, int faceSize, std::vector<TexelOverlap>& overlaps) {
  assert(corners.size() >= 3 && corners.size() <= maxCorners);
  for (int f = 0; f < cubeFaces; ++f) {
    const CubeFace& face = cubeFace(f);
    Polygon<glm::dvec3> part, next;
    for (const glm::dvec3& corner : corners) part.add(corner);
    for (const glm::dvec3& side : {face.right, -face.right, face.down, -face.down}) {
      clip(
          part, [&](const glm::dvec3& p) { return glm::dot(face.axis + side, p); }, next);
      std::swap(part, next);
      if (part.count < 3) break;
    }
    if (part.count < 3) continue;
    Polygon<glm::dvec2> flat;
    bool degenerate = false;
    for (std::size_t i = 0; i < part.count; ++i) {
      const glm::dvec3& p = part.corners[i];
      const double depth = glm::dot(face.axis, p);
      degenerate = degenerate || depth <= 0.0;
      flat.add(glm::dvec2(glm::dot(face.right, p), glm::dot(face.down, p)) / depth);
    }
    if (!degenerate) overlapFace(flat, f, faceSize, overlaps);
  }
}

std::array<glm::dvec3, 4> texelCorners(std::uint32_t texel, int faceSize) {
  const auto size = static_cast<std::uint32_t>(faceSize);
  const CubeFace& face = cubeFace(static_cast<int>(texel / (size * size)));
  const auto corner = [&](std::uint32_t row, std::uint32_t column) {
    return face.axis + (2.0 * column / size - 1.0) * face.right + (2.0 * row / size - 1.0) * face.down;
  };
  const std::uint32_t row = texel / size % size, column = texel % size;
  return {corner(row, column), corner(row, column + 1), corner(row + 1, column + 1), corner(row + 1, column)};
}

CubeMap CubeResampling::apply(const CubeMap& map) const {
  assert(map.faceSize == faceSize && map.radiance.size() + 1 == offsets.size());
  CubeMap result{faceSize, std::vector<glm::vec3>(map.radiance.size())};
  for (std::size_t texel = 0; texel < result.radiance.size(); ++texel) {
    glm::dvec3 sum(0.0);
    for (std::uint32_t k = offsets[texel]; k < offsets[texel + 1]; ++k) {
      sum += static_cast<double>(weights[k]) * glm::dvec3(map.radiance[sources[k]]);
    }
    result.radiance[texel] = glm::vec3(sum);
  }
  return result;
}

CubeResampling rotateByArea(const glm::dmat3& rotation, int faceSize) {
  const CubeTexels texels(faceSize);
  const glm::dmat3 inverse = glm::transpose(rotation);
  const std::size_t count = texels.count();
  std::vector<std::vector<TexelOverlap>> rows(count);
  parallelRanges(count, 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t texel = begin; texel < end; ++texel) {
      auto corners = texelCorners(static_cast<std::uint32_t>(texel), faceSize);
      for (glm::dvec3& corner : corners) corner = inverse * corner;
      overlapTexels(corners, faceSize, rows[texel]);
    }
  });
  CubeResampling result{.faceSize = faceSize, .offsets = {0}, .sources = {}, .weights = {}};
  for (std::size_t texel = 0; texel < count; ++texel) {
    for (const TexelOverlap& overlap : rows[texel]) {
      result.sources.push_back(overlap.texel);
      const double weight = overlap.solidAngle / texels.solidAngle(static_cast<std::uint32_t>(texel));
      result.weights.push_back(static_cast<float>(weight));
    }
    result.offsets.push_back(static_cast<std::uint32_t>(result.sources.size()));
  }
  return result;
}

namespace {

using std::numbers::pi;
constexpr std::size_t diskCorners = 128;

void checkLight(const glm::vec3& value, const char* what) {
  for (int c = 0; c < 3; ++c) {
    if (std::isfinite(value[c]) && value[c] >= 0.0f) continue;
    throw InputError("light", fmt::format("channel {} of its {} is {}, expected finite and not negative", c,
                                          what, value[c]));
  }
}

std::array<glm::dvec3, diskCorners> diskPolygon(const glm::dvec3& axis, double halfAngle) {
  const glm::dvec3 other = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(axis, other)), v = glm::cross(axis, u);
  constexpr double step = 2.0 * pi / diskCorners;
  const double radius = std::tan(halfAngle) * std::sqrt(step / std::sin(step));  // of equal area in the plane
  std::array<glm::dvec3, diskCorners> corners;
  for (std::size_t i = 0; i < diskCorners; ++i) {
    const double angle = step * static_cast<double>(i);
    corners[i] = axis + radius * (std::cos(angle) * u + std::sin(angle) * v);
  }
  return corners;
}

}  // namespace

CubeMap darkCube(int faceSize) {
  checkCubeFaceSize(faceSize, "cube map");
  return {faceSize, std::vector<glm::vec3>(cubeTexelCount(faceSize), glm::vec3(0.0f))};
}

void addDisk(CubeMap& map, const glm::dvec3& toLight, double halfAngle, const glm::vec3& radiance) {
  checkLight(radiance, "radiance");
  if (!(halfAngle > 0.0 && halfAngle < 0.5 * pi)) {
    throw UsageError(
        "disk light",
        fmt::format("got a half angle of {} rad, expected more than 0 and less than pi/2", halfAngle));
  }
  const auto corners = diskPolygon(glm::normalize(toLight), halfAngle);
  std::vector<TexelOverlap> overlaps;
  overlapTexels(corners, map.faceSize, overlaps);
  double covered = 0.0;
  for (const TexelOverlap& overlap : overlaps) covered += overlap.solidAngle;
  const double sine = std::sin(0.5 * halfAngle);
  const double scale = 4.0 * pi * sine * sine / covered;  // 2 pi (1 - cos), so that no energy is lost or won
  const CubeTexels texels(map.faceSize);
  for (const TexelOverlap& overlap : overlaps) {
    const double part = scale * overlap.solidAngle / texels.solidAngle(overlap.texel);
    map.radiance[overlap.texel] += static_cast<float>(part) * radiance;
  }
}

void addDirectional(CubeMap& map, const glm::dvec3& toLight, const glm::vec3& irradiance) {
  checkLight(irradiance, "irradiance");
  const double texel = 4.0 * pi / static_cast<double>(cubeTexelCount(map.faceSize));
  const double halfAngle = std::min(std::acos(1.0 - texel / (2.0 * pi)), 0.25 * pi);
  const double sine = std::sin(halfAngle);  // a disk of radiance L gives a surface that faces it pi L sin^2
  addDisk(map, toLight, halfAngle, irradiance / static_cast<float>(pi * sine * sine));
}

void addCube(CubeMap& map, const CubeMap& other) {
  if (map.faceSize != other.faceSize) {
    throw UsageError("cube map", fmt::format("got faces of {} and of {} texels, expected the same",
                                             map.faceSize, other.faceSize));
  }
  for (std::size_t i = 0; i < map.radiance.size(); ++i) map.radiance[i] += other.radiance[i];
}

}  // namespace prelight
