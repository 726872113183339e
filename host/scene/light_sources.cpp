#include "scene/light_sources.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "scene/exact_ray.h"
#include "scene/tangent_space.h"

namespace prelight {
namespace {

/// An emissive triangle of a surface and the sum of areas up to it.
struct Emitter {
  std::uint32_t triangle;
  double areaSoFar;
};

/// Straight ahead and three ways at 45 degrees about it.
std::array<glm::dvec3, 4> waysFrom(const glm::dvec3& normal) {
  const glm::dvec3 p = anyPerpendicular(normal), t = glm::cross(normal, p), b = -p;
  std::array<glm::dvec3, 4> ways{normal};
  for (std::size_t k = 1; k < ways.size(); ++k) {
    const double turn = 2.0943951023931953 * static_cast<double>(k);
    ways[k] = glm::normalize(normal + std::cos(turn) * t + std::sin(turn) * b);
  }
  return ways;
}

/// Whether nearly all light of these triangles falls on the scene itself. Rays from a few of them, spread
/// evenly over their area.
bool shineInwards(const CompiledScene& scene, const std::vector<Emitter>& emitters) {
  constexpr int places = 16;
  constexpr double mostLeaving = 0.2;
  const double least = 1e-5 * glm::length(glm::dvec3(scene.boundsMax - scene.boundsMin));
  int rays = 0, leaving = 0;
  for (int i = 0; i < places; ++i) {
    const double area = (i + 0.5) / places * emitters.back().areaSoFar;
    const auto at = std::lower_bound(emitters.begin(), emitters.end(), area,
                                     [](const Emitter& e, double size) { return e.areaSoFar < size; });
    const glm::uvec3& corners = scene.triangles[at->triangle];
    glm::dvec3 from(0.0);
    for (int k = 0; k < 3; ++k) from += glm::dvec3(scene.positions[corners[k]]) / 3.0;
    for (const glm::dvec3& way : waysFrom(glm::normalize(geometricNormal(scene, at->triangle)))) {
      bool met = false;
      for (std::uint32_t t = 0; t < scene.triangleCount() && !met; ++t)
        met = t != at->triangle && distanceTo(scene, t, from, way).value_or(0.0) > least;
      ++rays;
      leaving += met ? 0 : 1;
    }
  }
  return leaving <= mostLeaving * rays;
}

}  // namespace

const Environment* shiningSky(const Environment* sky) {
  if (sky == nullptr) return nullptr;
  return std::any_of(sky->radiance.begin(), sky->radiance.end(), shines) ? sky : nullptr;
}

bool hasLights(const CompiledScene& scene) {
  return std::any_of(scene.lights.begin(), scene.lights.end(),
                     [](const Light& light) { return shines(light.intensity); }) ||
         std::any_of(scene.triangleMaterials.begin(), scene.triangleMaterials.end(),
                     [&](std::uint32_t m) { return shines(scene.materials[m].emission); });
}

bool onlyGlows(const CompiledScene& scene) {
  constexpr double mostMean = 0.1;  // W/(m2 sr) over the whole surface
  double light = 0.0, area = 0.0, shining = 0.0;
  std::vector<Emitter> emitters;
  for (const Light& lamp : scene.lights)
    if (shines(lamp.intensity)) return false;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const CompiledMaterial& material = scene.materials[scene.triangleMaterials[t]];
    const double size = glm::length(geometricNormal(scene, t));
    area += size;
    if (!shines(material.emission)) continue;
    const glm::vec3& most = material.emissionFactor;
    if (material.unlit || material.emissionTexture.image < 0 || std::max({most.x, most.y, most.z}) > 1.0f)
      return false;
    if (size > 0.0) emitters.push_back({t, shining += size});
    light += size * double(std::max({material.emission.x, material.emission.y, material.emission.z}));
  }
  return light > 0.0 && light <= mostMean * area && !shineInwards(scene, emitters);
}

bool scattersDiffusely(const CompiledScene& scene) {
  return scene.hasDiffuseTransmission() ||
         std::any_of(scene.triangleMaterials.begin(), scene.triangleMaterials.end(),
                     [&](std::uint32_t m) { return shines(scene.materials[m].albedo); });
}

}  // namespace prelight
