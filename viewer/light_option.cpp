#include "viewer/light_option.h"

#include <numbers>
#include <string>

#include "viewer/area_light_option.h"
#include "viewer/light_fields.h"

namespace prelight::viewer {
namespace {

void readCone(const LightFields& fields, std::size_t i, Light& light) {
  const std::vector<double> cone = fields.numbers(fields[i], 2, "the cone");
  if (!(0.0 <= cone[0] && cone[0] <= cone[1] && cone[1] <= 90.0))
    fields.refuse("the cone's half angles are not 0 <= inner <= outer <= 90 degrees");
  light.innerConeAngle = static_cast<float>(cone[0] * std::numbers::pi / 180.0);
  light.outerConeAngle = static_cast<float>(cone[1] * std::numbers::pi / 180.0);
}

}  // namespace

Light parseLight(std::string_view text) {
  LightFields fields(text);
  const std::string kind(fields[0]);
  if (kind == "area") return parseAreaLight(fields);
  Light light;
  light.name = kind;
  if (kind == "point") {
    fields.expectFields(kind, 1, 2);
    light.type = LightType::Point;
    light.position = fields.position(1);
    light.intensity = fields.color(2);
  } else if (kind == "directional") {
    fields.expectFields(kind, 1, 2);
    light.type = LightType::Directional;
    light.direction = fields.direction(1);
    light.intensity = fields.color(2);
  } else if (kind == "spot") {
    fields.expectFields(kind, 1, 4);
    light.type = LightType::Spot;
    light.position = fields.position(1);
    light.direction = fields.direction(2);
    readCone(fields, 3, light);
    light.intensity = fields.color(4);
  } else {
    fields.refuse("unknown kind of light '" + kind + "', expected point, directional, spot or area");
  }
  return light;
}

}  // namespace prelight::viewer
