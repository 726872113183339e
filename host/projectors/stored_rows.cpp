#include "projectors/stored_rows.h"

#include <algorithm>
#include <optional>

#include "base/background_work.h"

namespace prelight {

std::vector<float> fitStoredRows(const Caster& caster, const SideCast& side, std::size_t columns,
                                 const GatherRows& gather, Progress& progress) {
  constexpr std::size_t waiting = 1;
  std::optional<VertexFit> part;
  if (side.storedCount() < side.receivers()) part.emplace(side.fitOfStoredRows());
  const VertexFit& fit = part ? *part : side.fit();
  std::vector<float> right(side.slotCount() * columns, 0.0f);
  std::vector<std::vector<float>> blocks(BackgroundWork::placesFor(waiting));
  std::vector<SurfaceSample> samples;
  {
    BackgroundWork adding(waiting);
    for (std::uint32_t first = 0; first < side.storedCount(); first += caster.blockSize()) {
      progress.check();
      const std::uint32_t count = std::min(caster.blockSize(), side.storedCount() - first);
      std::vector<float>& values = blocks[first / caster.blockSize() % blocks.size()];
      gather(first, count, values);
      adding.add([&, first, count] {
        samples.clear();
        for (std::uint32_t i = 0; i < count; ++i) samples.push_back(side.records()[first + i].sample);
        fit.addTo(right, samples, values);
      });
    }
    adding.finish();
  }
  return fit.solve(defaultSmoothing, right, columns);
}

}  // namespace prelight
