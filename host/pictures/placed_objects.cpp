#include "pictures/placed_objects.h"

#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/append_object.h"

namespace prelight::pictures {

namespace {

std::string nameOf(const std::filesystem::path& file, std::size_t number) {
  return number == 0 ? file.stem().string() : fmt::format("{} {}", file.stem().string(), number + 1);
}

glm::dmat4 transformOf(const PlacedObject& object) {
  const glm::dmat4 turned = glm::rotate(glm::translate(glm::dmat4(1.0), object.at),
                                        glm::radians(object.yawDegrees), glm::dvec3(0.0, 1.0, 0.0));
  return glm::scale(turned, glm::dvec3(object.scale));
}

}  // namespace

std::vector<AddedObject> addObjects(DrawingSession& session, const std::vector<PlacedObject>& objects,
                                    Scene& scene) {
  std::vector<AddedObject> added;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const PlacedObject& object = objects[i];
    std::size_t before = 0;
    for (std::size_t k = 0; k < i; ++k) before += objects[k].file.stem() == object.file.stem() ? 1 : 0;
    AddedObject one{0, session.load(object.file, {})};
    requireTriangles(one.alone);
    const std::string name = nameOf(object.file, before);
    one.node = appendObject(scene, one.alone.scene, name, transformOf(object));
    Scene alone;
    appendObject(alone, one.alone.scene, name, transformOf(object));
    one.alone.scene = std::move(alone);
    Warnings said;  // these warnings were given for the file's own scene
    one.alone.compiled = compileScene(one.alone.scene, said);
    added.push_back(std::move(one));
  }
  return added;
}

}  // namespace prelight::pictures
