#include "benchmarks/peers/embree/ray_peer.h"
#include "benchmarks/peers/embree/vertex_baker.h"

namespace prelight::benchmarks {

std::unique_ptr<RayPeer> makeEmbreePeer(const CompiledScene&, PeerQuality, std::size_t) { return nullptr; }

std::string embreeVersion() { return {}; }

std::optional<VertexBake> bakeAtVertices(const CompiledScene&, const VertexBakeRequest&, std::size_t) {
  return {};
}

}  // namespace prelight::benchmarks
