#include "scene/faint_glow.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "scene/camera.h"
#include "scene/light_sources.h"
#include "scene/surface/tangent_space.h"
#include "scene/surface/triangles.h"

namespace prelight {
namespace {

constexpr std::uint32_t lightPlaces = 16;  ///< places from which light is followed
constexpr std::uint32_t placesAPoint = 8;  ///< light places per lit point
constexpr std::uint32_t sightRows = 8;     ///< rows of sight lines in the picture, and columns
constexpr double darkBelow = 0.02;         ///< W/(m2 sr) of a white surface: a fiftieth of white
constexpr double dimBelow = 0.1;           ///< W/(m2 sr) of emission, the mean of a texture
constexpr double mostLit = 0.5;            ///< share of the seen points
constexpr double mostWithin = 0.8;         ///< share of the light
constexpr double turnOfThird = 2.0 * std::numbers::pi / 3.0;

/// A place on an emitter that represents a part of all emitted light.
struct LightPlace {
  std::uint32_t triangle = 0;
  glm::dvec3 position{0.0};
  glm::dvec3 normal{0.0};  ///< unit, of the front
  double radiance = 0.0;
  double area = 0.0;  ///< m2 of emitters that it represents
};

/// A place that the camera sees.
struct Seen {
  std::uint32_t triangle = 0;
  glm::dvec3 position{0.0};
  glm::dvec3 normal{0.0};  ///< unit, towards the camera
};

struct SightLine {
  glm::dvec3 from, way;
};

const CompiledMaterial& materialOf(const CompiledScene& scene, std::uint32_t triangle) {
  return scene.materials[scene.triangleMaterials[triangle]];
}

double radianceOf(const CompiledScene& scene, std::uint32_t triangle) {
  const glm::vec3 c = meanEmission(scene, triangle);
  return std::max({c.x, c.y, c.z, 0.0f});
}

glm::dvec3 pointOf(const CompiledScene& scene, std::uint32_t triangle, double u, double v) {
  const glm::uvec3& corners = scene.triangles[triangle];
  const double root = std::sqrt(u);
  return (1.0 - root) * glm::dvec3(scene.positions[corners.x]) +
         root * (1.0 - v) * glm::dvec3(scene.positions[corners.y]) +
         root * v * glm::dvec3(scene.positions[corners.z]);
}

/// Returns [triangle] 1 where light is blocked: glass and blended surfaces let it through.
std::vector<std::uint8_t> opaqueTriangles(const CompiledScene& scene) {
  std::vector<std::uint8_t> opaque(scene.triangleCount());
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const CompiledMaterial& material = materialOf(scene, t);
    opaque[t] = material.transmission < 0.5f && !material.blended ? 1 : 0;
  }
  return opaque;
}

/// Returns places distributed evenly over the emitted light; none without emission.
std::vector<LightPlace> placeLights(const CompiledScene& scene) {
  std::vector<double> sums;
  std::vector<std::uint32_t> emitters;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const double light = radianceOf(scene, t) * 0.5 * glm::length(geometricNormal(scene, t));
    if (!(light > 0.0)) continue;
    sums.push_back((sums.empty() ? 0.0 : sums.back()) + light);
    emitters.push_back(t);
  }
  std::vector<LightPlace> places;
  for (std::uint32_t i = 0; i < lightPlaces && !sums.empty(); ++i) {
    const double at = (i + 0.5) / lightPlaces * sums.back();
    const auto found =
        static_cast<std::size_t>(std::lower_bound(sums.begin(), sums.end(), at) - sums.begin());
    const double before = found > 0 ? sums[found - 1] : 0.0;
    LightPlace place;
    place.triangle = emitters[found];
    const double v = std::fmod(i * std::numbers::phi, 1.0);
    place.position = pointOf(scene, place.triangle, (at - before) / (sums[found] - before), v);
    place.normal = glm::normalize(geometricNormal(scene, place.triangle));
    place.radiance = radianceOf(scene, place.triangle);
    place.area = sums.back() / place.radiance;
    places.push_back(place);
  }
  return places;
}

/// Ray tests in a scene that ignore surfaces of glass.
class Sight {
 public:
  explicit Sight(const CompiledScene& scene)
      : scene_(scene),
        opaque_(opaqueTriangles(scene)),
        least_(1e-5 * glm::length(glm::dvec3(scene.boundsMax - scene.boundsMin))) {}

  /// Returns true when a ray meets a surface, other than two triangles, before `most` lengths of `way`.
  bool isBlocked(const glm::dvec3& from, const glm::dvec3& way, double most, std::uint32_t own,
                 std::uint32_t other) const {
    const double least = least_ / glm::length(way);
    for (std::uint32_t t = 0; t < scene_.triangleCount(); ++t) {
      if (opaque_[t] == 0 || t == own || t == other) continue;
      const double along = distanceTo(scene_, t, from, way).value_or(0.0);
      if (along > least && along < most) return true;
    }
    return false;
  }

  std::optional<Seen> first(const SightLine& line) const {
    double nearest = std::numeric_limits<double>::infinity();
    Seen seen;
    for (std::uint32_t t = 0; t < scene_.triangleCount(); ++t) {
      if (opaque_[t] == 0) continue;
      const double along = distanceTo(scene_, t, line.from, line.way).value_or(0.0);
      if (!(along > 0.0 && along < nearest)) continue;
      nearest = along;
      seen.triangle = t;
    }
    if (!std::isfinite(nearest)) return std::nullopt;
    seen.position = line.from + nearest * line.way;
    seen.normal = glm::normalize(geometricNormal(scene_, seen.triangle));
    if (glm::dot(seen.normal, line.way) > 0.0) seen.normal = -seen.normal;
    return seen;
  }

 private:
  const CompiledScene& scene_;
  std::vector<std::uint8_t> opaque_;
  double least_;  ///< m; nearer hits are on the surface where the ray starts
};

std::vector<SightLine> sightLines(const CompiledScene& scene, const Camera& camera) {
  glm::dmat3 axes(camera.world);
  for (int k = 0; k < 3; ++k) axes[k] = glm::normalize(axes[k]);
  const glm::dvec3 eye = glm::dvec3(camera.world[3]) - scene.origin;
  const double aspect = pictureWidth(camera, 1000) / 1000.0;
  const double up = camera.perspective ? std::tan(0.5 * camera.yFov) : camera.yMag;
  const double right = camera.perspective ? aspect * up : camera.xMag;
  std::vector<SightLine> lines;
  for (std::uint32_t i = 0; i < sightRows * sightRows; ++i) {
    const double x = right * (2.0 * (i % sightRows + 0.5) / sightRows - 1.0);
    const double y = up * (2.0 * (i / sightRows + 0.5) / sightRows - 1.0);
    if (camera.perspective)
      lines.push_back({eye, axes * glm::dvec3(x, y, -1.0)});
    else
      lines.push_back({eye + axes * glm::dvec3(x, y, 0.0), axes * glm::dvec3(0.0, 0.0, -1.0)});
  }
  return lines;
}

/// Returns the normal and three directions at 45 degrees around it.
std::array<glm::dvec3, 4> waysFrom(const glm::dvec3& normal) {
  const glm::dvec3 p = anyPerpendicular(normal), q = glm::cross(normal, p);
  std::array<glm::dvec3, 4> ways{normal};
  for (std::size_t k = 1; k < ways.size(); ++k) {
    const double turn = turnOfThird * static_cast<double>(k);
    ways[k] = glm::normalize(normal + std::cos(turn) * p + std::sin(turn) * q);
  }
  return ways;
}

/// Returns true when nearly all light falls on the scene itself.
bool shineInwards(const Sight& sight, const std::vector<LightPlace>& places) {
  std::atomic<std::size_t> within = 0, rays = 0;
  parallelRanges(places.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (const glm::dvec3& way : waysFrom(places[i].normal)) {
        const bool met = sight.isBlocked(places[i].position, way, std::numeric_limits<double>::infinity(),
                                         places[i].triangle, places[i].triangle);
        ++rays;
        within += met ? 1 : 0;
      }
  });
  return static_cast<double>(within) >= mostWithin * static_cast<double>(rays);
}

/// Returns the radiance of a white surface at a place.
double shownBy(const CompiledScene& scene, const Sight& sight, const std::vector<LightPlace>& places,
               const Seen& seen, std::size_t turn) {
  double shown = 0.0;
  for (std::size_t k = turn % (lightPlaces / placesAPoint); k < places.size();
       k += lightPlaces / placesAPoint) {
    const LightPlace& place = places[k];
    const glm::dvec3 way = place.position - seen.position;
    const double square = glm::dot(way, way), cosine = glm::dot(seen.normal, way) / std::sqrt(square);
    double leaves = -glm::dot(place.normal, way) / std::sqrt(square);
    if (materialOf(scene, place.triangle).doubleSided) leaves = std::abs(leaves);
    if (!(cosine > 0.0 && leaves > 0.0)) continue;
    const double area = place.area / placesAPoint;
    const double brought = place.radiance * cosine * leaves * area / (std::numbers::pi * square + area);
    if (!sight.isBlocked(seen.position, way, 1.0 - 1e-6, seen.triangle, place.triangle)) shown += brought;
  }
  return shown;
}

/// Returns true when emitters leave most of what a camera sees dark, if it sees anything.
bool leaveDark(const CompiledScene& scene, const Sight& sight, const std::vector<LightPlace>& places,
               const Camera& camera) {
  const std::vector<SightLine> lines = sightLines(scene, camera);
  std::atomic<std::size_t> met = 0, lit = 0;
  parallelRanges(lines.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::optional<Seen> seen = sight.first(lines[i]);
      if (!seen) continue;
      ++met;
      const CompiledMaterial& material = materialOf(scene, seen->triangle);
      const bool shines = material.unlit || radianceOf(scene, seen->triangle) >= dimBelow;
      lit += shines || shownBy(scene, sight, places, *seen, i) >= darkBelow ? 1 : 0;
    }
  });
  return static_cast<double>(lit) <= mostLit * static_cast<double>(met);
}

}  // namespace

bool onlyGlows(const CompiledScene& scene, const Camera& camera) {
  if (std::any_of(scene.lights.begin(), scene.lights.end(),
                  [](const Light& light) { return shines(light.intensity); }))
    return false;
  const std::vector<LightPlace> places = placeLights(scene);
  if (places.empty()) return false;
  const Sight sight(scene);
  return !shineInwards(sight, places) && leaveDark(scene, sight, places, camera);
}

}  // namespace prelight
