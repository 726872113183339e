#include "projectors/stored_rows.h"

#include <algorithm>

#include "base/background_work.h"

namespace prelight {

namespace {

std::optional<VertexFit> fitOfPart(const SideCast& side) {
  if (side.storedCount() == side.receivers()) return std::nullopt;
  return side.fitOfStoredRows();
}

}  // namespace

StoredRows::StoredRows(const Caster& caster, const SideCast& side)
    : caster_(caster),
      side_(side),
      part_(fitOfPart(side)),
      equations_(samples().equations(defaultSmoothing)) {}

std::vector<float> StoredRows::fit(std::size_t columns, const GatherRows& gather, Progress& progress) const {
  constexpr std::size_t waiting = 1;
  std::vector<float> right(side_.slotCount() * columns, 0.0f);
  std::vector<std::vector<float>> blocks(BackgroundWork::placesFor(waiting));
  std::vector<SampleRecord> records;
  std::vector<SurfaceSample> rows;
  {
    BackgroundWork adding(waiting);
    for (std::uint32_t first = 0; first < side_.storedCount(); first += caster_.blockSize()) {
      progress.check();
      const std::uint32_t count = std::min(caster_.blockSize(), side_.storedCount() - first);
      std::vector<float>& values = blocks[first / caster_.blockSize() % blocks.size()];
      gather(first, count, values);
      adding.add([&, first, count] {
        records.resize(count);
        side_.records().read(first, records);
        rows.clear();
        for (const SampleRecord& record : records) rows.push_back(record.sample);
        samples().addTo(right, rows, values);
      });
    }
    adding.finish();
  }
  return samples().solve(equations_, std::move(right), columns);
}

}  // namespace prelight
