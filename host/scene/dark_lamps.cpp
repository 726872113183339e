#include "scene/dark_lamps.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "base/directions.h"
#include "scene/light_sources.h"
#include "scene/surface/surface_blocks.h"

namespace prelight {
namespace {

constexpr int raysPerLamp = 256;

/// A lamp that sends its light in certain directions from one place.
struct Beam {
  glm::dvec3 from{0.0};
  std::vector<glm::dvec3> directions;
  double range = 0.0;  ///< m; 0: infinite
};

/// Surfaces that a lamp's light meets first.
struct Met {
  int surfaces = 0;             ///< rays that meet a surface
  int inRange = 0;              ///< rays that meet one within the lamp's range
  int fronts = 0;               ///< rays that meet a front in range, or a surface with two
  int receivers = 0;            ///< rays that meet a front in range that the lamp could light
  double nearest = 1e300;       ///< m
  bool isEnclosed = false;      ///< surrounded by surfaces that turn their backs to it
  std::set<std::string> nodes;  ///< nodes whose backs the rays meet
};

std::string quoted(const std::string& name) { return name.empty() ? "" : fmt::format(" \"{}\"", name); }

class DarkLamps {
 public:
  explicit DarkLamps(const CompiledScene& scene)
      : scene_(scene), all_(scene.primitives.size(), 1), blocks_(scene, all_) {}

  std::string reasonOf(const Light& light) const {
    const std::string name = fmt::format("light{}", quoted(light.name));
    if (!shines(light.intensity)) return name + " has no intensity";
    if (light.type == LightType::Directional) return name + reasonOfSun(light.direction);
    if (light.type == LightType::Area) return name + " lights nothing";
    return name + reasonOf(metBy(beamOf(light)), light.range, light.type == LightType::Spot);
  }

  /// Returns the reason for an emissive primitive.
  std::string reasonOf(const PrimitiveRange& range) const {
    const std::string name = fmt::format("emissive surface{}", quoted(range.name));
    const CompiledMaterial& material = scene_.materials[scene_.triangleMaterials[range.firstTriangle]];
    if (!shines(material.emission)) return name + " has an emissive texture that is black";
    Met met;
    const std::uint32_t step = std::max(1u, range.triangleCount / 16);
    for (std::uint32_t t = 0; t < range.triangleCount; t += step)
      add(beamFrom(range.firstTriangle + t, material.doubleSided), met);
    return name + reasonOf(met, 0.0f, true);
  }

 private:
  static std::string reasonOf(const Met& met, float range, bool aims) {
    if (met.surfaces == 0) return aims ? " points away from all surfaces" : " faces no surface";
    if (met.inRange == 0)
      return fmt::format(" has a range of {:g} m, and the nearest surface that it shines at is {:.3g} m away",
                         range, met.nearest);
    if (met.fronts == 0) {
      const std::string whose =
          met.nodes.size() == 1 ? " node" + quoted(*met.nodes.begin()) : " several nodes";
      return met.isEnclosed
                 ? fmt::format(" is shut in by{}, which lets none of its light out", whose)
                 : fmt::format(" is behind all surfaces: its light meets nothing but backs of{}", whose);
    }
    if (met.receivers == 0) return " shines only at surfaces that reflect no light diffusely";
    return " lights nothing";
  }

  std::string reasonOfSun(const glm::dvec3& way) const {
    const glm::dvec3 centre = 0.5 * (glm::dvec3(scene_.boundsMin) + glm::dvec3(scene_.boundsMax));
    const double radius = 0.5 * glm::length(glm::dvec3(scene_.boundsMax - scene_.boundsMin));
    const glm::dvec3 helper = std::abs(way.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 across = glm::normalize(glm::cross(helper, way)), up = glm::cross(way, across);
    Met met;
    for (int ray = 0; ray < raysPerLamp; ++ray) {
      const double distance = radius * std::sqrt((ray + 0.5) / raysPerLamp), turn = 2.399963229728653 * ray;
      const glm::dvec3 from =
          centre + distance * (std::cos(turn) * across + std::sin(turn) * up) - 2.0 * radius * way;
      add({from, {way}, 0.0}, met);
    }
    return reasonOf(met, 0.0f, true);
  }

  static Beam beamOf(const Light& light) {
    Beam beam{light.position, {}, light.range};
    const double cosine = light.type == LightType::Spot ? std::cos(light.outerConeAngle) : -1.0;
    for (int ray = 0; ray < raysPerLamp; ++ray) {
      // Uniform over the cap around the direction of the lamp.
      const double height = 1.0 - (1.0 - cosine) * (ray + 0.5) / raysPerLamp;
      beam.directions.push_back(directionAbout(light.direction, height, ray));
    }
    return beam;
  }

  Beam beamFrom(std::uint32_t triangle, bool bothSides) const {
    const glm::uvec3& t = scene_.triangles[triangle];
    const glm::dvec3 normal = geometricNormal(scene_, triangle);
    const glm::dvec3 middle = (glm::dvec3(scene_.positions[t.x]) + glm::dvec3(scene_.positions[t.y]) +
                               glm::dvec3(scene_.positions[t.z])) /
                              3.0;
    const double offset = 1e-4 * std::sqrt(glm::length(normal));
    Beam beam{scene_.origin + middle + offset * glm::normalize(normal), {}, 0.0};
    for (int ray = 0; ray < raysPerLamp; ++ray) {
      const double height =
          bothSides ? 1.0 - (2.0 * ray + 1.0) / raysPerLamp : 1.0 - (ray + 0.5) / raysPerLamp;
      beam.directions.push_back(directionAbout(glm::normalize(normal), height, ray));
    }
    return beam;
  }

  Met metBy(const Beam& beam) const {
    Met met;
    add(beam, met);
    double backs = 0.0;
    for (const double share : blocks_.backShares(beam.from - scene_.origin)) backs += std::max(share, 0.0);
    met.isEnclosed = backs > 0.5;
    return met;
  }

  void add(const Beam& beam, Met& met) const {
    for (const glm::dvec3& direction : beam.directions) {
      const auto first = blocks_.firstMet(beam.from - scene_.origin, direction);
      if (!first) continue;
      ++met.surfaces;
      met.nearest = std::min(met.nearest, first->distance);
      if (beam.range > 0.0 && first->distance > beam.range) continue;
      ++met.inRange;
      const CompiledMaterial& material = scene_.materials[scene_.triangleMaterials[first->triangle]];
      if (first->back && !material.doubleSided)
        met.nodes.insert(nodeOf(first->triangle));
      else
        ++met.fronts;
      if ((!first->back || material.doubleSided) && !material.unlit && shines(material.albedo))
        ++met.receivers;
    }
  }

  const std::string& nodeOf(std::uint32_t triangle) const {
    return std::upper_bound(
               scene_.primitives.begin(), scene_.primitives.end(), triangle,
               [](std::uint32_t t, const PrimitiveRange& r) { return t < r.firstTriangle + r.triangleCount; })
        ->name;
  }

  const CompiledScene& scene_;
  std::vector<std::uint8_t> all_;
  SurfaceBlocks blocks_;
};

bool isEmissive(const CompiledScene& scene, const PrimitiveRange& range) {
  return range.triangleCount > 0 &&
         shines(scene.materials[scene.triangleMaterials[range.firstTriangle]].emission);
}

}  // namespace

std::vector<std::string> reasonsForDarkness(const CompiledScene& scene, std::span<const Light> lights,
                                            const Environment* sky, std::size_t most) {
  std::vector<std::string> reasons;
  std::size_t further = 0;
  const auto add = [&](const auto& reason) {
    if (reasons.size() < most)
      reasons.push_back(reason());
    else
      ++further;
  };
  const DarkLamps lamps(scene);
  for (const Light& light : lights) add([&] { return lamps.reasonOf(light); });
  for (const PrimitiveRange& range : scene.primitives)
    if (isEmissive(scene, range)) add([&] { return lamps.reasonOf(range); });
  if (sky != nullptr)
    add([&] {
      return std::string(shiningSky(sky) == nullptr ? "the sky is black"
                                                    : "the sky lights nothing: no surface sees it");
    });
  if (reasons.empty()) reasons.push_back("there is no lamp, no emissive surface and no sky");
  if (further > 0) reasons.push_back(fmt::format("and so on for {} more", further));
  return reasons;
}

std::string darknessWarning(const std::string& what, const CompiledScene& scene,
                            std::span<const Light> lights, const Environment* sky) {
  return fmt::format("{} is black all over, because no light arrives: {}", what,
                     fmt::join(reasonsForDarkness(scene, lights, sky), "; "));
}

}  // namespace prelight
