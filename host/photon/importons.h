#pragma once

#include "photon/importance_map.h"
#include "photon/sent_photons.h"
#include "scene/camera_axes.h"

namespace prelight {

/// Where importons of an eye landed. An eye sees a place, a final gathering looks from there at a second one,
/// where photons are stored; what lands at the third and later ones is on its way to those. Importons of
/// photons that are stored everywhere count from the second place on, those of photons that are stored once
/// they have been scattered from the third.
struct Importons {
  std::vector<LandedImporton> landed;
  std::uint64_t rays = 0;
};

Importons sendImportons(const CompiledScene& compiled, TransportScene& scene, const CameraAxes& eye,
                        const PhotonRequest& request, Progress& progress);

/// Sends a request's photons by preference where the picture of an eye needs them (Peter and Pietrek 1998).
/// Importons tell what hangs on a place, few photons (pilots) which directions of the lights lead there, and
/// those that are sent then end by chance where little hangs on them (Vorba and Krivanek 2016). No
/// photon's power is more than eight times the mean, and the power that lands anywhere is in the mean what
/// sendPhotons() has. Where no pilot reaches what is seen, photons are sent by power.
SentPhotons sendByImportance(const CompiledScene& compiled, TransportScene& scene, const CameraAxes& eye,
                             const PhotonRequest& request, Progress& progress);

}  // namespace prelight
