#include "scene/deform.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <numeric>
#include <utility>

namespace prelight {

namespace {

/// Positions and directions of a primitive in double precision.
struct VertexFrames {
  std::vector<glm::dvec3> positions, normals, tangents;
};

template <class Vector>
std::vector<glm::dvec3> widened(const std::vector<Vector>& values) {
  std::vector<glm::dvec3> wide;
  wide.reserve(values.size());
  for (const Vector& value : values) wide.emplace_back(value);
  return wide;
}

/// Adds the weighted deltas of a target, if it has any and the primitive has the attribute.
template <class Value, class Delta>
void addScaled(std::vector<Value>& values, const std::vector<Delta>& deltas, float weight) {
  if (deltas.size() != values.size()) return;
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] += static_cast<typename Value::value_type>(weight) * Value(deltas[i]);
}

bool usesWeight(std::span<const float> weights) {
  return std::any_of(weights.begin(), weights.end(), [](float w) { return w != 0.0f; });
}

void addTargets(std::span<const float> weights, const std::vector<MorphTarget>& targets, Primitive& primitive,
                VertexFrames& frames) {
  for (std::size_t t = 0; t < std::min(weights.size(), targets.size()); ++t) {
    if (weights[t] == 0.0f) continue;
    addScaled(frames.positions, targets[t].positions, weights[t]);
    addScaled(frames.normals, targets[t].normals, weights[t]);
    addScaled(frames.tangents, targets[t].tangents, weights[t]);
    addScaled(primitive.texCoords0, targets[t].texCoords0, weights[t]);
    addScaled(primitive.texCoords1, targets[t].texCoords1, weights[t]);
    addScaled(primitive.colors, targets[t].colors, weights[t]);
  }
  for (glm::vec4& color : primitive.colors)
    for (int c = 0; c < 4; ++c)  // NaN becomes 0
      color[c] = color[c] > 0.0f ? std::min(color[c], 1.0f) : 0.0f;
}

/// Bends a primitive by its skin; `source` has the joints. Where a matrix mirrors, the bitangent is reversed,
/// which the cross product of normal and tangent would not do.
void bend(const Primitive& source, std::span<const glm::dmat4> jointsToWorld, Primitive& primitive,
          VertexFrames& frames) {
  std::size_t mirrored = 0;
  for (std::size_t v = 0; v < frames.positions.size(); ++v) {
    const glm::dmat4 matrix = blendedTransform(source, v, jointsToWorld);
    frames.positions[v] = glm::dvec3(matrix * glm::dvec4(frames.positions[v], 1.0));
    if (!frames.normals.empty()) frames.normals[v] = normalMatrix(matrix) * frames.normals[v];
    if (!frames.tangents.empty()) frames.tangents[v] = glm::dmat3(matrix) * frames.tangents[v];
    if (!mirrors(matrix)) continue;
    ++mirrored;
    if (!primitive.tangents.empty()) primitive.tangents[v].w *= -1.0f;
  }
  if (2 * mirrored <= frames.positions.size()) return;
  for (glm::uvec3& triangle : primitive.triangles) std::swap(triangle.y, triangle.z);
}

void narrow(const VertexFrames& frames, const glm::dvec3& anchor, Primitive& primitive) {
  for (std::size_t v = 0; v < frames.positions.size(); ++v)
    primitive.positions[v] = glm::vec3(frames.positions[v] - anchor);
  for (std::size_t v = 0; v < frames.normals.size(); ++v)
    primitive.normals[v] = glm::vec3(unitOrZero(frames.normals[v]));
  for (std::size_t v = 0; v < frames.tangents.size(); ++v)
    primitive.tangents[v] = {glm::vec3(unitOrZero(frames.tangents[v])), primitive.tangents[v].w};
}

/// Returns a copy without targets and joints, which have been applied.
Primitive copyOf(const Primitive& source) {
  Primitive copy;
  copy.positions = source.positions;
  copy.normals = source.normals;
  copy.tangents = source.tangents;
  copy.texCoords0 = source.texCoords0;
  copy.texCoords1 = source.texCoords1;
  copy.colors = source.colors;
  copy.triangles = source.triangles;
  copy.material = source.material;
  copy.turns = source.turns;
  copy.bothSides = source.bothSides;
  return copy;
}

}  // namespace

Shapes shapesOf(const Scene& scene) {
  Shapes shapes;
  for (const Skin& skin : scene.skins) shapes.joints.push_back(skin.toWorld);
  for (const MeshNode& node : scene.meshNodes) shapes.weights.push_back(node.weights);
  return shapes;
}

bool isDeformed(const Scene& scene, const MeshNode& node) {
  if (node.skin >= 0) return true;
  if (!usesWeight(node.weights)) return false;
  const std::vector<Primitive>& primitives = scene.meshes[static_cast<std::size_t>(node.mesh)].primitives;
  return std::any_of(primitives.begin(), primitives.end(),
                     [](const Primitive& p) { return !p.targets.empty(); });
}

DeformedMesh deformedMesh(const Scene& scene, const MeshNode& node) {
  const Mesh& mesh = scene.meshes[static_cast<std::size_t>(node.mesh)];
  const bool skinned = node.skin >= 0;
  DeformedMesh result;
  result.mesh.name = mesh.name;
  bool anchored = !skinned;
  for (const Primitive& source : mesh.primitives) {
    Primitive& primitive = result.mesh.primitives.emplace_back(copyOf(source));
    VertexFrames frames{widened(source.positions), widened(source.normals), widened(source.tangents)};
    addTargets(node.weights, source.targets, primitive, frames);
    if (skinned) bend(source, scene.skins[static_cast<std::size_t>(node.skin)].toWorld, primitive, frames);
    if (!anchored && !frames.positions.empty()) {
      result.anchor = frames.positions.front();
      anchored = true;
    }
    narrow(frames, result.anchor, primitive);
  }
  return result;
}

glm::dmat4 blendedTransform(const Primitive& primitive, std::size_t vertex,
                            std::span<const glm::dmat4> jointsToWorld) {
  glm::dmat4 sum(0.0);
  const std::size_t first = vertex * primitive.influences;
  for (std::size_t i = first; i < first + primitive.influences; ++i)
    if (primitive.jointWeights[i] > 0.0f)
      sum += double(primitive.jointWeights[i]) * jointsToWorld[primitive.joints[i]];
  // Weights add up to 1 except for rounding, which would be visible far from the origin.
  return sum[3][3] > 0.0 ? sum / sum[3][3] : sum;
}

glm::dmat3 normalMatrix(const glm::dmat4& matrix) {
  const glm::dvec3 x(matrix[0]), y(matrix[1]), z(matrix[2]);
  const glm::dmat3 cofactors(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
  return glm::dot(x, cofactors[0]) < 0.0 ? -cofactors : cofactors;
}

bool mirrors(const glm::dmat4& matrix) {
  return glm::dot(glm::dvec3(matrix[0]), glm::cross(glm::dvec3(matrix[1]), glm::dvec3(matrix[2]))) < 0.0;
}

DrawnMeshes::DrawnMeshes(const Scene& scene) : scene_(scene) {
  // Nodes with the same mesh and weights share the result; each node with a skin has its own.
  std::map<std::pair<int, std::vector<float>>, int> known;
  for (const MeshNode& node : scene.meshNodes) {
    int shape = node.mesh;
    if (isDeformed(scene, node)) {
      const auto fresh = static_cast<int>(scene.meshes.size() + deformed_.size());
      shape = node.skin >= 0 ? fresh : known.try_emplace({node.mesh, node.weights}, fresh).first->second;
      if (shape == fresh) deformed_.push_back(deformedMesh(scene, node));
    }
    shapes_.push_back(shape);
  }
}

const Mesh& DrawnMeshes::meshOf(std::size_t meshNode) const {
  const auto shape = static_cast<std::size_t>(shapes_[meshNode]);
  const std::size_t own = scene_.meshes.size();
  return shape < own ? scene_.meshes[shape] : deformed_[shape - own].mesh;
}

glm::dmat4 DrawnMeshes::transformOf(std::size_t meshNode, std::size_t instance) const {
  const glm::dmat4& transform = scene_.meshNodes[meshNode].transforms[instance];
  const auto shape = static_cast<std::size_t>(shapes_[meshNode]);
  const std::size_t own = scene_.meshes.size();
  return shape < own ? transform : glm::translate(transform, deformed_[shape - own].anchor);
}

namespace {

constexpr double leastAreaShare = 1e-12;  // share of the mean

}  // namespace

std::vector<double> surfaceOfVertices(const CompiledScene& scene) {
  std::vector<double> areas(scene.vertexCount(), 0.0);
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const double third = glm::length(geometricNormal(scene, t)) / 6.0;
    for (int corner = 0; corner < 3; ++corner) areas[scene.triangles[t][corner]] += third;
  }
  return areas;
}

std::vector<double> positiveSurfaceOfVertices(const CompiledScene& scene) {
  std::vector<double> areas = surfaceOfVertices(scene);
  const double sum = std::accumulate(areas.begin(), areas.end(), 0.0);
  const double least = sum > 0.0 ? leastAreaShare * sum / static_cast<double>(areas.size()) : 1.0;
  for (double& area : areas) area = std::max(area, least);
  return areas;
}

}  // namespace prelight
