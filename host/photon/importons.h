#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "photon/photon_sources.h"
#include "photon/photon_tracer.h"
#include "prelight/compiled_scene.h"
#include "scene/camera.h"
#include "shared/photon_path_types.h"

namespace prelight {

/// An importon where it landed.
struct LandedImporton {
  glm::dvec3 position{0.0};  ///< scene coordinates
  double power = 0.0;        ///< power, for an eye that emits 1
};

/// Importance of a watt that lands at a place for an eye: the density of importons on the surface (Peter and
/// Pietrek 1998), 1/m2, in cubes of space. Where few importons landed, the density of larger cubes is used.
class ImportanceMap {
 public:
  ImportanceMap(const CompiledScene& scene, std::span<const LandedImporton> importons);

  double at(const glm::dvec3& position) const { return values_[cellOf(position)]; }

  const device::ImportanceGrid& grid() const { return grid_; }
  std::span<const double> values() const { return values_; }  ///< [z][y][x], above 0 where an importon landed

 private:
  std::size_t cellOf(const glm::dvec3& position) const;
  std::vector<double> gathered(std::span<const LandedImporton> points) const;

  device::ImportanceGrid grid_{};
  std::vector<double> values_;
};

/// Greatest power of a photon relative to the mean.
constexpr double boundOfPower = 8.0;

/// Returns every light of a scene with its square of directions (for distant light: of places) divided into
/// cells, for pilot photons that explore which cells matter. Distant light is divided around `middle`.
PhotonSources pilotSources(const CompiledScene& scene, const LightTables& lights, const glm::dvec3& middle,
                           std::uint64_t photons, std::uint64_t seed);

/// Returns the same sources with about `photons` photons, distributed to cells by the contributions of their
/// pilots to a picture, [path of a pilot]. An eighth of the photons is distributed by power, so that none
/// carries more than eight times the mean. Returns no sources if the pilots contributed nothing.
PhotonSources sourcesByImportance(const PhotonSources& pilots, std::span<const double> brought,
                                  std::uint64_t photons, std::uint64_t seed);

/// Importons of an eye where they landed. An eye sees a first place; final gathering looks from there at a
/// second place, where photons are stored; importons at the third and later places trace paths to these.
/// Photons that are stored everywhere use importons from the second place on, and photons that are stored
/// only after a scattering those from the third.
struct Importons {
  std::vector<LandedImporton> landed;
  std::uint64_t rays = 0;
};

Importons sendImportons(const CompiledScene& compiled, TransportScene& scene, const CameraAxes& eye,
                        const PhotonRequest& request, Progress& progress);

/// Sends a request's photons preferably to where the picture of an eye needs them (Peter and Pietrek 1998).
/// Importons measure the importance of places, and a few photons (pilots) which directions of the lights lead
/// there. Photons then undergo Russian roulette where importance is low (Vorba and Krivanek 2016). No
/// photon's power exceeds eight times the mean, and the expected power at any place is that of sendPhotons().
/// If no pilot reaches visible places, photons are sent by power.
SentPhotons sendByImportance(const CompiledScene& compiled, TransportScene& scene, const CameraAxes& eye,
                             const PhotonRequest& request, Progress& progress);

}  // namespace prelight
