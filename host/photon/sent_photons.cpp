#include "photon/sent_photons.h"

namespace prelight {

SentPhotons sendPhotons(const CompiledScene& compiled, TransportScene& scene, const PhotonRequest& request,
                        Progress& progress) {
  SentPhotons sent;
  sent.report = PhotonTracer(compiled, scene).trace(request, sent.hits, progress);
  return sent;
}

}  // namespace prelight
