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

/// Which photons are kept where they land. docs/photons.md defines the classes of paths.
enum class PhotonKind : std::uint8_t {
  All,       ///< at every surface that reflects diffusely
  Indirect,  ///< after at least one scattering
  Caustic,   ///< scattered only by mirrors, glass and narrow lobes; emission is aimed at these
};

/// Which photons are emitted and from which lights.
struct PhotonOptions {
  PhotonKind kind = PhotonKind::All;
  /// Approximate number of photons that leave lights; at least one per light.
  std::uint64_t photons = 100'000;
  std::uint64_t seed = 0;
  std::optional<std::vector<Light>> lights = {};  ///< punctual lights in world space; none: the scene's
  const Environment* sky = nullptr;               ///< sky that emits too; nullptr: none
  double skyRotation = 0.0;                       ///< radians, counter-clockwise seen from above
  const Device* device = nullptr;                 ///< nullptr: the default device, opened for the call
  Progress* progress = nullptr;                   ///< nullptr: no progress reports, no interruption
};

/// A photon at the place where it landed.
struct LandedPhoton {
  glm::dvec3 position{0.0};    ///< world space, m
  glm::vec3 power{0.0f};       ///< W, linear RGB
  glm::vec3 direction{0.0f};   ///< unit, towards where the photon came from, away from the surface
  std::uint32_t triangle = 0;  ///< into CompiledScene::triangles
  std::uint32_t path = 0;      ///< records with equal numbers are one photon at successive surfaces, in order
};

/// Stored photons and the balance of power, linear RGB in W: emitted = absorbed + escaped, except for photons
/// that are still travelling after 2048 surfaces.
struct PhotonResult {
  std::vector<LandedPhoton> photons;  ///< in an order that depends on scene and options alone
  std::uint64_t sent = 0;             ///< photons that left lights
  std::uint64_t rays = 0;
  glm::dvec3 emitted{0.0};
  glm::dvec3 absorbed{0.0};  ///< by surfaces, within media and beyond lights' ranges
  glm::dvec3 escaped{0.0};   ///< left the scene
};

/// Emits photons from a scene's lights and follows them from surface to surface (docs/photons.md). Equal
/// scene, options and device give equal photons. Throws UsageError for options out of range, InputError for a
/// scene without triangles, Error where the device fails, and Interrupted when `progress` asks to stop.
PhotonResult photons(const LoadedScene& scene, const PhotonOptions& options = {});

}  // namespace prelight
