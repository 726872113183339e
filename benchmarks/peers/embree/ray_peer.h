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

/// How a peer is asked.
struct PeerQuery {
  bool any = false;       ///< any hit instead of the closest
  int width = 1;          ///< rays a call: 1, 8 or 16
  bool coherent = false;  ///< whether the peer is told that the rays of a packet are coherent
};

/// Another library over the same triangles: what rays a second are compared with.
class RayPeer {
 public:
  virtual ~RayPeer() = default;

  /// Traces all rays, on all threads, into as many hits, which are as a Tracer's. Rays may hit the triangle
  /// that they start from; otherwise it is the same query.
  virtual void trace(std::span<const device::Ray> rays, std::span<device::Hit> hits,
                     const PeerQuery& query) = 0;

  virtual double buildSeconds() const = 0;
  virtual std::size_t bytes() const = 0;  ///< bytes of tree and triangles
};

/// Embree, which must not outlive the scene; nothing in a build without it.
std::unique_ptr<RayPeer> makeEmbreePeer(const CompiledScene& scene, PeerQuality quality, std::size_t threads);

/// Threads of a peer: as many as the device has units, or as the machine has where the device is no CPU.
std::size_t peerThreads(const DeviceInfo& device);

/// "Embree 3.13.5"; empty in a build without it.
std::string embreeVersion();

/// "Embree rtcIntersect1 (high)": call, quality of the tree and, of packets, what Embree is told of them.
std::string embreeName(const PeerQuery& query, PeerQuality quality);

}  // namespace prelight::benchmarks
