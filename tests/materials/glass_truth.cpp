#include "materials/glass_truth.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace prelight::test {

namespace {

constexpr double glassIor = 1.5;

glm::dvec3 skyAlong(const glm::dvec3& way) { return 1.0 + 0.5 * way; }

/// Fresnel reflectance of a dielectric for unpolarised light; 1 at total reflection.
double fresnel(double cosine, double relativeIor) {
  const double square = 1.0 - (1.0 - cosine * cosine) / (relativeIor * relativeIor);
  if (square <= 0.0) return 1.0;
  const double within = std::sqrt(square);
  const double parallel = (relativeIor * cosine - within) / (relativeIor * cosine + within);
  const double perpendicular = (cosine - relativeIor * within) / (cosine + relativeIor * within);
  return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

/// Light that a unit sphere of glass sends along -way from the point where `way` meets it. All chords inside
/// have the same length and the same angle with the surface.
glm::dvec3 throughSphere(const glm::dvec3& point, const glm::dvec3& way, const glm::dvec3& absorption) {
  const double cosine = -glm::dot(way, point);
  const double outside = fresnel(cosine, glassIor);
  glm::dvec3 light = outside * skyAlong(glm::reflect(way, point));
  glm::dvec3 along = glm::refract(way, point, 1.0 / glassIor);
  glm::dvec3 at = point, share(1.0 - outside);
  for (int bounce = 0; bounce < 30; ++bounce) {
    const double chord = -2.0 * glm::dot(at, along);
    share *= glm::exp(-absorption * chord);
    at = glm::normalize(at + chord * along);  // Otherwise rounding grows from chord to chord.
    const double back = fresnel(glm::dot(along, at), 1.0 / glassIor);
    if (back < 1.0) light += share * (1.0 - back) * skyAlong(glm::refract(along, -at, glassIor));
    share *= back;
    along = glm::normalize(glm::reflect(along, at));
  }
  return light;
}

/// A thin pane shows the multiple reflections of both faces, and passes the rest straight through, tinted.
glm::dvec3 throughPane(const glm::dvec3& normal, const glm::dvec3& way, const glm::dvec3& tint) {
  const double once = fresnel(std::abs(glm::dot(way, normal)), glassIor);
  const double reflected = 2.0 * once / (1.0 + once);
  return reflected * skyAlong(glm::reflect(way, normal)) + (1.0 - reflected) * tint * skyAlong(way);
}

struct Glass {
  bool isBall = false;
  glm::dvec3 tint{1.0}, absorption{0.0};
};

std::optional<Glass> glassOf(const GridCell& cell) {
  if (cell.name != "glass_solid" && cell.name != "glass_attenuation" && cell.name != "thickness_texture" &&
      cell.name != "glass_thin")
    return std::nullopt;
  Glass glass{cell.isBall};
  const auto& color = cell.material["pbrMetallicRoughness"]["baseColorFactor"];
  for (int c = 0; c < 3; ++c) glass.tint[c] = color[static_cast<std::size_t>(c)];
  if (!cell.isBall) return glass;
  const auto& volume = cell.material["extensions"]["KHR_materials_volume"];
  for (std::size_t c = 0; c < 3 && volume.contains("attenuationColor"); ++c)
    glass.absorption[static_cast<int>(c)] =
        -std::log(volume["attenuationColor"][c].get<double>()) / volume["attenuationDistance"].get<double>();
  return glass;
}

glm::dvec3 seen(const Glass& glass, const glm::dvec3& eye, const glm::dvec3& way) {
  if (glass.isBall) {
    const double along = -glm::dot(eye, way), square = along * along - glm::dot(eye, eye) + 1.0;
    if (square <= 0.0) return skyAlong(way);
    return throughSphere(eye + (along - std::sqrt(square)) * way, way, glass.absorption);
  }
  const glm::dquat lean = glm::normalize(glm::dquat(gridLean[3], gridLean[0], gridLean[1], gridLean[2]));
  const glm::dvec3 normal = lean * glm::dvec3(0, 0, 1);
  const glm::dvec3 hit = eye - way * (glm::dot(eye, normal) / glm::dot(way, normal));
  const glm::dvec3 within = glm::inverse(lean) * hit;
  if (std::max(std::abs(within.x), std::abs(within.y)) > 1.0) return skyAlong(way);
  return throughPane(normal, way, glass.tint);
}

}  // namespace

std::optional<glm::dvec3> glassTruth(const GridCell& cell, int pixels) {
  const std::optional<Glass> glass = glassOf(cell);
  if (!glass) return std::nullopt;
  const glm::dvec3 eye(gridEye[0], gridEye[1], gridEye[2]);
  const glm::dvec3 forward = -glm::normalize(eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
  const glm::dvec3 up = glm::cross(right, forward);
  const int samples = 8 * pixels;
  const double half = std::tan(gridYFov / 2);
  glm::dvec3 sum(0.0);
  for (int y = 0; y < samples; ++y)
    for (int x = 0; x < samples; ++x) {
      const double a = (2.0 * (x + 0.5) / samples - 1.0) * half, b = (1.0 - 2.0 * (y + 0.5) / samples) * half;
      sum += seen(*glass, eye, glm::normalize(forward + a * right + b * up));
    }
  return sum / (double(samples) * samples);
}

}  // namespace prelight::test
