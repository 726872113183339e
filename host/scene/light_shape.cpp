#include "scene/light_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "scene/append_object.h"

namespace prelight {

namespace {

using std::numbers::pi;

constexpr std::uint32_t diskCorners = 64, ballSegments = 48, ballRings = 24;
constexpr int extentPatches = 32;  ///< that tell how far an area light extends

glm::dvec3 acrossOf(const Light& light) { return glm::cross(light.direction, light.side); }

double doubledArea(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double fraction(double x) { return x - std::floor(x); }

/// Returns a point of a convex polygon for each (u, v) in [0, 1)^2, uniformly by area: u selects a triangle
/// of the fan from the first corner.
glm::dvec2 pointIn(const std::vector<glm::dvec2>& corners, double area, double u, double v) {
  double left = 2.0 * area * u;
  std::size_t k = 1;
  while (k + 2 < corners.size() && left > doubledArea(corners[0], corners[k], corners[k + 1]))
    left -= doubledArea(corners[0], corners[k], corners[k + 1]), ++k;
  const double whole = doubledArea(corners[0], corners[k], corners[k + 1]);
  const double along = whole > 0.0 ? std::sqrt(std::clamp(left / whole, 0.0, 1.0)) : 0.0;
  return corners[0] + along * ((1.0 - v) * (corners[k] - corners[0]) + v * (corners[k + 1] - corners[0]));
}

/// Returns point i of `count` on a sunflower spiral in the unit disk, which is also the unit ball seen along
/// its axis.
glm::dvec2 spiral(int i, int count) {
  const double turn = pi * (3.0 - std::sqrt(5.0)) * i;
  const double radius = std::sqrt((i + 0.5) / count);
  return radius * glm::dvec2(std::cos(turn), std::sin(turn));
}

Primitive polygonOf(const std::vector<glm::dvec2>& corners) {
  Primitive flat;
  for (const glm::dvec2& corner : corners) flat.positions.emplace_back(corner, 0.0f);
  flat.normals.assign(corners.size(), glm::vec3(0, 0, 1));
  for (std::uint32_t k = 1; k + 1 < corners.size(); ++k) flat.triangles.emplace_back(0, k, k + 1);
  return flat;
}

/// Returns a polygon with the area of a disk.
std::vector<glm::dvec2> outlineOf(double radius) {
  const double step = 2.0 * pi / diskCorners, scaled = radius * std::sqrt(step / std::sin(step));
  std::vector<glm::dvec2> outline;
  for (std::uint32_t k = 0; k < diskCorners; ++k)
    outline.emplace_back(scaled * std::cos(step * k), scaled * std::sin(step * k));
  return outline;
}

/// Scales a surface to the given area.
void scaleToArea(Primitive& mesh, double area) {
  double own = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    own += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  for (glm::vec3& position : mesh.positions) position *= static_cast<float>(std::sqrt(area / own));
}

Primitive ballOf(double radius) {
  Primitive ball;
  for (std::uint32_t ring = 0; ring <= ballRings; ++ring)
    for (std::uint32_t k = 0; k < ballSegments; ++k) {
      const double height = pi * ring / ballRings, turn = 2.0 * pi * k / ballSegments;
      ball.normals.emplace_back(std::sin(height) * std::cos(turn), std::sin(height) * std::sin(turn),
                                std::cos(height));
      ball.positions.push_back(static_cast<float>(radius) * ball.normals.back());
    }
  for (std::uint32_t ring = 0; ring < ballRings; ++ring)
    for (std::uint32_t k = 0; k < ballSegments; ++k) {
      const std::uint32_t a = ring * ballSegments + k, b = ring * ballSegments + (k + 1) % ballSegments;
      if (ring > 0) ball.triangles.emplace_back(a, b + ballSegments, b);
      if (ring + 1 < ballRings) ball.triangles.emplace_back(a, a + ballSegments, b + ballSegments);
    }
  scaleToArea(ball, 4.0 * pi * radius * radius);
  return ball;
}

Scene surfaceOf(const Light& light) {
  const LightShape& shape = *light.shape;
  Scene object;
  Material material;
  material.name = light.name;
  material.baseColor = {0.0f, 0.0f, 0.0f, 1.0f};
  material.metallic = material.specular = 0.0f;
  material.emission = light.intensity;
  material.doubleSided = shape.twoSided;
  object.materials.push_back(material);
  Primitive primitive = shape.kind == ShapeKind::Sphere ? ballOf(shape.radius)
                        : shape.kind == ShapeKind::Disk ? polygonOf(outlineOf(shape.radius))
                                                        : polygonOf(shape.corners);
  primitive.material = 0;
  object.meshes.push_back({light.name, {std::move(primitive)}});
  object.nodes.emplace_back();
  MeshNode node;
  node.name = light.name;
  node.transforms = {glm::dmat4(1.0)};
  object.meshNodes.push_back(node);
  return object;
}

}  // namespace

double shapeArea(const LightShape& shape) {
  if (shape.kind == ShapeKind::Sphere) return 4.0 * pi * shape.radius * shape.radius;
  if (shape.kind == ShapeKind::Disk) return pi * shape.radius * shape.radius;
  double doubled = 0.0;
  for (std::size_t k = 1; k + 1 < shape.corners.size(); ++k)
    doubled += doubledArea(shape.corners[0], shape.corners[k], shape.corners[k + 1]);
  return 0.5 * doubled;
}

std::vector<glm::dvec3> cornersOf(const Light& light) {
  std::vector<glm::dvec3> corners;
  for (const glm::dvec2& corner : light.shape->corners)
    corners.push_back(light.position + corner.x * light.side + corner.y * acrossOf(light));
  return corners;
}

std::vector<LightPatch> patchesOf(const Light& light, int count) {
  const LightShape& shape = *light.shape;
  const double area = shapeArea(shape);
  std::vector<LightPatch> patches;
  for (int i = 0; i < count; ++i) {
    if (shape.kind == ShapeKind::Sphere) {
      const double height = 1.0 - (2.0 * i + 1.0) / count;
      const glm::dvec2 turn = glm::normalize(spiral(i, count)) * std::sqrt(1.0 - height * height);
      const glm::dvec3 normal = turn.x * light.side + turn.y * acrossOf(light) + height * light.direction;
      patches.push_back({light.position + shape.radius * normal, normal});
      continue;
    }
    // The R2 sequence of Roberts.
    const glm::dvec2 place = shape.kind == ShapeKind::Disk
                                 ? shape.radius * spiral(i, count)
                                 : pointIn(shape.corners, area, fraction(0.5 + 0.7548776662466927 * i),
                                           fraction(0.5 + 0.5698402909980532 * i));
    patches.push_back({light.position + place.x * light.side + place.y * acrossOf(light), light.direction});
  }
  return patches;
}

bool liesWithin(const Light& light, const CompiledScene& scene) {
  const auto isWithin = [&](const glm::dvec3& position) {
    const glm::vec3 place(position - scene.origin);
    return glm::clamp(place, scene.boundsMin, scene.boundsMax) == place;
  };
  if (isWithin(light.position)) return true;
  if (light.type != LightType::Area) return false;
  return std::ranges::any_of(patchesOf(light, extentPatches),
                             [&](const LightPatch& patch) { return isWithin(patch.position); });
}

bool makeSurfacesOf(std::vector<Light>& lights, Scene& scene) {
  bool any = false;
  for (const Light& light : lights) {
    if (light.type != LightType::Area) continue;
    const glm::dmat4 place(glm::dvec4(light.side, 0.0), glm::dvec4(acrossOf(light), 0.0),
                           glm::dvec4(light.direction, 0.0), glm::dvec4(light.position, 1.0));
    appendObject(scene, surfaceOf(light), light.name, place);
    any = true;
  }
  std::erase_if(lights, [](const Light& light) { return light.type == LightType::Area; });
  return any;
}

}  // namespace prelight
