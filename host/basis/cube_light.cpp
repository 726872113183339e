#include "basis/cube_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "basis/cube_overlap.h"
#include "prelight/error.h"

namespace prelight {
namespace {

using std::numbers::pi;
constexpr std::size_t diskCorners = 128;

void checkLight(const glm::vec3& value, const char* what) {
  for (int c = 0; c < 3; ++c) {
    if (std::isfinite(value[c]) && value[c] >= 0.0f) continue;
    throw InputError("light", fmt::format("channel {} of its {} is {}, expected finite and not negative", c,
                                          what, value[c]));
  }
}

std::array<glm::dvec3, diskCorners> diskPolygon(const glm::dvec3& axis, double halfAngle) {
  const glm::dvec3 other = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(axis, other)), v = glm::cross(axis, u);
  constexpr double step = 2.0 * pi / diskCorners;
  const double radius = std::tan(halfAngle) * std::sqrt(step / std::sin(step));  // of equal area in the plane
  std::array<glm::dvec3, diskCorners> corners;
  for (std::size_t i = 0; i < diskCorners; ++i) {
    const double angle = step * static_cast<double>(i);
    corners[i] = axis + radius * (std::cos(angle) * u + std::sin(angle) * v);
  }
  return corners;
}

}  // namespace

CubeMap darkCube(int faceSize) {
  checkCubeFaceSize(faceSize, "cube map");
  return {faceSize, std::vector<glm::vec3>(cubeTexelCount(faceSize), glm::vec3(0.0f))};
}

void addDisk(CubeMap& map, const glm::dvec3& toLight, double halfAngle, const glm::vec3& radiance) {
  checkLight(radiance, "radiance");
  if (!(halfAngle > 0.0 && halfAngle < 0.5 * pi)) {
    throw UsageError(
        "disk light",
        fmt::format("got a half angle of {} rad, expected more than 0 and less than pi/2", halfAngle));
  }
  const auto corners = diskPolygon(glm::normalize(toLight), halfAngle);
  std::vector<TexelOverlap> overlaps;
  overlapTexels(corners, map.faceSize, overlaps);
  double covered = 0.0;
  for (const TexelOverlap& overlap : overlaps) covered += overlap.solidAngle;
  const double sine = std::sin(0.5 * halfAngle);
  const double scale = 4.0 * pi * sine * sine / covered;  // 2 pi (1 - cos), so that no energy is lost or won
  const CubeTexels texels(map.faceSize);
  for (const TexelOverlap& overlap : overlaps) {
    const double part = scale * overlap.solidAngle / texels.solidAngle(overlap.texel);
    map.radiance[overlap.texel] += static_cast<float>(part) * radiance;
  }
}

void addDirectional(CubeMap& map, const glm::dvec3& toLight, const glm::vec3& irradiance) {
  checkLight(irradiance, "irradiance");
  const double texel = 4.0 * pi / static_cast<double>(cubeTexelCount(map.faceSize));
  const double halfAngle = std::min(std::acos(1.0 - texel / (2.0 * pi)), 0.25 * pi);
  const double sine = std::sin(halfAngle);  // a disk of radiance L gives a surface that faces it pi L sin^2
  addDisk(map, toLight, halfAngle, irradiance / static_cast<float>(pi * sine * sine));
}

void addCube(CubeMap& map, const CubeMap& other) {
  if (map.faceSize != other.faceSize) {
    throw UsageError("cube map", fmt::format("got faces of {} and of {} texels, expected the same",
                                             map.faceSize, other.faceSize));
  }
  for (std::size_t i = 0; i < map.radiance.size(); ++i) map.radiance[i] += other.radiance[i];
}

}  // namespace prelight
