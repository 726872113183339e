#include "prelight/harmonic_lights.h"

#include <fmt/format.h>

#include "basis/lights/sh_dominant_light.h"
#include "basis/lights/sh_lights.h"
#include "basis/sh_evaluate.h"
#include "library/unit_direction.h"
#include "prelight/error.h"

namespace prelight {

namespace {

/// Returns room for the coefficients of an order.
std::vector<double> roomFor(int order, const char* where) {
  sh::checkOrder(order, where);
  return std::vector<double>(static_cast<std::size_t>(sh::coefficientCount(order)));
}

}  // namespace

std::vector<double> shOfDirection(const glm::dvec3& towards, int order) {
  std::vector<double> values = roomFor(order, "shOfDirection");
  sh::directionalLight(unitDirection(towards, "shOfDirection"), order, values);
  return values;
}

std::vector<double> shOfPoint(const glm::dvec3& position, int order) {
  std::vector<double> values = roomFor(order, "shOfPoint");
  sh::pointLight(position, order, values);
  return values;
}

std::vector<double> shOfCap(const glm::dvec3& towards, double halfAngle, int order) {
  std::vector<double> values = roomFor(order, "shOfCap");
  sh::capLight(unitDirection(towards, "shOfCap"), halfAngle, order, values);
  return values;
}

std::vector<double> shOfSphere(const glm::dvec3& centre, double radius, int order) {
  std::vector<double> values = roomFor(order, "shOfSphere");
  sh::sphereLight(centre, radius, order, values);
  return values;
}

std::vector<double> shOfDisk(const glm::dvec3& centre, const glm::dvec3& normal, double radius, int order) {
  std::vector<double> values = roomFor(order, "shOfDisk");
  sh::diskLight(centre, unitDirection(normal, "shOfDisk"), radius, order, values);
  return values;
}

std::vector<double> shOfPolygon(std::span<const glm::dvec3> vertices, int order) {
  std::vector<double> values = roomFor(order, "shOfPolygon");
  sh::polygonLight(vertices, order, values);
  return values;
}

DominantLights dominantLights(std::span<const double> radiance, int order, std::size_t most) {
  if (most < 1) throw UsageError("dominantLights", "got 0 lights, expected at least 1");
  if (order < 2) throw UsageError("dominantLights", fmt::format("got order {}, expected 2 to 32", order));
  sh::DominantLights found = sh::dominantLights(radiance, order, most);
  DominantLights lights{{}, std::move(found.residual)};
  for (const sh::DominantLights::Light& light : found.lights)
    lights.lights.push_back({light.towards, light.irradiance});
  return lights;
}

}  // namespace prelight
