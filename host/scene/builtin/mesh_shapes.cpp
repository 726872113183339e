#include "scene/builtin/mesh_shapes.h"

#include <cmath>
#include <numbers>

namespace prelight {

namespace {

using std::numbers::pi;

float fraction(int i, int n) { return static_cast<float>(i) / static_cast<float>(n); }

/// Removes the rounding differences between two computations of the same point.
glm::vec3 snap(const glm::dvec3& p) {
  constexpr double steps = 16777216.0;  // 2^24 per metre
  return glm::vec3(glm::round(p * steps) / steps);
}

/// Returns a disc as an outline: from the axis to the rim when it faces down, from the rim to the axis when
/// it faces up.
MeshShape makeDisc(float radius, float height, bool facesUp, int segments, int rings) {
  std::vector<OutlinePoint> outline;
  for (int i = 0; i <= rings; ++i) {
    const float r = radius * fraction(facesUp ? rings - i : i, rings);
    outline.push_back({r, height, {0.0f, facesUp ? 1.0f : -1.0f}});
  }
  return makeLathe(outline, segments);
}

}  // namespace

void MeshShape::placeTexCoords(const glm::vec2& corner, const glm::vec2& size) {
  for (glm::vec2& uv : texCoords) uv = corner + uv * size;
}

void MeshShape::add(const MeshShape& other) {
  const auto first = static_cast<std::uint32_t>(positions.size());
  positions.insert(positions.end(), other.positions.begin(), other.positions.end());
  normals.insert(normals.end(), other.normals.begin(), other.normals.end());
  texCoords.insert(texCoords.end(), other.texCoords.begin(), other.texCoords.end());
  for (const glm::uvec3& triangle : other.triangles) triangles.push_back(triangle + first);
}

MeshShape makeGrid(const glm::dvec3& corner, const glm::dvec3& edgeU, const glm::dvec3& edgeV, int columns,
                   int rows) {
  MeshShape grid;
  const glm::vec3 normal(glm::normalize(glm::cross(edgeU, edgeV)));
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      grid.positions.push_back(snap(corner + edgeU * (static_cast<double>(column) / columns) +
                                    edgeV * (static_cast<double>(row) / rows)));
      grid.normals.push_back(normal);
      grid.texCoords.emplace_back(fraction(column, columns), 1.0f - fraction(row, rows));
    }
  }
  const auto vertex = [&](int column, int row) {
    return static_cast<std::uint32_t>(row * (columns + 1) + column);
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t a = vertex(column, row);
      const std::uint32_t b = vertex(column + 1, row);
      const std::uint32_t c = vertex(column + 1, row + 1);
      const std::uint32_t d = vertex(column, row + 1);
      grid.triangles.emplace_back(a, b, c);
      grid.triangles.emplace_back(a, c, d);
    }
  }
  return grid;
}

MeshShape makeBox(const glm::dvec3& size, int cells, bool withBottom) {
  const glm::dvec3 x(size.x, 0.0, 0.0);
  const glm::dvec3 y(0.0, size.y, 0.0);
  const glm::dvec3 z(0.0, 0.0, size.z);
  const glm::dvec3 low(-0.5 * size.x, 0.0, -0.5 * size.z);
  MeshShape box;
  int faces = 0;
  const auto addFace = [&](const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v) {
    constexpr float gap = 0.02f;
    MeshShape face = makeGrid(corner, u, v, cells, cells);
    const glm::vec2 cell(1.0f / 3.0f, 0.5f),
        place(static_cast<float>(faces % 3), static_cast<float>(faces / 3));
    face.placeTexCoords(place * cell + gap, cell - 2.0f * gap);
    box.add(face);
    ++faces;
  };
  addFace(low + z, x, y);       // +z
  addFace(low + x, -x, y);      // -z
  addFace(low + x + z, -z, y);  // +x
  addFace(low, z, y);           // -x
  addFace(low + y + z, x, -z);  // +y
  if (withBottom) addFace(low, x, z);
  return box;
}

MeshShape makeLathe(const std::vector<OutlinePoint>& outline, int segments) {
  MeshShape lathe;
  const auto isPole = [](const OutlinePoint& p) { return p.radius == 0.0f && p.normal.x == 0.0f; };
  std::vector<std::uint32_t> firstVertex;
  for (const OutlinePoint& point : outline) {
    firstVertex.push_back(static_cast<std::uint32_t>(lathe.positions.size()));
    const int copies = isPole(point) ? 1 : segments;
    for (int s = 0; s < copies; ++s) {
      const double angle = 2.0 * pi * s / segments;
      const auto c = static_cast<float>(std::cos(angle));
      const auto d = static_cast<float>(-std::sin(angle));
      lathe.positions.emplace_back(point.radius * c, point.height, point.radius * d);
      lathe.normals.emplace_back(point.normal.x * c, point.normal.y, point.normal.x * d);
    }
  }
  const auto vertex = [&](std::size_t point, int segment) {
    return firstVertex[point] +
           (isPole(outline[point]) ? 0u : static_cast<std::uint32_t>(segment % segments));
  };
  for (std::size_t p = 0; p + 1 < outline.size(); ++p) {
    for (int s = 0; s < segments; ++s) {
      if (outline[p].radius > 0.0f) {
        lathe.triangles.emplace_back(vertex(p, s), vertex(p, s + 1), vertex(p + 1, s));
      }
      if (outline[p + 1].radius > 0.0f) {
        lathe.triangles.emplace_back(vertex(p, s + 1), vertex(p + 1, s + 1), vertex(p + 1, s));
      }
    }
  }
  return lathe;
}

MeshShape makeSphere(float radius, int segments, int rings) {
  std::vector<OutlinePoint> outline;
  for (int i = 0; i <= rings; ++i) {
    const double angle = pi * i / rings;  // from the bottom up
    const bool pole = i == 0 || i == rings;
    const glm::vec2 normal(pole ? 0.0f : static_cast<float>(std::sin(angle)),
                           static_cast<float>(-std::cos(angle)));
    outline.push_back({radius * normal.x, radius * (1.0f + normal.y), normal});
  }
  return makeLathe(outline, segments);
}

MeshShape makeTorus(float ringRadius, float tubeRadius, int segments, int tubeSegments) {
  MeshShape torus;
  for (int s = 0; s < segments; ++s) {
    const double around = 2.0 * pi * s / segments;
    const glm::vec3 outwards(static_cast<float>(std::cos(around)), 0.0f,
                             static_cast<float>(-std::sin(around)));
    for (int t = 0; t < tubeSegments; ++t) {
      const double angle = 2.0 * pi * t / tubeSegments;
      const glm::vec3 normal = outwards * static_cast<float>(std::cos(angle)) +
                               glm::vec3(0.0f, static_cast<float>(std::sin(angle)), 0.0f);
      torus.positions.push_back(outwards * ringRadius + glm::vec3(0.0f, tubeRadius, 0.0f) +
                                normal * tubeRadius);
      torus.normals.push_back(normal);
    }
  }
  const auto vertex = [&](int s, int t) {
    return static_cast<std::uint32_t>((s % segments) * tubeSegments + t % tubeSegments);
  };
  for (int s = 0; s < segments; ++s) {
    for (int t = 0; t < tubeSegments; ++t) {
      torus.triangles.emplace_back(vertex(s, t), vertex(s + 1, t), vertex(s, t + 1));
      torus.triangles.emplace_back(vertex(s + 1, t), vertex(s + 1, t + 1), vertex(s, t + 1));
    }
  }
  return torus;
}

MeshShape makeCone(float radius, float height, int segments, int rows, int discRings) {
  const glm::vec2 normal = glm::normalize(glm::vec2(height, radius));
  std::vector<OutlinePoint> side;
  for (int i = 0; i <= rows; ++i) {
    side.push_back({radius * fraction(rows - i, rows), height * fraction(i, rows), normal});
  }
  MeshShape cone = makeLathe(side, segments);
  cone.add(makeDisc(radius, 0.0f, false, segments, discRings));
  return cone;
}

MeshShape makeCylinder(float radius, float height, int segments, int rows, int discRings) {
  std::vector<OutlinePoint> side;
  for (int i = 0; i <= rows; ++i) side.push_back({radius, height * fraction(i, rows), {1.0f, 0.0f}});
  MeshShape cylinder = makeLathe(side, segments);
  cylinder.add(makeDisc(radius, 0.0f, false, segments, discRings));
  cylinder.add(makeDisc(radius, height, true, segments, discRings));
  return cylinder;
}

}  // namespace prelight
