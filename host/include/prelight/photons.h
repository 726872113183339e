#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "prelight/picture.h"
#include "prelight/scene.h"

namespace prelight {

class Device;
class Progress;
struct LoadedScene;

/// Which photons are kept where they land; docs/photons.md defines the classes of paths.
enum class PhotonKind : std::uint8_t {
  All,       ///< at every surface that reflects diffusely
  Indirect,  ///< those that some surface has scattered before
  Caustic,   ///< those that mirrors, glass and narrow lobes alone have scattered; sent towards these
};

/// Which photons are sent and who sends them.
struct PhotonOptions {
  PhotonKind kind = PhotonKind::All;
  std::uint64_t photons = 100'000;  ///< that leave lights, about; at least one a light
  std::uint64_t seed = 0;
  std::optional<std::vector<Light>> lights = {};  ///< punctual ones, world space; none: the scene's
  const Environment* sky = nullptr;               ///< that shines, too
  double skyRotation = 0.0;                       ///< radians, counter-clockwise seen from above
  const Device* device = nullptr;                 ///< nullptr: the default one, opened for the call
  Progress* progress = nullptr;                   ///< nullptr: nobody is told, nothing interrupts
};

/// A photon where it landed.
struct LandedPhoton {
  glm::dvec3 position{0.0};    ///< world space, m
  glm::vec3 power{0.0f};       ///< W, linear RGB
  glm::vec3 direction{0.0f};   ///< unit, to where it came from, away from the surface
  std::uint32_t triangle = 0;  ///< into CompiledScene::triangles
  std::uint32_t path = 0;      ///< photons of one number are one photon, at its surfaces in their order
};

/// What photons left behind. Power is linear RGB in W: emitted = absorbed + escaped, but for photons that are
/// still on their way after 2048 surfaces.
struct PhotonResult {
  std::vector<LandedPhoton> photons;  ///< in an order that only the scene and the options decide
  std::uint64_t sent = 0;             ///< photons that left lights
  std::uint64_t rays = 0;
  glm::dvec3 emitted{0.0};
  glm::dvec3 absorbed{0.0};  ///< by surfaces, within media and beyond lights' ranges
  glm::dvec3 escaped{0.0};   ///< from the scene
};

/// Sends photons from a scene's lights and follows them from surface to surface (docs/photons.md). The same
/// scene, options and device give the same photons. Throws UsageError for options out of their range,
/// InputError for a scene without triangles, Error where the device fails, Interrupted when `progress` asks.
PhotonResult photons(const LoadedScene& scene, const PhotonOptions& options = {});

}  // namespace prelight
