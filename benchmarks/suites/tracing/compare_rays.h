#pragma once

#include <string>
#include <vector>

#include "benchmarks/peers/embree/ray_peer.h"
#include "benchmarks/run/take_turns.h"
#include "benchmarks/suites/tracing/ray_sets.h"
#include "benchmarks/suites/tracing/tracing_suite.h"

namespace prelight::benchmarks {

/// A tree of a peer and its quality.
struct PeerTree {
  PeerQuality quality = PeerQuality::Medium;
  std::unique_ptr<RayPeer> peer;
};

/// The peer's trees of some qualities over a scene, with peerThreads(). Empty in a build without the peer.
std::vector<PeerTree> makePeerTrees(const CompiledScene& scene, const std::vector<PeerQuality>& qualities,
                                    const DeviceInfo& device);

/// One kind of rays and of query.
struct RayCase {
  std::string name;
  std::vector<device::Ray> rays;
  bool any = false;
};

struct RayComparison {
  int rounds = 1;
  bool packets = false;  ///< ask the peer by packets, too
};

/// Traces the case's rays by turns, with Prelight and with the peer, and checks that they agree. Results:
/// - "throughput" (medians) and "best throughput" (the least disturbed rounds) of Prelight, compared with the
///   faster of the peer's trees, asked ray by ray;
/// - on a CPU, "cpu throughput": rays a second of processor time, which other programs hardly disturb;
/// - "peer throughput" of every way to ask the peer, with Prelight's ratio to it;
/// - "disagreement": the share of rays whose hits differ, in distance by more than 1e-4 of it or of a
///   hundredth of the scene's diagonal, whichever is more.
void compareRays(const RayCase& rays, const CompiledScene& scene, Tracer& tracer,
                 const std::vector<PeerTree>& trees, const RayComparison& how, const Progress& progress,
                 std::vector<BenchmarkResult>& results);

}  // namespace prelight::benchmarks
