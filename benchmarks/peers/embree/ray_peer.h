#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "shared/ray_types.h"

namespace prelight::benchmarks {

enum class PeerQuality : std::uint8_t { Low, Medium, High };

/// How rays are given to a peer.
struct PeerQuery {
  bool any = false;       ///< any hit instead of the closest
  int width = 1;          ///< rays per call: 1, 8 or 16
  bool coherent = false;  ///< whether the peer is told that the rays of a packet are coherent
};

/// Another ray tracing library over the same triangles, with which rays per second are compared.
class RayPeer {
 public:
  virtual ~RayPeer() = default;

  /// Traces all rays on all threads. Hits are as those of Tracer, except that rays may hit the triangle that
  /// they start from.
  virtual void trace(std::span<const device::Ray> rays, std::span<device::Hit> hits,
                     const PeerQuery& query) = 0;

  virtual double buildSeconds() const = 0;
  virtual std::size_t bytes() const = 0;  ///< bytes of tree and triangles
};

/// Returns Embree's tree over the scene, which must outlive it; nullptr in a build without Embree.
std::unique_ptr<RayPeer> makeEmbreePeer(const CompiledScene& scene, PeerQuality quality, std::size_t threads);

/// Returns the number of threads for a peer: the compute units of a CPU device, or else the threads of the
/// machine.
std::size_t peerThreads(const DeviceInfo& device);

/// Returns "Embree 3.13.5"; empty in a build without Embree.
std::string embreeVersion();

/// Returns a name such as "Embree rtcIntersect1 (high)": function, quality of the tree and, for packets,
/// their coherence.
std::string embreeName(const PeerQuery& query, PeerQuality quality);

}  // namespace prelight::benchmarks
