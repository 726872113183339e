#include "viewer/light_option.h"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/magnitudes.h"
#include "prelight/error.h"

namespace prelight::viewer {
namespace {

constexpr const char* example =
    "for example point:0,2,0:10,10,10, directional:0,-1,0:3,3,3 or "
    "spot:0,3,0:0,-1,0:20,30:50,50,50";

[[noreturn]] void refuseLight(std::string_view text, const std::string& what) {
  throw UsageError("--light " + std::string(text), what, example);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const auto end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

double parseNumber(std::string_view text, std::string_view part, const std::string& name) {
  if (part.starts_with('+')) part.remove_prefix(1);
  double value = 0.0;
  const auto [end, status] = std::from_chars(part.data(), part.data() + part.size(), value);
  if (status != std::errc{} || end != part.data() + part.size() || part.empty()) {
    refuseLight(text, name + " has '" + std::string(part) + "' where a number is expected");
  }
  if (!(std::abs(value) <= largestInput)) refuseLight(text, name + " has a number beyond 1e15");
  return value;
}

template <std::size_t count>
std::array<double, count> parseNumbers(std::string_view text, std::string_view field,
                                       const std::string& name) {
  const auto parts = split(field, ',');
  if (parts.size() != count) {
    refuseLight(text,
                name + " takes " + std::to_string(count) + " numbers, got " + std::to_string(parts.size()));
  }
  std::array<double, count> values{};
  for (std::size_t i = 0; i < count; ++i) values[i] = parseNumber(text, parts[i], name);
  return values;
}

glm::dvec3 parsePosition(std::string_view text, std::string_view field) {
  const auto v = parseNumbers<3>(text, field, "the position");
  return {v[0], v[1], v[2]};
}

glm::dvec3 parseDirection(std::string_view text, std::string_view field) {
  const auto v = parseNumbers<3>(text, field, "the direction");
  const double length = std::hypot(v[0], v[1], v[2]);
  if (!(length > 0.0)) refuseLight(text, "the direction has no length");
  return glm::dvec3(v[0], v[1], v[2]) / length;
}

glm::vec3 parseColor(std::string_view text, std::string_view field) {
  const auto v = parseNumbers<3>(text, field, "the colour");
  for (const double channel : v) {
    if (channel < 0.0) refuseLight(text, "the colour is negative");
  }
  return {v[0], v[1], v[2]};
}

void parseCone(std::string_view text, std::string_view field, Light& light) {
  const auto [inner, outer] = parseNumbers<2>(text, field, "the cone");
  if (!(0.0 <= inner && inner <= outer && outer <= 90.0)) {
    refuseLight(text, "the cone's half angles are not 0 <= inner <= outer <= 90 degrees");
  }
  light.innerConeAngle = static_cast<float>(inner * std::numbers::pi / 180.0);
  light.outerConeAngle = static_cast<float>(outer * std::numbers::pi / 180.0);
}

}  // namespace

Light parseLight(std::string_view text) {
  const auto fields = split(text, ':');
  const auto expectFields = [&](std::size_t count) {
    if (fields.size() != count) {
      refuseLight(text, std::string(fields[0]) + " takes " + std::to_string(count - 1) +
                            " fields after its name, got " + std::to_string(fields.size() - 1));
    }
  };
  Light light;
  if (fields[0] == "point") {
    expectFields(3);
    light.type = LightType::Point;
    light.position = parsePosition(text, fields[1]);
    light.intensity = parseColor(text, fields[2]);
  } else if (fields[0] == "directional") {
    expectFields(3);
    light.type = LightType::Directional;
    light.direction = parseDirection(text, fields[1]);
    light.intensity = parseColor(text, fields[2]);
  } else if (fields[0] == "spot") {
    expectFields(5);
    light.type = LightType::Spot;
    light.position = parsePosition(text, fields[1]);
    light.direction = parseDirection(text, fields[2]);
    parseCone(text, fields[3], light);
    light.intensity = parseColor(text, fields[4]);
  } else {
    refuseLight(
        text, "unknown kind of light '" + std::string(fields[0]) + "', expected point, directional or spot");
  }
  light.name = std::string(fields[0]);
  return light;
}

}  // namespace prelight::viewer
