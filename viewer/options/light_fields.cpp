#include "viewer/options/light_fields.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "base/magnitudes.h"
#include "prelight/error.h"

namespace prelight::viewer {
namespace {

constexpr const char* example =
    "for example point:0,2,0:10,10,10, directional:0,-1,0:3,3,3, "
    "spot:0,3,0:0,-1,0:20,30:50,50,50, area:sphere:0,2,0:0.1:100,100,100, "
    "area:disk:0,2,0:0,-1,0:0.3:20,20,20 or area:quad:0,2,0:0,-1,0:1,0.5:20,20,20";

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (;;) {
    const auto end = text.find(separator);
    parts.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

}  // namespace

LightFields::LightFields(std::string_view text) : text_(text), fields_(split(text, ':')) {}

void LightFields::refuse(const std::string& what) const {
  throw UsageError("--light " + text_, what, example);
}

bool LightFields::takeWord(std::string_view word, std::size_t first) {
  if (first >= fields_.size()) return false;
  const auto found = std::find(fields_.begin() + static_cast<std::ptrdiff_t>(first), fields_.end(), word);
  if (found == fields_.end()) return false;
  fields_.erase(found);
  return true;
}

std::optional<std::string> LightFields::takeValue(std::string_view name, std::size_t first) {
  for (std::size_t i = first; i < fields_.size(); ++i) {
    if (!fields_[i].starts_with(std::string(name) + "=")) continue;
    std::string value = fields_[i].substr(name.size() + 1);
    fields_.erase(fields_.begin() + static_cast<std::ptrdiff_t>(i));
    return value;
  }
  return std::nullopt;
}

void LightFields::expectFields(const std::string& kind, std::size_t names, std::size_t count) const {
  if (fields_.size() == names + count) return;
  refuse(kind + " takes " + std::to_string(count) + " fields after its name, got " +
         std::to_string(fields_.size() - names));
}

double LightFields::number(std::string_view part, const std::string& name) const {
  const std::string_view whole = part;
  if (part.starts_with('+')) part.remove_prefix(1);
  double value = 0.0;
  const auto [end, status] = std::from_chars(part.data(), part.data() + part.size(), value);
  if (status != std::errc{} || end != part.data() + part.size() || part.empty())
    refuse(name + " has '" + std::string(whole) + "' where a number is expected");
  if (!(std::abs(value) <= largestInput)) refuse(name + " has a number beyond 1e15");
  return value;
}

std::vector<double> LightFields::numbers(std::string_view field, std::size_t count,
                                         const std::string& name) const {
  const std::vector<std::string> parts = split(field, ',');
  if (parts.size() != count)
    refuse(name + " takes " + std::to_string(count) + (count == 1 ? " number" : " numbers") + ", got " +
           std::to_string(parts.size()));
  std::vector<double> values;
  for (const std::string& part : parts) values.push_back(number(part, name));
  return values;
}

glm::dvec3 LightFields::position(std::size_t i) const {
  const std::vector<double> v = numbers(fields_[i], 3, "the position");
  return {v[0], v[1], v[2]};
}

glm::dvec3 LightFields::direction(std::size_t i) const { return directionIn(fields_[i]); }

glm::dvec3 LightFields::directionIn(std::string_view field) const {
  const std::vector<double> v = numbers(field, 3, "the direction");
  const double length = std::hypot(v[0], v[1], v[2]);
  if (!(length > 0.0)) refuse("the direction has no length");
  return glm::dvec3(v[0], v[1], v[2]) / length;
}

glm::vec3 LightFields::color(std::size_t i) const {
  const std::vector<double> v = numbers(fields_[i], 3, "the colour");
  for (const double channel : v)
    if (channel < 0.0) refuse("the colour is negative");
  return {v[0], v[1], v[2]};
}

double LightFields::length(std::string_view field, const std::string& name) const {
  const double value = numbers(field, 1, name).front();
  if (!(value > 0.0)) refuse(name + " is not above 0");
  return value;
}

glm::dvec3 levelSide(const glm::dvec3& direction, double degrees) {
  const glm::dvec3 up = std::abs(direction.y) < 0.999 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
  const glm::dvec3 level = glm::normalize(glm::cross(up, direction));
  const double turn = degrees * std::numbers::pi / 180.0;
  return std::cos(turn) * level + std::sin(turn) * glm::cross(direction, level);
}

}  // namespace prelight::viewer
