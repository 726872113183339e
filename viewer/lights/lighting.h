#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "basis/sh_zonal.h"
#include "images/sky_lamps.h"
#include "occluders/occluder_upload.h"
#include "prelight/compiled_scene.h"
#include "prelight/error.h"
#include "prelight/picture.h"
#include "prelight/scene.h"
#include "scene/closed_bodies.h"
#include "techniques/drawing_rules.h"

/// Lights of a picture, ready for the shaders. Conventions of the lights' maths:
/// - a point light of intensity I gives E = I cos / r^2, cut off at its range as in KHR_lights_punctual, and
///   no stronger nearer than a thousandth of half the diagonal of the scene's bounds: E is bounded;
/// - emissive triangles become samples: discs of area A and radiance L that give
///   E = L A cos cos' / (r^2 + A / pi). The second term is exact above a disc's centre, and bounds the light
///   next to a sample;
/// - a spot light with a cookie has it beside the cone (shaders/cookies.glsl);
/// - light of area lights has a closed form (shaders/area_lights.glsl);
/// - a light with a profile is a point light whose intensity that multiplies (transport/profile_funcs.cl);
/// - through transfer a light is a disk of its angle, or a delta function. Its energy does not depend on the
///   bands: the irradiance of an open surface, known exactly, is multiplied by the share that the transfer
///   leaves of the light (basis/lights/lamp_through_transfer.h).
/// - a sky's lamp is such a light. The rest of the sky rings, too, where little of it arrives: it is no less
///   there than a share of what arrives of a sky that is smoothed until it is negative nowhere.
namespace prelight::viewer {

/// Types of lights as the shaders number them.
enum class LightKind : std::uint8_t {
  Directional = 0,
  Point = 1,
  Spot = 2,
  Emitter = 3,
  Profiled = 4,
  Area = 5,
  Cookie = 6
};

/// A light in scene coordinates (world minus CompiledScene::origin).
struct ShadedLight {
  LightKind kind = LightKind::Point;
  glm::vec3 intensity{0.0f};  ///< W/sr, W/m2 (directional), W/(m2 sr) (emitter, area)
  glm::vec3 position{0.0f};
  glm::vec3 direction{0.0f, 0.0f, -1.0f};  ///< unit: the way the light travels; the normal of what is flat
  float range = 0.0f;                      ///< metres; 0: infinite
  float coneScale = 0.0f;                  ///< spot: clamp(cos * scale + offset, 0, 1)^2
  float coneOffset = 1.0f;
  std::shared_ptr<const LightProfile> profile = {};  ///< multiplies the intensity; `direction` is its pole
  std::shared_ptr<const Picture> cookie = {};        ///< cookie: of a spot light
  std::shared_ptr<const LightShape> shape = {};      ///< area
  glm::dvec3 aim{0.0}, side{0.0};                    ///< of what has tables: those of the Light
  float profileStart = 0.0f;                         ///< of a profile: profileTurn()
  std::size_t entry = 0;                             ///< the same: in LampTables
  float area = 0.0f;                                 ///< emitter and area: m2 of one side
  float radius = 0.0f;          ///< Light::radius; for a sky's lamp half the angle of its disk, rad
  bool ofSky = false;           ///< directional: a lamp of a sky, whose map metals and glass reflect with it
  float leastDistance = 1e-6f;  ///< point and spot: metres; nearer than that the light is no stronger
  bool twoSided = false;        ///< emitter, area
  /// Nothing of the scene lies behind the light, so that a transfer's visibility in its direction is the
  /// light's. True for directional lights and those outside the scene's bounds.
  bool throughTransfer = false;
  int firstMap = -1;      ///< the light's first shadow map of the ShadowMapPass; -1: it has none
  int maps = 0;           ///< of parts of the light, one behind the other
  int shadow = -1;        ///< which of the NearLampPass' shadows is the light's; -1: none
  bool isSample = false;  ///< one of many that stand for a large light; such come after all others

  bool operator==(const ShadedLight&) const = default;
};

/// Most lights that a picture is shaded with; a uniform block of the smallest guaranteed size holds them.
constexpr int maxLights = 240;

/// Samples that stand for all emissive triangles together.
constexpr int emitterSamples = 32;

ShadedLight shadedLight(const Light& light, const CompiledScene& scene);

/// Returns a lamp of a sky that is turned by `angle` radians about +Y.
ShadedLight lightOf(const SkyLamp& lamp, double angle);

/// Returns a light as kernels and shaders of vector occluders take it; a profile is replaced by its mean.
device::OccluderLight occluderLight(const ShadedLight& light);

/// Light that arrives at a point of the scene, scene coordinates, as perpendicularIrradiance() of
/// shaders/lights.glsl has it.
IncidentLight incidentFrom(const ShadedLight& light, const glm::dvec3& point);

/// Emitters of the same area that stand for an area light together.
std::vector<ShadedLight> samplesOf(const ShadedLight& area, int count);

/// At most `count` samples of the emissive triangles by emitted power, spread evenly over them: the same for
/// the same scene. Empty when nothing emits. `bodies`: glowingBodies() of the scene; without shadows, the
/// inner sides of a closed lamp would shine through it.
std::vector<ShadedLight> sampleEmitters(const CompiledScene& scene, std::span<const BodySide> bodies,
                                        int count);

/// Whether a light's diffuse light comes through a transfer by its rule.
inline bool comesThrough(Through rule, const ShadedLight& light) {
  return rule == Through::AllLights || (rule == Through::FarLights && light.throughTransfer);
}

/// Returns the sample of a large light that is nearest to a place among those that `serves` is true of;
/// nullptr: there is none.
template <typename Serves>
const ShadedLight* nearestSample(std::span<const ShadedLight> lights, const glm::vec3& place, Serves serves) {
  const ShadedLight* nearest = nullptr;
  float least = std::numeric_limits<float>::infinity();
  for (const ShadedLight& light : lights) {
    const float distance = glm::distance(light.position, place);
    if (!light.isSample || !serves(light) || distance >= least) continue;
    least = distance;
    nearest = &light;
  }
  return nearest;
}

/// A sky's coefficients, projected once and turned for every picture.
class SkyCoefficients {
 public:
  SkyCoefficients() = default;  ///< black
  SkyCoefficients(const Environment& sky, int order);

  /// Coefficients of the sky turned by `angle` radians about +Y; [i] RGB of the first `order` bands.
  std::vector<glm::dvec3> turned(double angle, int order) const;

  /// The weakest smoothing of the first `order` bands with which their sum is negative nowhere.
  const sh::MinimalWindow& smoothing(int order) const;

 private:
  int order_ = 0;
  std::vector<double> coefficients_;                    ///< [channel][i]
  mutable std::map<int, sh::MinimalWindow> smoothing_;  ///< by order, once it has been asked for
};

/// World from sky: the sky turned counter-clockwise about +Y, seen from above.
glm::dmat3 skyTurn(double angle);

}  // namespace prelight::viewer
