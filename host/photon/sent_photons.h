#pragma once

#include "photon/photon_tracer.h"

namespace prelight {

/// Photons where they landed, and how many there were.
struct SentPhotons {
  PhotonHits hits;
  PhotonReport report;
};

/// Sends all photons of a request. Throws Interrupted between blocks.
SentPhotons sendPhotons(const CompiledScene& compiled, TransportScene& scene, const PhotonRequest& request,
                        Progress& progress);

}  // namespace prelight
