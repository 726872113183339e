#include "benchmarks/peers/embree/ray_peer.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/parallel.h"
#include "benchmarks/peers/embree/vertex_baker.h"

namespace prelight::benchmarks {

std::size_t peerThreads(const DeviceInfo& device) {
  return device.kind == DeviceKind::Cpu ? std::clamp<std::size_t>(device.computeUnits, 1, hardwareThreads())
                                        : hardwareThreads();
}

std::string embreeName(const PeerQuery& query, PeerQuality quality) {
  const char* tree =
      quality == PeerQuality::Low ? "low" : (quality == PeerQuality::Medium ? "medium" : "high");
  const char* rays = query.width == 1 ? "" : (query.coherent ? ", coherent" : ", incoherent");
  return fmt::format("Embree rtc{}{} ({}{})", query.any ? "Occluded" : "Intersect", query.width, tree, rays);
}

#ifndef PRELIGHT_EMBREE
std::unique_ptr<RayPeer> makeEmbreePeer(const CompiledScene&, PeerQuality, std::size_t) { return nullptr; }

std::string embreeVersion() { return {}; }

std::optional<VertexBake> bakeAtVertices(const CompiledScene&, const VertexBakeRequest&, std::size_t) {
  return {};
}
#endif

}  // namespace prelight::benchmarks
