#pragma once

#include "photon/importance_map.h"
#include "photon/sent_photons.h"
#include "scene/camera_axes.h"

namespace prelight {

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
