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
    : compiled_(compiled),
      target_(2 * side, 2 * side),
      cubes_(makeCubeMaps(side, objects.size(), true)),
      projection_(side, objects.size(), order),
      openness_(Attribute::Openness, std::span<const glm::vec3>(opennessOf(compiled, objects, openness))) {
  for (const VertexRange& range : objects) objects_.push_back({range});
  place();
  changed();
}

void ObjectCubes::place() {
  reach_ = glm::length(compiled_.boundsMax - compiled_.boundsMin);
  for (Object& object : objects_) {
    const ObjectBounds bounds = boundsOf(compiled_, object.range);
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

void ObjectCubes::sceneMoved() {
  place();
  changedSlowly();
  if (std::any_of(objects_.begin(), objects_.end(), [&](const Object& o) { return hasMovedFar(o); }))
    changed();
}

bool ObjectCubes::hasMovedFar(const Object& object) const {
  return std::any_of(object.seenFrom.begin(), object.seenFrom.end(), [&](const glm::vec3& from) {
    return double{glm::distance(object.center, from)} > jump * double{object.radius};
  });
}

void ObjectCubes::prepare(const PictureState& picture, SceneDrawer& drawer) {
  lit(picture.light, picture.view.shading);
  const std::size_t drawn = draw(picture.pace.spread ? facesAPicture : waiting_, picture, drawer);
  picture.passed({FramePass::EnvironmentMaps, drawn});
}

/// Draws faces that are out of date and projects their cubes; `mostFaces`: of what has changed little.
/// Returns how many it drew.
std::size_t ObjectCubes::draw(std::size_t mostFaces, const PictureState& picture, SceneDrawer& drawer) {
  const View& view = picture.view;
  const bool lampsApart = view.emitters || infoOf(view.shading).rules.through == Through::AllLights;
  const std::size_t most = atOnce_ ? waiting_ : std::min(waiting_, mostFaces);
  std::size_t drawn = 0;
  for (; drawn < most; --waiting_, ++drawn) {
    Object& object = objects_[next_ / facesOfACube];
    const std::size_t face = next_ % facesOfACube;
    object.seenFrom[face] = object.center;
    const Camera camera = cubeFaceCamera(compiled_.origin + glm::dvec3(object.center), face,
                                         nearestInCube(compiled_, object.radius));
    drawer.drawFace(picture, {camera, side, {-1, object.range}, lampsApart}, target_);
    copyToCube(target_, copyTarget_, cubes_, next_, side);
    next_ = (next_ + 1) % (facesOfACube * objects_.size());
    if (next_ % facesOfACube == 0 || drawn + 1 == most)
      projection_.project(cubes_, static_cast<std::size_t>(&object - objects_.data()));
  }
  atOnce_ = false;
  if (drawn == 0) return 0;
  gl::bind(surroundingsUnit, GL_TEXTURE_CUBE_MAP_ARRAY, cubes_);
  glGenerateMipmap(GL_TEXTURE_CUBE_MAP_ARRAY);
  gl::check("drawing the light around objects");
  return drawn;
}

DrawingRules ObjectCubes::ownRules(const DrawingRules& rules) const {
  DrawingRules own = rules;
  own.ambient = {"object_ambient.glsl"};
  if (own.through == Through::FarLights) own.through = Through::None;
  return own;
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

extern const PassRow objectCubesRow = {
    .isIn = ObjectCubes::areIn,
    .make = [](const TechniqueInputs& of) -> std::unique_ptr<TechniquePass> {
      return std::make_unique<ObjectCubes>(of.inputs.compiled, of.inputs.cubeLit, of.inputs.cubeOpenness);
    },
};

}  // namespace prelight::viewer
