#include "scene/settle_sides.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scene/deform.h"
#include "scene/seen_from_behind.h"

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

namespace {

/// Share of the surface that is reported: half of what is rounded to 0.1 %.
constexpr double leastToldOf = 0.0005;

Primitive& primitiveOf(Scene& scene, const PrimitiveRange& range) {
  return scene.meshes[static_cast<std::size_t>(range.mesh)]
      .primitives[static_cast<std::size_t>(range.primitive)];
}

/// Returns [triangle of the primitive] the compiled scene's marks; 0 for triangles that were dropped.
std::vector<std::uint8_t> marksOfMesh(const CompiledScene& compiled, const PrimitiveRange& range,
                                      const Primitive& primitive, const std::vector<std::uint8_t>& marks) {
  std::vector<std::uint8_t> own(primitive.triangles.size(), 0);
  std::uint32_t next = 0;
  for (std::size_t t = 0; t < own.size() && next < range.triangleCount; ++t) {
    const glm::uvec3 drawn = compiled.triangles[range.firstTriangle + next] - glm::uvec3(range.firstVertex);
    const glm::uvec3& known = primitive.triangles[t];
    if (drawn != known && drawn != glm::uvec3(known.x, known.z, known.y)) continue;
    own[t] = marks[range.firstTriangle + next++];
  }
  return own;
}

/// Makes backs of triangles their fronts. No unchanged triangle may use one of their vertices.
void turnOver(Primitive& primitive, const std::vector<std::uint8_t>& turned) {
  std::vector<std::uint8_t> vertices(primitive.positions.size(), 0);
  primitive.turns.resize(primitive.triangles.size(), 0);
  for (std::size_t t = 0; t < turned.size(); ++t) {
    if (turned[t] == 0) continue;
    glm::uvec3& triangle = primitive.triangles[t];
    for (int corner = 0; corner < 3; ++corner) vertices[triangle[corner]] = 1;
    std::swap(triangle.y, triangle.z);
    primitive.turns[t] ^= CornersExchanged | NormalsNegated;
  }
  const auto negate = [&](std::vector<glm::vec3>& normals) {
    for (std::size_t v = 0; v < normals.size(); ++v)
      if (vertices[v] != 0) normals[v] = -normals[v];
  };
  negate(primitive.normals);
  for (MorphTarget& target : primitive.targets) negate(target.normals);
  // The bitangent is w n x t, and must stay unchanged.
  for (std::size_t v = 0; v < primitive.tangents.size(); ++v)
    if (vertices[v] != 0) primitive.tangents[v].w = -primitive.tangents[v].w;
}

/// Transfers marks of drawings to their meshes: a mesh's triangle has the marks of all its drawings.
void apply(const CompiledScene& compiled, const std::vector<std::uint8_t>& marks, Scene& scene) {
  std::map<std::pair<int, int>, std::vector<std::uint8_t>> ofMeshes;
  for (const PrimitiveRange& range : compiled.primitives) {
    const std::vector<std::uint8_t> own = marksOfMesh(compiled, range, primitiveOf(scene, range), marks);
    std::vector<std::uint8_t>& all = ofMeshes[{range.mesh, range.primitive}];
    all.resize(own.size(), 0);
    for (std::size_t t = 0; t < own.size(); ++t) all[t] |= own[t];
  }
  for (auto& [key, all] : ofMeshes) {
    Primitive& primitive =
        scene.meshes[static_cast<std::size_t>(key.first)].primitives[static_cast<std::size_t>(key.second)];
    const auto has = [](std::uint8_t bit) { return [bit](std::uint8_t mark) { return (mark & bit) != 0; }; };
    primitive.bothSides = primitive.bothSides || std::any_of(all.begin(), all.end(), has(ShowsBothSides));
    for (std::uint8_t& mark : all) mark &= FrontIsWithin;
    if (std::any_of(all.begin(), all.end(), has(FrontIsWithin))) turnOver(primitive, all);
  }
}

std::string listOf(const std::vector<std::string>& names) {
  constexpr std::size_t most = 3;
  std::string list;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i)
    list += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", names[i]);
  if (names.size() > most) list += fmt::format(" and {} more", names.size() - most);
  return list;
}

std::string percent(double share) { return fmt::format("{:.{}f} %", 100.0 * share, share < 0.0995 ? 1 : 0); }

void tellOfRooms(const CompiledScene& compiled, const std::vector<std::uint8_t>& marks, Scene& scene) {
  double all = 0.0, marked = 0.0;
  for (const PrimitiveRange& range : compiled.primitives) {
    double own = 0.0;
    for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t) {
      const double area = glm::length(geometricNormal(compiled, t));
      all += area;
      if ((marks[t] & ShowsBothSides) != 0) own += area;
    }
    marked += own;
    if (own > 0.0) scene.sides.seenFromBehindNodes.push_back(range.name);
  }
  scene.sides.seenFromBehind = marked / all;
}

}  // namespace

CompiledScene settleSides(Scene& scene, Warnings& warnings) {
  WoundBack woundBack = turnWoundBack(scene);
  scene.sides.woundBack = woundBack.share;
  scene.sides.woundBackTriangles = woundBack.triangles;
  scene.sides.woundBackMeshes = std::move(woundBack.meshes);
  Warnings ofScene;
  CompiledScene compiled = compileScene(scene, ofScene);
  warnings.insert(warnings.end(), ofScene.begin(), ofScene.end());
  std::vector<std::uint8_t> marks = wronglyTurned(scene, compiled);
  if (!marks.empty()) {
    for (std::uint8_t& mark : marks) mark = mark != 0 ? FrontIsWithin : 0;
    apply(compiled, marks, scene);
    compiled = compileScene(scene, ofScene);
  }
  if (woundBack.share >= leastToldOf)
    warnings.push_back(fmt::format(
        "mesh {}: {} of the surface is wound against its normals: turned (make winding and normals agree in "
        "the modelling program)",
        listOf(scene.sides.woundBackMeshes), percent(woundBack.share)));
  SeenFromBehind seen = seenFromBehind(scene, compiled);
  scene.sides.shutInLamps = std::move(seen.shutInLamps);
  marks = std::move(seen.marks);
  if (marks.empty()) return compiled;
  tellOfRooms(compiled, marks, scene);
  apply(compiled, marks, scene);
  if (scene.sides.seenFromBehind > 0.0)
    warnings.push_back(fmt::format(
        "node {}: {} of the surface is seen from behind, as its normals point out of the room that it "
        "encloses: taken as double-sided (turn its normals in the modelling program)",
        listOf(scene.sides.seenFromBehindNodes), percent(scene.sides.seenFromBehind)));
  return compileScene(scene, ofScene);
}

}  // namespace prelight
