#include "occluders/occluder_threshold.h"

#include <algorithm>

#include "occluders/occluder_places.h"

namespace prelight {

DroppedOccluders dropOccluders(OccluderTransfer& transfer, double leastFormFactor) {
  DroppedOccluders dropped;
  const std::size_t width = transfer.stored.size(), place = placeOf(transfer, OccluderVector::Occlusion);
  const std::size_t vertices = transfer.offsets.empty() ? 0 : transfer.offsets.size() - 1;
  std::uint32_t kept = 0;
  for (std::size_t v = 0, r = 0; v < vertices; ++v) {
    const std::uint32_t end = transfer.offsets[v + 1];
    double lost = 0.0;
    for (; r < end; ++r) {
      const glm::vec4* record = &transfer.vectors[r * width];
      if (double(record[place].w) < leastFormFactor) {
        lost += record[place].w;
        continue;
      }
      transfer.occluders[kept] = transfer.occluders[r];
      std::copy_n(record, width, &transfer.vectors[kept * width]);
      ++kept;
    }
    transfer.offsets[v + 1] = kept;
    dropped.mean += lost / static_cast<double>(vertices);
    dropped.most = std::max(dropped.most, lost);
  }
  transfer.occluders.resize(kept);
  transfer.vectors.resize(kept * width);
  return dropped;
}

}  // namespace prelight
