#include "scene/surface/tangent_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <unordered_map>

namespace prelight {

namespace {

/// Returns the texture along whose coordinates the tangents of a material lie.
const TextureRef& alongWhich(const CompiledMaterial& m) {
  if (m.normalTexture.image >= 0) return m.normalTexture;
  return m.anisotropy.texture.image >= 0 ? m.anisotropy.texture : m.clearcoat.normalTexture;
}

/// Properties that corners must have in common to share a tangent: position, normal, texture coordinates.
using CornerKey = std::array<float, 8>;

struct KeyHash {
  std::size_t operator()(const CornerKey& key) const {
    std::size_t hash = 0;
    for (const float value : key) hash = hash * 1000003u ^ std::hash<float>()(value);
    return hash;
  }
};

glm::dvec3 unitOrNone(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0.0 ? v / length : glm::dvec3(0.0);
}

glm::dvec3 perpendicularPart(const glm::dvec3& v, const glm::dvec3& normal) {
  return unitOrNone(v - glm::dot(v, normal) * normal);
}

/// Groups of corners that share a tangent.
class Groups {
 public:
  explicit Groups(std::size_t corners) : parent_(corners) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t of(std::uint32_t corner) {
    while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
    return corner;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t first = of(a), second = of(b);
    parent_[std::max(first, second)] = std::min(first, second);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// The orientation of a texture on a triangle.
struct Face {
  glm::dvec3 alongU{0.0};  ///< unit; 0 where the coordinates span no area
  bool mirrored = false;   ///< the texture is seen from behind
};

class TangentSpace {
 public:
  TangentSpace(const CompiledScene& scene, std::vector<std::uint32_t> triangles)
      : scene_(scene), triangles_(std::move(triangles)), groups_(3 * triangles_.size()) {}

  void write(std::vector<glm::vec4>& tangents) {
    for (std::uint32_t f = 0; f < triangles_.size(); ++f) addFace(f);
    joinAcrossEdges();
    sumUp();
    for (std::uint32_t f = 0; f < triangles_.size(); ++f)
      for (std::uint32_t k = 0; k < 3; ++k) tangents[3 * triangles_[f] + k] = tangentAt(3 * f + k);
  }

 private:
  glm::uvec3 cornersOf(std::uint32_t face) const { return scene_.triangles[triangles_[face]]; }

  glm::dvec3 normalAt(std::uint32_t corner) const {
    const std::uint32_t triangle = triangles_[corner / 3];
    if (scene_.triangleFlat[triangle] != 0) return unitOrNone(geometricNormal(scene_, triangle));
    return glm::dvec3(scene_.normals[scene_.triangles[triangle][corner % 3]]);
  }

  glm::dvec2 coordAt(std::uint32_t corner) const {
    const std::uint32_t triangle = triangles_[corner / 3];
    const TextureRef& use = alongWhich(scene_.materials[scene_.triangleMaterials[triangle]]);
    const auto& coords = use.texCoord == 1 ? scene_.texCoords1 : scene_.texCoords;
    const glm::vec2 uv = coords[scene_.triangles[triangle][corner % 3]];
    return glm::dvec2(glm::dmat3(use.transform) * glm::dvec3(uv, 1.0));
  }

  glm::dvec3 positionAt(std::uint32_t corner) const {
    return glm::dvec3(scene_.positions[cornersOf(corner / 3)[corner % 3]]);
  }

  void addFace(std::uint32_t f) {
    const glm::dvec3 e1 = positionAt(3 * f + 1) - positionAt(3 * f),
                     e2 = positionAt(3 * f + 2) - positionAt(3 * f);
    const glm::dvec2 d1 = coordAt(3 * f + 1) - coordAt(3 * f), d2 = coordAt(3 * f + 2) - coordAt(3 * f);
    const double determinant = d1.x * d2.y - d2.x * d1.y;
    Face face;
    face.mirrored = determinant > 0.0;  // v grows downwards
    if (determinant != 0.0)
      face.alongU = unitOrNone((d2.y * e1 - d1.y * e2) * (determinant > 0.0 ? 1.0 : -1.0));
    faces_.push_back(face);
    for (std::uint32_t corner = 3 * f; corner < 3 * f + 3; ++corner) {
      const glm::vec3 p(positionAt(corner)), n(normalAt(corner));
      const glm::vec2 uv(coordAt(corner));
      const CornerKey key = {p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y};
      places_.push_back(placeOf_.try_emplace(key, static_cast<std::uint32_t>(placeOf_.size())).first->second);
    }
  }

  bool hasDirection(std::uint32_t corner) const { return faces_[corner / 3].alongU != glm::dvec3(0.0); }

  /// Joins the corners at the ends of edges along which two triangles run in opposite directions and show the
  /// texture from the same side.
  void joinAcrossEdges() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>>
        open;  // by the corner at which they start
    const auto next = [](std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };
    for (std::uint32_t corner = 0; corner < places_.size(); ++corner) {
      if (!hasDirection(corner)) continue;
      const std::uint32_t a = places_[corner], b = places_[next(corner)];
      const auto other = open.find({b, a});
      if (other == open.end() || other->second.empty()) {
        open[{a, b}].push_back(corner);
        continue;
      }
      const std::uint32_t back = other->second.front();
      other->second.erase(other->second.begin());
      if (faces_[corner / 3].mirrored != faces_[back / 3].mirrored) continue;
      groups_.join(corner, next(back));
      groups_.join(next(corner), back);
    }
  }

  /// Sums directions in the plane of each corner's normal, weighted by the angles of the triangles there.
  void sumUp() {
    sums_.assign(places_.size(), glm::dvec3(0.0));
    for (std::uint32_t corner = 0; corner < places_.size(); ++corner) {
      if (!hasDirection(corner)) continue;
      const std::uint32_t first = corner - corner % 3;
      const glm::dvec3 n = normalAt(corner), p = positionAt(corner);
      const glm::dvec3 a = perpendicularPart(positionAt(first + (corner + 1) % 3) - p, n);
      const glm::dvec3 b = perpendicularPart(positionAt(first + (corner + 2) % 3) - p, n);
      const double angle = std::acos(glm::clamp(glm::dot(a, b), -1.0, 1.0));
      sums_[groups_.of(corner)] += angle * perpendicularPart(faces_[corner / 3].alongU, n);
      groupAt_.try_emplace(places_[corner], groups_.of(corner));
    }
  }

  /// Returns the tangent at a corner. A triangle without area on the texture takes the tangent of a
  /// neighbour.
  glm::vec4 tangentAt(std::uint32_t corner) {
    std::uint32_t group = groups_.of(corner);
    if (!hasDirection(corner)) {
      const auto found = groupAt_.find(places_[corner]);
      if (found != groupAt_.end()) group = found->second;
    }
    const glm::dvec3 n = normalAt(corner);
    glm::dvec3 tangent = perpendicularPart(sums_[group], n);
    if (tangent == glm::dvec3(0.0)) tangent = anyPerpendicular(n);
    return {glm::vec3(tangent), faces_[group / 3].mirrored ? -1.0f : 1.0f};
  }

  const CompiledScene& scene_;
  std::vector<std::uint32_t> triangles_;
  std::vector<Face> faces_;            ///< [face] faces of triangles_
  std::vector<std::uint32_t> places_;  ///< [corner] index; corners with equal keys share it
  std::unordered_map<CornerKey, std::uint32_t, KeyHash> placeOf_;
  Groups groups_;
  std::vector<glm::dvec3> sums_;                              ///< [group]
  std::unordered_map<std::uint32_t, std::uint32_t> groupAt_;  ///< by index of a key: one of its groups
};

bool hasFileTangents(const CompiledScene& scene, std::uint32_t triangle) {
  if (scene.tangents.empty() || scene.triangleFlat[triangle] != 0) return false;
  const glm::uvec3 t = scene.triangles[triangle];
  return scene.tangents[t.x].w != 0.0f && scene.tangents[t.y].w != 0.0f && scene.tangents[t.z].w != 0.0f;
}

}  // namespace

glm::dvec3 anyPerpendicular(const glm::dvec3& n) {
  const glm::dvec3 axis = std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return perpendicularPart(axis, n);
}

std::vector<glm::vec4> cornerTangents(const CompiledScene& scene) {
  std::vector<glm::vec4> tangents(3 * std::size_t{scene.triangleCount()}, glm::vec4(0.0f));
  std::map<std::size_t, std::vector<std::uint32_t>> without;  // triangles without file tangents, by primitive
  std::size_t primitive = 0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    while (primitive + 1 < scene.primitives.size() && scene.primitives[primitive + 1].firstTriangle <= t)
      ++primitive;
    if (!scene.materials[scene.triangleMaterials[t]].needsTangents()) continue;
    if (!hasFileTangents(scene, t)) {
      without[primitive].push_back(t);
      continue;
    }
    for (int k = 0; k < 3; ++k) tangents[3 * std::size_t{t} + k] = scene.tangents[scene.triangles[t][k]];
  }
  for (auto& [at, triangles] : without) TangentSpace(scene, std::move(triangles)).write(tangents);
  return tangents;
}

}  // namespace prelight
