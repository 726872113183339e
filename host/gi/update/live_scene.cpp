#include "gi/update/live_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "prelight/error.h"
#include "scene/light_sources.h"

namespace prelight {

namespace {

void keepOnce(std::vector<std::uint32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

std::vector<std::size_t> nodesOfPrimitives(const Scene& scene, const CompiledScene& compiled) {
  std::vector<std::size_t> found;
  for (const PrimitiveRange& range : compiled.primitives) {
    const auto node = std::find_if(scene.meshNodes.begin(), scene.meshNodes.end(),
                                   [&](const MeshNode& n) { return n.node == range.node; });
    found.push_back(node == scene.meshNodes.end() ? scene.nodes.size() : node->sceneNode);
  }
  return found;
}

/// Returns the nodes of the lights. Lights that are not the file's belong to no node.
std::vector<std::size_t> nodesOfLights(const Scene& scene, const CompiledScene& compiled) {
  std::vector<std::size_t> found(compiled.lights.size(), scene.nodes.size());
  for (std::size_t i = 0; i < std::min(found.size(), scene.lights.size()); ++i)
    if (compiled.lights[i].position == scene.lights[i].position &&
        compiled.lights[i].direction == scene.lights[i].direction)
      found[i] = scene.lights[i].sceneNode;
  return found;
}

}  // namespace

bool haveSameTriangles(const CompiledScene& a, const CompiledScene& b) {
  return a.triangles == b.triangles &&
         std::equal(a.instances.begin(), a.instances.end(), b.instances.begin(), b.instances.end(),
                    [](const CompiledInstance& x, const CompiledInstance& y) {
                      return x.firstTriangle == y.firstTriangle && x.shape == y.shape;
                    }) &&
         std::equal(
             a.shapes.begin(), a.shapes.end(), b.shapes.begin(), b.shapes.end(),
             [](const CompiledShape& x, const CompiledShape& y) { return x.positions == y.positions; });
}

LiveScene::LiveScene(const Scene& scene, CompiledScene compiled)
    : nodes_(scene.nodes),
      primitiveNodes_(nodesOfPrimitives(scene, compiled)),
      compiled_(std::move(compiled)),
      restInstances_(compiled_.instances),
      restPositions_(compiled_.positions),
      restNormals_(compiled_.normals),
      restLights_(compiled_.lights),
      lightNodes_(nodesOfLights(scene, compiled_)),
      lightMotions_(compiled_.lights.size()) {}

/// Returns 1 for a node and its descendants, [node of the scene].
std::vector<std::uint8_t> LiveScene::hangsOn(int node) const {
  std::vector<std::uint8_t> hangs(nodes_.size() + 1, 0);
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    hangs[i] = nodes_[i].node == node ||
               (nodes_[i].parent >= 0 && hangs[static_cast<std::size_t>(nodes_[i].parent)] != 0);
  return hangs;
}

std::vector<std::uint32_t> LiveScene::trianglesOf(int node) const {
  const std::vector<std::uint8_t> hangs = hangsOn(node);
  std::vector<std::uint32_t> triangles;
  for (std::size_t p = 0; p < compiled_.primitives.size(); ++p) {
    const PrimitiveRange& range = compiled_.primitives[p];
    if (hangs[primitiveNodes_[p]] == 0) continue;
    for (std::uint32_t i = 0; i < range.triangleCount; ++i) triangles.push_back(range.firstTriangle + i);
  }
  keepOnce(triangles);
  return triangles;
}

void LiveScene::moveNode(int node, const RigidMotion& motion) {
  const std::vector<std::uint8_t> hangs = hangsOn(node);
  bool found = false;
  for (std::size_t p = 0; p < compiled_.primitives.size(); ++p) {
    const PrimitiveRange& range = compiled_.primitives[p];
    if (hangs[primitiveNodes_[p]] == 0 || range.triangleCount == 0) continue;
    found = true;
    for (std::uint32_t v = range.firstVertex; v < range.firstVertex + range.vertexCount; ++v) {
      const glm::dvec3 rest = glm::dvec3(restPositions_[v]) + compiled_.origin;
      compiled_.positions[v] = glm::vec3(motion.point(rest) - compiled_.origin);
      compiled_.normals[v] = glm::vec3(motion.direction(glm::dvec3(restNormals_[v])));
    }
    for (std::uint32_t i = 0; i < range.triangleCount; ++i)
      changes_.triangles.push_back(range.firstTriangle + i);
    moveInstance(range.firstTriangle, motion);
  }
  for (std::size_t i = 0; i < restLights_.size(); ++i) {
    if (hangs[lightNodes_[i]] == 0) continue;
    found = true;
    lightMotions_[i] = motion;
    compiled_.lights[i].position = motion.point(restLights_[i].position);
    compiled_.lights[i].direction = motion.direction(restLights_[i].direction);
    compiled_.lights[i].side = motion.direction(restLights_[i].side);
    changes_.lights.push_back(static_cast<std::uint32_t>(i));
  }
  if (!found)
    throw UsageError(fmt::format("node {}", node),
                     "it carries no mesh and no light, expected a node that can be moved");
}

/// Moves the instance whose triangles begin with this one, if there is one.
void LiveScene::moveInstance(std::uint32_t firstTriangle, const RigidMotion& motion) {
  std::vector<CompiledInstance>& all = compiled_.instances;
  const auto found = std::lower_bound(
      all.begin(), all.end(), firstTriangle,
      [](const CompiledInstance& instance, std::uint32_t first) { return instance.firstTriangle < first; });
  if (found == all.end() || found->firstTriangle != firstTriangle) return;
  const glm::dmat4& rest = restInstances_[static_cast<std::size_t>(found - all.begin())].toWorld;
  for (int column = 0; column < 3; ++column)
    found->toWorld[column] = glm::dvec4(motion.direction(glm::dvec3(rest[column])), 0.0);
  const glm::dvec3 centre = motion.point(glm::dvec3(rest[3]) + compiled_.origin) - compiled_.origin;
  found->toWorld[3] = glm::dvec4(centre, 1.0);
}

void LiveScene::posePrimitive(const PrimitiveRange& range, const CompiledScene& posed) {
  const auto take = [&](const auto& from, auto& to) {
    if (from.empty()) return false;
    const auto first = from.begin() + range.firstVertex, last = first + range.vertexCount;
    const auto target = to.begin() + range.firstVertex;
    if (std::equal(first, last, target)) return false;
    std::copy(first, last, target);
    return true;
  };
  const bool moved = take(posed.positions, compiled_.positions);
  const bool turned = take(posed.normals, compiled_.normals);
  if (!take(posed.tangents, compiled_.tangents) && !moved && !turned) return;
  take(posed.positions, restPositions_);
  take(posed.normals, restNormals_);
  for (std::uint32_t i = 0; i < range.triangleCount; ++i)
    changes_.triangles.push_back(range.firstTriangle + i);
}

void LiveScene::pose(const CompiledScene& posed) {
  if (posed.origin != compiled_.origin || !haveSameTriangles(posed, compiled_))
    throw UsageError("a pose of the scene",
                     "its triangles or its origin have changed, expected the same ones");
  for (const PrimitiveRange& range : compiled_.primitives) posePrimitive(range, posed);
  compiled_.instances = restInstances_ = posed.instances;
}

void LiveScene::setLight(std::size_t index, const Light& light) {
  if (index >= compiled_.lights.size() || compiled_.lights[index].type != light.type)
    throw UsageError(
        fmt::format("light {}", index),
        fmt::format("there are {} lights; expected one of them, of the same type", compiled_.lights.size()));
  compiled_.lights[index] = restLights_[index] = light;
  restLights_[index].position = lightMotions_[index].pointBefore(light.position);
  const glm::dmat3 back = glm::transpose(lightMotions_[index].rotation);
  restLights_[index].direction = back * light.direction;
  restLights_[index].side = back * light.side;
  changes_.lights.push_back(static_cast<std::uint32_t>(index));
}

SceneChange LiveScene::takeChanges() {
  SceneChange changes = std::move(changes_);
  changes_ = {};
  keepOnce(changes.triangles);
  keepOnce(changes.lights);
  return changes;
}

bool LiveScene::growBounds() {
  const glm::vec3 centre = 0.5f * (compiled_.boundsMin + compiled_.boundsMax);
  const float radius = 0.5f * glm::length(compiled_.boundsMax - compiled_.boundsMin);
  const std::vector<glm::vec3>& all = compiled_.positions;
  if (std::all_of(all.begin(), all.end(),
                  [&](const glm::vec3& p) { return glm::length(p - centre) <= radius * 1.000001f; }))
    return false;
  for (const glm::vec3& p : all) {
    compiled_.boundsMin = glm::min(compiled_.boundsMin, p);
    compiled_.boundsMax = glm::max(compiled_.boundsMax, p);
  }
  return true;
}

namespace {

bool givesLight(const CompiledScene& scene, std::span<const std::uint32_t> triangles) {
  return std::any_of(triangles.begin(), triangles.end(), [&](std::uint32_t t) {
    return shines(scene.materials[scene.triangleMaterials[t]].emission);
  });
}

}  // namespace

void MovingTriangles::add(const CompiledScene& compiled, TransportScene& transport,
                          std::span<const std::uint32_t> triangles) {
  const std::size_t before = separated_.size();
  separated_.insert(separated_.end(), triangles.begin(), triangles.end());
  std::sort(separated_.begin(), separated_.end());
  separated_.erase(std::unique(separated_.begin(), separated_.end()), separated_.end());
  if (separated_.size() > before) transport.tracer().separate(compiled, separated_);
}

bool followChange(const SceneChange& change, LiveScene& scene, MovingTriangles& moving,
                  TransportScene& transport) {
  const bool grown = scene.growBounds();
  if (!change.triangles.empty()) {
    moving.add(scene.compiled(), transport, change.triangles);
    transport.follow(scene.compiled());
  }
  const bool shinesAnew = grown || !change.lights.empty() || givesLight(scene.compiled(), change.triangles);
  return shinesAnew && transport.setLights(scene.compiled(), scene.compiled().lights);
}

}  // namespace prelight
