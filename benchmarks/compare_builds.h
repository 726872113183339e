#pragma once

#include <string>
#include <vector>

#include "benchmarks/ray_peer.h"
#include "benchmarks/suite.h"

namespace prelight::benchmarks {

/// Builds the tree of a scene `rounds` times by turns, with Prelight and with the peer. Results, each of
/// Prelight compared with the peer at about the same effort, and then of every quality of the peer ("peer
/// ..."):
/// - "build": median seconds from triangles to the layout that the device is given, which is not uploaded;
/// - "size": bytes a triangle of nodes and leaves, which hold the vertices that are tested;
/// and of Prelight's trees alone, "depth" (levels of the binary tree) and the "SAH nodes" and "SAH leaves" of
/// it: how many nodes and blocks of triangles a random line through the scene's bounds meets.
void compareBuilds(const std::string& suite, const std::string& size, const CompiledScene& scene,
                   const Device& device, const std::vector<PeerQuality>& qualities, int rounds,
                   const Progress& progress, std::vector<BenchmarkResult>& results);

}  // namespace prelight::benchmarks
