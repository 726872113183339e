#include "viewer/options/light_option.h"

#include <numbers>
#include <optional>
#include <string>

#include "viewer/options/lamp_files.h"
#include "viewer/options/light_fields.h"

namespace prelight::viewer {
namespace {

constexpr float widestCookie = 1.4f;  ///< radians, a little more than 80 degrees

void readCone(const LightFields& fields, std::size_t i, Light& light) {
  const std::vector<double> cone = fields.numbers(fields[i], 2, "the cone");
  if (!(0.0 <= cone[0] && cone[0] <= cone[1] && cone[1] <= 90.0))
    fields.refuse("the cone's half angles are not 0 <= inner <= outer <= 90 degrees");
  light.innerConeAngle = static_cast<float>(cone[0] * std::numbers::pi / 180.0);
  light.outerConeAngle = static_cast<float>(cone[1] * std::numbers::pi / 180.0);
}

/// Behind a point light: profile=FILE, aim=x,y,z and turn=DEG.
void readProfileOf(LightFields& fields, Light& light) {
  const std::optional<std::string> file = fields.takeValue("profile", 1), aim = fields.takeValue("aim", 1),
                                   turn = fields.takeValue("turn", 1);
  if (!file && (aim || turn)) fields.refuse("aim and turn belong to a profile, and there is none");
  if (!file) return;
  light.direction = aim ? fields.directionIn(*aim) : glm::dvec3(0.0, -1.0, 0.0);
  light.side = levelSide(light.direction, turn ? fields.numbers(*turn, 1, "the turn").front() : 0.0);
  light.profile = readProfile(*file);
}

/// Behind a point or spot light: radius=M.
void readRadius(LightFields& fields, Light& light) {
  if (const std::optional<std::string> radius = fields.takeValue("radius", 1))
    light.radius = static_cast<float>(fields.length(*radius, "the radius"));
}

/// Behind a directional light: angle=DEG, of the whole disk.
void readAngle(LightFields& fields, Light& light) {
  const std::optional<std::string> angle = fields.takeValue("angle", 1);
  if (!angle) return;
  const double degrees = fields.length(*angle, "the angle");
  if (degrees > 180.0) fields.refuse("the angle is more than 180 degrees");
  light.radius = static_cast<float>(degrees * std::numbers::pi / 360.0);
}

Light parsePoint(LightFields& fields) {
  Light light;
  light.type = LightType::Point;
  readProfileOf(fields, light);
  readRadius(fields, light);
  fields.expectFields("point", 1, 2);
  light.position = fields.position(1);
  light.intensity = fields.color(2);
  return light;
}

Light parseSpot(LightFields& fields) {
  const std::optional<std::string> file = fields.takeValue("cookie", 1), turn = fields.takeValue("turn", 1);
  if (turn && !file) fields.refuse("turn belongs to a cookie, and there is none");
  Light light;
  readRadius(fields, light);
  fields.expectFields("spot", 1, 4);
  light.type = LightType::Spot;
  light.position = fields.position(1);
  light.direction = fields.direction(2);
  readCone(fields, 3, light);
  light.intensity = fields.color(4);
  if (!file) return light;
  if (!(light.outerConeAngle > 0.0f && light.outerConeAngle < widestCookie))
    fields.refuse("a cookie takes a cone of more than 0 and at most 80 degrees");
  light.side = levelSide(light.direction, turn ? fields.numbers(*turn, 1, "the turn").front() : 0.0);
  light.cookie = readCookie(*file);
  return light;
}

}  // namespace

Light parseLight(std::string_view text) {
  LightFields fields(text);
  const std::string kind(fields[0]);
  if (kind == "area") return parseAreaLight(fields);
  Light light;
  if (kind == "point") {
    light = parsePoint(fields);
  } else if (kind == "directional") {
    readAngle(fields, light);
    fields.expectFields(kind, 1, 2);
    light.type = LightType::Directional;
    light.direction = fields.direction(1);
    light.intensity = fields.color(2);
  } else if (kind == "spot") {
    light = parseSpot(fields);
  } else {
    fields.refuse("unknown kind of light '" + kind + "', expected point, directional, spot or area");
  }
  light.name = kind;
  return light;
}

}  // namespace prelight::viewer
