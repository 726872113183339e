#include "scene/builtin/rounded_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace prelight {
namespace {

using std::numbers::pi;

/// Adds the two triangles of every quad of a grid of vertices, row by row. Quads without area are left out,
/// and so are triangles with two corners in one place.
void addQuads(MeshShape& shape, std::uint32_t first, std::uint32_t columns, std::uint32_t rows) {
  const auto addTriangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto& p = shape.positions;
    if (p[a] != p[b] && p[b] != p[c] && p[c] != p[a]) shape.triangles.emplace_back(a, b, c);
  };
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t a = first + row * (columns + 1) + column, d = a + columns + 1;
      addTriangle(a, a + 1, d + 1);
      addTriangle(a, d + 1, d);
    }
}

/// Returns coordinates across a side of a rounded box: finer at the edges, where they are as seen from the
/// middle of the rounding.
std::vector<double> sideCoordinates(double half, const RoundedBox& box) {
  const double flat = half - box.radius;
  const auto bend = [&](int i) { return box.radius * std::tan(0.25 * pi * i / box.arcs); };
  std::vector<double> values;
  for (int i = box.arcs; i > 0; --i) values.push_back(-flat - bend(i));
  const int cells = std::max(1, static_cast<int>(std::ceil(2.0 * flat / box.cell - 1e-9)));
  for (int i = 0; i <= cells; ++i) values.push_back(flat * (2.0 * i / cells - 1.0));
  for (int i = 1; i <= box.arcs; ++i) values.push_back(flat + bend(i));
  return values;
}

void addBoxFace(MeshShape& shape, const RoundedBox& box, int axis, double sign) {
  const int b = (axis + 1) % 3, c = (axis + 2) % 3;
  const int across = sign > 0.0 ? b : c, along = sign > 0.0 ? c : b;
  const glm::dvec3 half = 0.5 * box.size;
  const std::vector<double> us = sideCoordinates(half[across], box), vs = sideCoordinates(half[along], box);
  const auto first = static_cast<std::uint32_t>(shape.positions.size());
  const bool turned = box.size[along] > box.size[across];
  for (const double v : vs)
    for (const double u : us) {
      glm::dvec3 p;
      p[axis] = sign * half[axis];
      p[across] = u;
      p[along] = v;
      const glm::dvec3 inner = glm::clamp(p, box.radius - half, half - box.radius);
      const glm::dvec3 normal = glm::normalize(p - inner);
      shape.positions.emplace_back(inner + box.radius * normal);
      shape.normals.emplace_back(normal);
      shape.texCoords.emplace_back(turned ? glm::dvec2(v, -u) : glm::dvec2(u, v));
    }
  addQuads(shape, first, static_cast<std::uint32_t>(us.size()) - 1,
           static_cast<std::uint32_t>(vs.size()) - 1);
}

/// Returns a vector that is not parallel to a direction.
glm::dvec3 sideOf(const glm::dvec3& direction) {
  const bool isSteep = std::abs(direction.y) > 0.9 * glm::length(direction);
  return glm::cross(direction, isSteep ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0));
}

struct ProfilePoint {
  glm::dvec2 position;
  glm::dvec2 normal;
  double length;  ///< along the profile up to here
};

glm::dvec2 outsideOf(const glm::dvec2& direction) {
  return glm::normalize(glm::dvec2(direction.y, -direction.x));
}

/// Returns the points with normals; where the profile bends sharply a point appears twice.
std::vector<ProfilePoint> withNormals(const std::vector<glm::dvec2>& profile) {
  const double sharp = std::cos(40.0 * pi / 180.0);
  std::vector<ProfilePoint> points;
  double length = 0.0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (i > 0) length += glm::distance(profile[i], profile[i - 1]);
    const bool isFirst = i == 0, isLast = i + 1 == profile.size();
    const glm::dvec2 before = isFirst ? glm::dvec2(0.0) : outsideOf(profile[i] - profile[i - 1]);
    const glm::dvec2 after = isLast ? glm::dvec2(0.0) : outsideOf(profile[i + 1] - profile[i]);
    if (isFirst || isLast || glm::dot(before, after) > sharp) {
      glm::dvec2 normal = glm::normalize(before + after);
      if (profile[i].x == 0.0) normal = {0.0, normal.y < 0.0 ? -1.0 : 1.0};
      points.push_back({profile[i], normal, length});
    } else {
      points.push_back({profile[i], before, length});
      points.push_back({profile[i], after, length});
    }
  }
  for (ProfilePoint& point : points) point.length /= length;
  return points;
}

}  // namespace

MeshShape makeRoundedBox(const RoundedBox& box) {
  MeshShape shape;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) addBoxFace(shape, box, axis, sign);
  return shape;
}

std::vector<glm::dvec2> smoothCurve(const std::vector<glm::dvec2>& points, int steps) {
  std::vector<glm::dvec2> curve;
  const auto at = [&](std::ptrdiff_t i) {
    return points[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, std::ssize(points) - 1))];
  };
  for (std::ptrdiff_t i = 0; i + 1 < std::ssize(points); ++i)
    for (int k = 0; k < steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      const glm::dvec2 a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
      curve.push_back(
          0.5 *
          (2.0 * b + t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)))));
      curve.back().x = std::max(0.0, curve.back().x);
    }
  curve.push_back(points.back());
  return curve;
}

MeshShape makeTurned(const std::vector<glm::dvec2>& profile, int segments) {
  MeshShape shape;
  const std::vector<ProfilePoint> points = withNormals(profile);
  const auto row = [&](const ProfilePoint& point) {
    for (int s = 0; s <= segments; ++s) {
      const double angle = 2.0 * pi * (s % segments) / segments;
      const glm::dvec2 around(std::cos(angle), -std::sin(angle));
      shape.positions.emplace_back(point.position.x * around.x, point.position.y,
                                   point.position.x * around.y);
      shape.normals.emplace_back(point.normal.x * around.x, point.normal.y, point.normal.x * around.y);
      shape.texCoords.emplace_back(static_cast<double>(s) / segments, point.length);
    }
  };
  for (const ProfilePoint& point : points) row(point);
  addQuads(shape, 0, static_cast<std::uint32_t>(segments), static_cast<std::uint32_t>(points.size()) - 1);
  return shape;
}

MeshShape makeBranch(const std::vector<BranchPoint>& points, int segments) {
  MeshShape shape;
  double length = 0.0;
  glm::dvec3 side = sideOf(points[1].position - points[0].position);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 along = glm::normalize(points[std::min(i + 1, points.size() - 1)].position -
                                            points[i == 0 ? 0 : i - 1].position);
    // The side turns along with the branch, so that the tube is not twisted.
    side = glm::normalize(side - along * glm::dot(side, along));
    const glm::dvec3 other = glm::cross(along, side);
    if (i > 0) length += glm::distance(points[i].position, points[i - 1].position);
    for (int s = 0; s <= segments; ++s) {
      const double angle = 2.0 * pi * (s % segments) / segments;
      const glm::dvec3 normal = std::cos(angle) * side + std::sin(angle) * other;
      shape.positions.emplace_back(points[i].position + points[i].radius * normal);
      shape.normals.emplace_back(normal);
      shape.texCoords.emplace_back(length, 2.0 * pi * points[0].radius * s / segments);
    }
  }
  addQuads(shape, 0, static_cast<std::uint32_t>(segments), static_cast<std::uint32_t>(points.size()) - 1);
  return shape;
}

MeshShape makePillow(const glm::dvec3& size, int cells) {
  MeshShape shape;
  const auto point = [&](double u, double v, double side) {
    const double x = 2.0 * u - 1.0, y = 2.0 * v - 1.0;
    const double bulge = std::sqrt(std::max(0.0, (1.0 - x * x) * (1.0 - y * y)));
    // The sides are drawn in between the corners, as in a filled bag.
    const double inX = 1.0 - 0.07 * (1.0 - y * y) * x * x, inY = 1.0 - 0.07 * (1.0 - x * x) * y * y;
    return glm::dvec3(0.5 * size.x * x * inX, 0.5 * size.y * y * inY, side * 0.5 * size.z * bulge);
  };
  // Samples are closer at the rim, where the outline is round.
  const auto spread = [&](int i) { return 0.5 - 0.5 * std::cos(pi * i / cells); };
  for (const double side : {1.0, -1.0}) {
    const auto first = static_cast<std::uint32_t>(shape.positions.size());
    for (int row = 0; row <= cells; ++row)
      for (int column = 0; column <= cells; ++column) {
        const double u = side > 0.0 ? spread(column) : spread(cells - column), v = spread(row);
        const double h = 1e-4, cu = std::clamp(u, 0.01, 0.99), cv = std::clamp(v, 0.01, 0.99);
        const glm::dvec3 du = point(cu + h, cv, side) - point(cu - h, cv, side);
        const glm::dvec3 dv = point(cu, cv + h, side) - point(cu, cv - h, side);
        const bool isRim = row == 0 || row == cells || column == 0 || column == cells;
        glm::dvec3 p = point(u, v, side);
        if (isRim) p.z = 0.0;
        shape.positions.emplace_back(p);
        shape.normals.emplace_back(glm::normalize(side * glm::cross(du, dv)));
        shape.texCoords.emplace_back(size.x * u, size.y * v);
      }
    addQuads(shape, first, static_cast<std::uint32_t>(cells), static_cast<std::uint32_t>(cells));
  }
  return shape;
}

MeshShape makeCurtain(double width, double height, double depth, int folds) {
  MeshShape shape;
  const int columns = folds * 12, rows = 24;
  const auto point = [&](double u, double v) {
    // Folds are tight at the rail and open downwards.
    const double phase = 2.0 * pi * folds * u + 0.9 * std::sin(5.0 * u + 1.0);
    const double open = 0.75 + 0.25 * (1.0 - v);
    const double sway = 0.25 * std::sin(3.1 * phase / folds + 2.0 * v);
    return glm::dvec3(width * (u - 0.5) * (0.92 + 0.08 * (1.0 - v)), height * v,
                      depth * open * (std::sin(phase + 0.35 * (1.0 - v)) + sway));
  };
  double length = 0.0;
  for (int row = 0; row <= rows; ++row) {
    length = 0.0;
    for (int column = 0; column <= columns; ++column) {
      const double u = static_cast<double>(column) / columns, v = static_cast<double>(row) / rows, h = 1e-4;
      const glm::dvec3 du = point(u + h, v) - point(u - h, v), dv = point(u, v + h) - point(u, v - h);
      if (column > 0) length += glm::distance(point(u, v), point(u - 1.0 / columns, v));
      shape.positions.emplace_back(point(u, v));
      shape.normals.emplace_back(glm::normalize(glm::cross(du, dv)));
      shape.texCoords.emplace_back(length, height * v);
    }
  }
  addQuads(shape, 0, static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows));
  return shape;
}

void place(MeshShape& shape, const glm::dmat3& rotation, const glm::dvec3& translation) {
  for (glm::vec3& p : shape.positions) p = glm::vec3(rotation * glm::dvec3(p) + translation);
  for (glm::vec3& n : shape.normals) n = glm::vec3(rotation * glm::dvec3(n));
}

void place(MeshShape& shape, const glm::dvec3& translation) { place(shape, glm::dmat3(1.0), translation); }

void fitTexCoords(MeshShape& shape, double side, const glm::dvec2& shift) {
  for (glm::vec2& uv : shape.texCoords) uv = glm::vec2(glm::dvec2(uv) / side + shift);
}

glm::dmat3 rotationAbout(const glm::dvec3& axis, double angle) {
  return glm::dmat3(glm::rotate(glm::dmat4(1.0), angle, axis));
}

}  // namespace prelight
