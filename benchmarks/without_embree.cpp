#include "benchmarks/ray_peer.h"

namespace prelight::benchmarks {

std::unique_ptr<RayPeer> makeEmbreePeer(const CompiledScene&, PeerQuality, std::size_t) { return nullptr; }

std::string embreeVersion() { return {}; }

}  // namespace prelight::benchmarks
