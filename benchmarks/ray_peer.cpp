#include "benchmarks/ray_peer.h"

#include <fmt/format.h>

namespace prelight::benchmarks {

std::string embreeName(const PeerQuery& query, PeerQuality quality) {
  const char* tree =
      quality == PeerQuality::Low ? "low" : (quality == PeerQuality::Medium ? "medium" : "high");
  const char* rays = query.width == 1 ? "" : (query.coherent ? ", coherent" : ", incoherent");
  return fmt::format("Embree rtc{}{} ({}{})", query.any ? "Occluded" : "Intersect", query.width, tree, rays);
}

}  // namespace prelight::benchmarks
