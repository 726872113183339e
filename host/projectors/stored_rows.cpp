#include "projectors/stored_rows.h"

#include <algorithm>

#include "base/background_work.h"

namespace prelight {

std::vector<float> fitStoredRows(const Caster& caster, const SideCast& side, std::size_t columns,
                                 const GatherRows& gather, Progress& progress) {
  constexpr std::size_t waiting = 1;
  VertexFit fit = side.emptyFit(columns);
  std::vector<std::vector<float>> blocks(BackgroundWork::placesFor(waiting));
  std::vector<double> row(columns);
  {
    BackgroundWork adding(waiting);
    for (std::uint32_t first = 0; first < side.storedCount(); first += caster.blockSize()) {
      progress.check();
      const std::uint32_t count = std::min(caster.blockSize(), side.storedCount() - first);
      std::vector<float>& values = blocks[first / caster.blockSize() % blocks.size()];
      gather(first, count, values);
      adding.add([&, first, count] {
        for (std::uint32_t i = 0; i < count; ++i) {
          std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * columns), columns, row.begin());
          fit.add(side.records()[first + i].sample, row);
        }
      });
    }
    adding.finish();
  }
  return fit.solve(defaultSmoothing);
}

}  // namespace prelight
