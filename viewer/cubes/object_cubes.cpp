#include "viewer/cubes/object_cubes.h"

#include <algorithm>

#include "relight/vertex_lights.h"
#include "viewer/programs/texture_units.h"

namespace prelight::viewer {

namespace {

constexpr float smallWay = 0.01f;  ///< of the scene's diagonal: so far lamps move from picture to picture
constexpr double smallTurn = 0.1;  ///< the sky, radians

/// Whether a cube map may show a light for some pictures more.
bool isLittleChange(const Illumination& before, const Illumination& now, float reach) {
  const float small = smallWay * reach;
  if (std::abs(now.skyRotation - before.skyRotation) > smallTurn) return false;
  if (now.lights.size() != before.lights.size()) return false;
  for (std::size_t k = 0; k < now.lights.size(); ++k) {
    ShadedLight moved = before.lights[k];
    if (glm::distance(moved.position, now.lights[k].position) > small) return false;
    moved.position = now.lights[k].position;
    if (moved != now.lights[k]) return false;
  }
  Illumination rest = before;
  rest.skyRotation = now.skyRotation;
  rest.lights = now.lights;
  return rest == now;
}

/// [vertex of the scene]
std::vector<glm::vec3> opennessOf(const CompiledScene& compiled, std::span<const VertexRange> objects,
                                  std::span<const glm::vec3> openness) {
  std::vector<glm::vec3> values(compiled.vertexCount(), glm::vec3(1.0f));
  for (const VertexRange& range : objects) {
    if (openness.size() < range.vertexCount) break;
    std::copy_n(openness.begin(), range.vertexCount, values.begin() + range.firstVertex);
    openness = openness.subspan(range.vertexCount);
  }
  return values;
}

}  // namespace

ObjectCubes::ObjectCubes(const CompiledScene& compiled, std::span<const VertexRange> objects,
                         std::span<const glm::vec3> openness)
    : target_(2 * side, 2 * side),
      cubes_(makeCubeMaps(side, objects.size(), true)),
      projection_(side, objects.size(), order),
      openness_(Attribute::Openness, std::span<const glm::vec3>(opennessOf(compiled, objects, openness))) {
  for (const VertexRange& range : objects) objects_.push_back({range});
  place(compiled);
  changed();
}

void ObjectCubes::place(const CompiledScene& compiled) {
  reach_ = glm::length(compiled.boundsMax - compiled.boundsMin);
  for (Object& object : objects_) {
    const ObjectBounds bounds = boundsOf(compiled, object.range);
    object.center = 0.5f * (bounds.lower + bounds.upper);
    object.radius = 0.5f * glm::length(bounds.upper - bounds.lower);
  }
}

void ObjectCubes::changed() {
  // Twice where objects show each other: what the first round drew is seen in the second.
  waiting_ = (objects_.size() > 1 ? 2 : 1) * facesOfACube * objects_.size();
  atOnce_ = true;
}

void ObjectCubes::changedSlowly() { waiting_ = std::max(waiting_, facesOfACube * objects_.size()); }

void ObjectCubes::lit(const Illumination& light, Shading shading) {
  if (light_ != light || shading_ != shading) {
    const bool little = light_ && shading_ == shading && isLittleChange(*light_, light, reach_);
    little ? changedSlowly() : changed();
  }
  light_ = light;
  shading_ = shading;
}

void ObjectCubes::moved(const CompiledScene& compiled) {
  place(compiled);
  changedSlowly();
  if (std::any_of(objects_.begin(), objects_.end(), [&](const Object& o) { return hasMovedFar(o); }))
    changed();
}

bool ObjectCubes::hasMovedFar(const Object& object) const {
  return std::any_of(object.seenFrom.begin(), object.seenFrom.end(), [&](const glm::vec3& from) {
    return double{glm::distance(object.center, from)} > jump * double{object.radius};
  });
}

void ObjectCubes::update(const CompiledScene& compiled, std::size_t mostFaces,
                         const std::function<void(const Face&, const gl::Framebuffer&)>& draw) {
  facesDrawn_ = 0;
  const std::size_t most = atOnce_ ? waiting_ : std::min(waiting_, mostFaces);
  for (; facesDrawn_ < most; --waiting_, ++facesDrawn_) {
    Object& object = objects_[next_ / facesOfACube];
    const std::size_t face = next_ % facesOfACube;
    object.seenFrom[face] = object.center;
    draw({cubeFaceCamera(compiled.origin + glm::dvec3(object.center), face,
                         nearestInCube(compiled, object.radius)),
          object.range},
         target_);
    copyToCube(target_, copyTarget_, cubes_, next_);
    next_ = (next_ + 1) % (facesOfACube * objects_.size());
    if (next_ % facesOfACube == 0 || facesDrawn_ + 1 == most)
      projection_.project(cubes_, static_cast<std::size_t>(&object - objects_.data()));
  }
  atOnce_ = false;
  if (facesDrawn_ == 0) return;
  gl::bind(surroundingsUnit, GL_TEXTURE_CUBE_MAP_ARRAY, cubes_);
  glGenerateMipmap(GL_TEXTURE_CUBE_MAP_ARRAY);
  gl::check("drawing the light around objects");
}

void ObjectCubes::bindTextures() const {
  gl::bind(surroundingsUnit, GL_TEXTURE_CUBE_MAP_ARRAY, cubes_);
  gl::bind(objectLightUnit, GL_TEXTURE_2D, projection_.coefficients());
}

int ObjectCubes::objectOf(const Batch& batch) const {
  const auto found = std::find_if(objects_.begin(), objects_.end(), [&](const Object& object) {
    return batch.firstTriangle - object.range.firstTriangle < object.range.triangleCount;
  });
  return found == objects_.end() ? -1 : static_cast<int>(found - objects_.begin());
}

void ObjectCubes::set(const gl::Program& program, const Batch& batch) const {
  const int object = objectOf(batch);
  program.set("cube", object);
  if (object < 0) return;
  program.set("cubeCenter", objects_[static_cast<std::size_t>(object)].center);
  program.set("cubeReach", reach_);
}

}  // namespace prelight::viewer
