#include "cli/placed_objects.h"

#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>

#include "cli/values.h"
#include "scene/append_object.h"

namespace prelight::cli {

namespace {

constexpr double farthestObject = 1e6;  // m, degrees, times

std::string nameOf(const std::filesystem::path& file, std::size_t number) {
  return number == 0 ? file.stem().string() : fmt::format("{} {}", file.stem().string(), number + 1);
}

}  // namespace

glm::dmat4 PlacedObject::transform() const {
  const glm::dmat4 turned =
      glm::rotate(glm::translate(glm::dmat4(1.0), at), glm::radians(yawDegrees), glm::dvec3(0.0, 1.0, 0.0));
  return glm::scale(turned, glm::dvec3(scale));
}

PlacedObject parsePlacedObject(const std::string& text) {
  const auto fail = [&](const char* what) {
    return UsageError("--object " + text, what,
                      "expected FILE:x,y,z, FILE:x,y,z:yaw or FILE:x,y,z:yaw:scale, for example "
                      "ball.glb:0.5,0,0:30:2");
  };
  PlacedObject object;
  std::vector<double> after;  // what follows the coordinates, the last first
  for (std::size_t end = text.size();;) {
    const std::size_t colon = end == 0 ? std::string::npos : text.rfind(':', end - 1);
    if (colon == std::string::npos || colon == 0) throw fail("no file or no place is given");
    const auto numbers = numbersIn(std::string_view(text).substr(colon + 1, end - colon - 1), farthestObject);
    if (!numbers || (numbers->size() != 3 && (numbers->size() != 1 || after.size() == 2)))
      throw fail("its coordinates are not three numbers");
    end = colon;
    if (numbers->size() == 1) {
      after.push_back(numbers->front());
      continue;
    }
    object.at = {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
    object.file = text.substr(0, colon);
    break;
  }
  if (!after.empty()) object.yawDegrees = after.back();
  if (after.size() == 2) object.scale = after.front();
  if (!(object.scale > 0.0)) throw fail("its scale is not above 0");
  return object;
}

void addObjectOption(CLI::App& app, std::vector<PlacedObject>& objects, const std::string& help) {
  app.add_option_function<std::vector<std::string>>(
         "--object",
         [&](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) objects.push_back(parsePlacedObject(text));
         },
         help + ": FILE:x,y,z[:yaw[:scale]], where its origin goes, metres and degrees; repeat it for more")
      ->type_name("OBJECT")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

std::vector<AddedObject> addObjects(Session& session, const std::vector<PlacedObject>& objects,
                                    Scene& scene) {
  std::vector<AddedObject> added;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const PlacedObject& object = objects[i];
    std::size_t before = 0;
    for (std::size_t k = 0; k < i; ++k) before += objects[k].file.stem() == object.file.stem() ? 1 : 0;
    AddedObject one{0, session.load(object.file)};
    requireTriangles(one.alone);
    const std::string name = nameOf(object.file, before);
    one.node = appendObject(scene, one.alone.scene, name, object.transform());
    Scene alone;
    appendObject(alone, one.alone.scene, name, object.transform());
    one.alone.scene = std::move(alone);
    Warnings said;  // by the file's own scene already
    one.alone.compiled = compileScene(one.alone.scene, said);
    added.push_back(std::move(one));
  }
  return added;
}

}  // namespace prelight::cli
