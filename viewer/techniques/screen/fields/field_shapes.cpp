#include "viewer/techniques/screen/fields/field_shapes.h"

#include <algorithm>
#include <utility>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "occluders/rigid_motion.h"

namespace prelight::viewer {
namespace {

constexpr std::uint64_t ownRays = 256;  ///< a vertex
constexpr double likeness = 1e-5;       ///< of objects of one shape, of the longest side of their bounds

/// The occlusion field of an object alone, within the radius.
std::vector<float> ownAccessibilityOf(const CompiledScene& object, const Device& device,
                                      const OcclusionFieldOptions& options) {
  BakeRequest request;
  request.ao = true;
  request.effort.rays = ownRays;
  request.seed = options.seed;
  request.limits.farthest = options.radius;
  Progress silent;
  BakeReport report;
  return bakeScene(object, request, makePlan({}, object, request), device, silent, report).ao;
}

}  // namespace

FieldShapes::FieldShapes(const CompiledScene& scene, const Device& device,
                         const OcclusionFieldOptions& options) {
  Progress silent;
  for (SceneObject& object : objectsOf(scene)) {
    const int mesh = scene.primitives[object.primitives.front()].mesh;
    std::vector<glm::vec3> places = placesOf(scene, object);
    Placed& placed = objects_.emplace_back();
    placed.object = std::move(object);
    if (findShape(mesh, placed, places)) continue;
    const CompiledScene alone = occluderOf(scene, placed.object);
    if (alone.triangles.empty()) continue;
    placed.shape = shapes_.size();
    shapes_.push_back({mesh, std::move(places), castOcclusionField(alone, device, options, silent),
                       ownAccessibilityOf(alone, device, options)});
  }
}

/// Sets the shape and motion of an object that an earlier one is like.
bool FieldShapes::findShape(int mesh, Placed& placed, const std::vector<glm::vec3>& places) const {
  for (std::size_t s = 0; mesh >= 0 && s < shapes_.size(); ++s) {
    const FieldShape& shape = shapes_[s];
    if (shape.mesh != mesh || shape.places.size() != places.size()) continue;
    const RigidFit fit = fitMotion(shape.places, places);
    const glm::dvec3 sides = shape.field.grid.max - shape.field.grid.min;
    if (fit.deviation > likeness * std::max({sides.x, sides.y, sides.z})) continue;
    placed.shape = s;
    placed.motion = fit.motion;
    return true;
  }
  return false;
}

void FieldShapes::follow(const CompiledScene& scene) {
  for (Placed& placed : objects_)
    if (placed.shape != none)
      placed.motion = fitMotion(shapes_[placed.shape].places, placesOf(scene, placed.object)).motion;
}

std::vector<float> FieldShapes::ownAccessibility(const CompiledScene& scene) const {
  std::vector<float> own(scene.vertexCount(), 1.0f);
  for (const Placed& placed : objects_) {
    if (placed.shape == none) continue;
    auto next = shapes_[placed.shape].own.begin();
    for (const std::size_t p : placed.object.primitives) {
      const PrimitiveRange& range = scene.primitives[p];
      const auto end = next + range.vertexCount;
      std::copy(next, end, own.begin() + range.firstVertex);
      next = end;
    }
  }
  return own;
}

std::vector<float> FieldShapes::ownersOf(const CompiledScene& scene) const {
  std::vector<float> owners(scene.triangleCount(), -1.0f);
  for (std::size_t o = 0; o < objects_.size(); ++o)
    for (const std::size_t p : objects_[o].object.primitives) {
      const PrimitiveRange& range = scene.primitives[p];
      std::fill_n(owners.begin() + range.firstTriangle, range.triangleCount, static_cast<float>(o));
    }
  return owners;
}

}  // namespace prelight::viewer
