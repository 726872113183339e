#pragma once

#include "photon/photon_tracer.h"

namespace prelight {

/// Stored hits of photons, with statistics.
struct SentPhotons {
  PhotonHits hits;
  PhotonReport report;
};

/// Sends all photons of a request. Throws Interrupted between blocks.
SentPhotons sendPhotons(const CompiledScene& compiled, TransportScene& scene, const PhotonRequest& request,
                        Progress& progress);

}  // namespace prelight
