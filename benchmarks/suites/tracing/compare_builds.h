#pragma once

#include <string>
#include <vector>

#include "benchmarks/peers/embree/ray_peer.h"
#include "benchmarks/suites/tracing/tracing_suite.h"

namespace prelight::benchmarks {

/// Builds the trees of a scene `rounds` times by turns, with Prelight and with the peer: a quality of each
/// for every one of `qualities`. Results, a case a quality of Prelight's, compared with the peer's at about
/// the same effort:
/// - "build": median seconds from triangles to the layout that the device is given, which is not uploaded;
/// - "size": bytes a triangle of nodes and leaves, which hold the vertices that are tested;
/// and of Prelight's tree alone what BvhReport says: "SAH cost", "depth", "leaf fill", "duplicates".
void compareBuilds(const std::string& size, const CompiledScene& scene, const Device& device,
                   const std::vector<PeerQuality>& qualities, int rounds, const Progress& progress,
                   std::vector<BenchmarkResult>& results);

}  // namespace prelight::benchmarks
