#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "scene/light_shape.h"
#include "viewer/options/light_fields.h"
#include "viewer/options/light_option.h"

namespace prelight::viewer {
namespace {

using std::numbers::pi;

constexpr std::size_t mostCorners = 32;  ///< of a polygon
constexpr double flatness = 1e-4;        ///< of a polygon's size

void readSphere(const LightFields& fields, Light& light, LightShape& shape) {
  fields.expectFields("a sphere", 2, 3);
  light.position = fields.position(2);
  shape.kind = ShapeKind::Sphere;
  shape.radius = fields.length(fields[3], "the radius");
}

void readDisk(const LightFields& fields, Light& light, LightShape& shape) {
  fields.expectFields("a disk", 2, 4);
  light.position = fields.position(2);
  light.direction = fields.direction(3);
  light.side = levelSide(light.direction, 0.0);
  shape.kind = ShapeKind::Disk;
  shape.radius = fields.length(fields[4], "the radius");
}

void readQuad(LightFields& fields, Light& light, LightShape& shape) {
  const std::optional<std::string> turn = fields.takeValue("turn", 2);
  fields.expectFields("a quad", 2, 4);
  light.position = fields.position(2);
  light.direction = fields.direction(3);
  light.side = levelSide(light.direction, turn ? fields.numbers(*turn, 1, "the turn").front() : 0.0);
  const std::vector<double> size = fields.numbers(fields[4], 2, "the size");
  if (!(size[0] > 0.0 && size[1] > 0.0)) fields.refuse("the size is not above 0");
  const double x = 0.5 * size[0], y = 0.5 * size[1];
  shape.kind = ShapeKind::Polygon;
  shape.corners = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

glm::dvec3 normalOf(const std::vector<glm::dvec3>& corners) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < corners.size(); ++i)
    sum += glm::cross(corners[i], corners[(i + 1) % corners.size()]);
  return sum;
}

bool isConvex(const std::vector<glm::dvec2>& corners) {
  double turned = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec2 &a = corners[i], &b = corners[(i + 1) % corners.size()],
                     &c = corners[(i + 2) % corners.size()];
    const glm::dvec2 before = b - a, after = c - b;
    const double angle =
        std::atan2(before.x * after.y - before.y * after.x, before.x * after.x + before.y * after.y);
    if (angle < -1e-9) return false;
    turned += angle;
  }
  return turned < 2.5 * pi;  // once round
}

void readPolygon(const LightFields& fields, Light& light, LightShape& shape) {
  const std::size_t count = fields.count() < 3 ? 0 : fields.count() - 3;
  if (count < 3 || count > mostCorners)
    fields.refuse("a polygon takes 3 to " + std::to_string(mostCorners) + " corners and a colour, got " +
                  std::to_string(count) + " corners");
  std::vector<glm::dvec3> corners;
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < count; ++i) {
    corners.push_back(fields.position(2 + i));
    sum += corners.back();
  }
  light.position = sum / static_cast<double>(count);
  double size = 0.0;
  for (glm::dvec3& corner : corners) {
    corner -= light.position;
    size = std::max(size, glm::length(corner));
  }
  const glm::dvec3 normal = normalOf(corners), first = corners[1] - corners[0];
  if (!(glm::length(normal) > 1e-9 * size * size) || !(glm::length(first) > 1e-9 * size))
    fields.refuse("the polygon has no area, or two of its corners coincide");
  light.direction = glm::normalize(normal);
  light.side = glm::normalize(first - glm::dot(first, light.direction) * light.direction);
  const glm::dvec3 across = glm::cross(light.direction, light.side);
  for (const glm::dvec3& corner : corners) {
    if (std::abs(glm::dot(corner, light.direction)) > flatness * size)
      fields.refuse("the polygon is not flat");
    shape.corners.emplace_back(glm::dot(corner, light.side), glm::dot(corner, across));
  }
  if (!isConvex(shape.corners)) fields.refuse("the polygon is not convex");
  shape.kind = ShapeKind::Polygon;
}

/// Radiance of a colour that is given otherwise.
double radianceShare(LightFields& fields, const LightShape& shape, bool isPower, bool isExitance) {
  if (isPower && isExitance) fields.refuse("its colour is power or exitance, not both");
  if (isExitance) return 1.0 / pi;
  if (!isPower) return 1.0;
  return 1.0 / (pi * shapeArea(shape) * (shape.twoSided ? 2.0 : 1.0));
}

}  // namespace

Light parseAreaLight(LightFields& fields) {
  if (fields.count() < 2) fields.refuse("area takes a shape: sphere, disk, quad or polygon");
  const bool isPower = fields.takeWord("power", 2), isExitance = fields.takeWord("exitance", 2);
  LightShape shape;
  shape.twoSided = fields.takeWord("two-sided", 2);
  Light light;
  light.type = LightType::Area;
  const std::string kind(fields[1]);
  light.name = kind;
  if (kind == "sphere")
    readSphere(fields, light, shape);
  else if (kind == "disk")
    readDisk(fields, light, shape);
  else if (kind == "quad")
    readQuad(fields, light, shape);
  else if (kind == "polygon")
    readPolygon(fields, light, shape);
  else
    fields.refuse("unknown shape '" + kind + "', expected sphere, disk, quad or polygon");
  if (shape.twoSided && shape.kind == ShapeKind::Sphere) fields.refuse("a sphere has no second side");
  const double share = radianceShare(fields, shape, isPower, isExitance);
  light.intensity = static_cast<float>(share) * fields.color(fields.count() - 1);
  light.shape = std::make_shared<const LightShape>(std::move(shape));
  return light;
}

}  // namespace prelight::viewer
