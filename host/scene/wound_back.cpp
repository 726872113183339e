#include "scene/wound_back.h"

#include <cmath>
#include <utility>

#include "scene/deform.h"

namespace prelight {
namespace {

/// Returns a vector of twice the triangle's area towards the side on which its corners run counter-clockwise.
glm::dvec3 facingOf(const Primitive& primitive, const glm::uvec3& triangle) {
  const glm::dvec3 a(primitive.positions[triangle.x]);
  return glm::cross(glm::dvec3(primitive.positions[triangle.y]) - a,
                    glm::dvec3(primitive.positions[triangle.z]) - a);
}

bool isWoundBack(const Primitive& primitive, const glm::uvec3& triangle, const glm::dvec3& facing) {
  for (int corner = 0; corner < 3; ++corner)
    if (!(glm::dot(glm::dvec3(primitive.normals[triangle[corner]]), facing) < 0.0)) return false;
  return true;
}

/// Areas of triangles in the mesh's space.
struct TurnedAreas {
  double all = 0.0, turned = 0.0;
  std::size_t triangles = 0;
};

TurnedAreas turn(Primitive& primitive) {
  TurnedAreas areas;
  for (std::size_t t = 0; t < primitive.triangles.size(); ++t) {
    glm::uvec3& triangle = primitive.triangles[t];
    const glm::dvec3 facing = facingOf(primitive, triangle);
    const double area = 0.5 * glm::length(facing);
    areas.all += area;
    if (primitive.normals.empty() || !isWoundBack(primitive, triangle, facing)) continue;
    areas.turned += area;
    ++areas.triangles;
    std::swap(triangle.y, triangle.z);
    primitive.turns.resize(primitive.triangles.size(), 0);
    primitive.turns[t] ^= CornersExchanged;
  }
  return areas;
}

/// Returns about how much a transform enlarges areas, averaged over directions.
double areaScale(const glm::dmat4& transform) {
  return std::pow(std::abs(glm::determinant(glm::dmat3(transform))), 2.0 / 3.0);
}

}  // namespace

WoundBack turnWoundBack(Scene& scene) {
  WoundBack found;
  std::vector<TurnedAreas> areas;
  for (Mesh& mesh : scene.meshes) {
    TurnedAreas& sum = areas.emplace_back();
    for (Primitive& primitive : mesh.primitives) {
      const TurnedAreas own = turn(primitive);
      sum.all += own.all;
      sum.turned += own.turned;
      sum.triangles += own.triangles;
    }
    found.triangles += sum.triangles;
    if (sum.triangles > 0)
      found.meshes.push_back(mesh.name.empty() ? std::to_string(areas.size() - 1) : mesh.name);
  }
  if (found.triangles == 0) return found;
  double all = 0.0, turned = 0.0;
  for (const MeshNode& node : scene.meshNodes)
    for (const glm::dmat4& transform : node.transforms) {
      const TurnedAreas& mesh = areas[static_cast<std::size_t>(node.mesh)];
      all += areaScale(transform) * mesh.all;
      turned += areaScale(transform) * mesh.turned;
    }
  found.share = all > 0.0 ? turned / all : 0.0;
  return found;
}

}  // namespace prelight
