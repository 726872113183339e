#include "techniques/stored_rows.h"

#include <algorithm>

#include "base/kept_work.h"
#include "base/threads.h"

namespace prelight {

namespace {

std::optional<VertexFit> fitOfPart(const SideCast& side) {
  if (side.storedCount() == side.receivers()) return std::nullopt;
  return side.sums().fitOf(side.storedCount());
}

}  // namespace

StoredRows::StoredRows(const StoredTransport& transport, const SideCast& side)
    : transport_(transport),
      side_(side),
      part_(fitOfPart(side)),
      equations_(samples().equations(defaultSmoothing)) {}

std::vector<float> StoredRows::fit(std::size_t columns, std::uint32_t most, const GatherRows& gather,
                                   Progress& progress) const {
  std::vector<float> right(side_.slotCount() * columns, 0.0f);
  gatherAll(columns, most, gather, right, progress);
  SolveLimits limits = noisyValues();
  limits.progress = &progress;
  return samples().solve(equations_, std::move(right), columns, limits);
}

/// Adds what all rows are worth to the right-hand sides.
void StoredRows::gatherAll(std::size_t columns, std::uint32_t most, const GatherRows& gather,
                           std::vector<float>& right, Progress& progress) const {
  constexpr std::size_t waiting = 1;
  std::vector<std::vector<float>> parts(BackgroundWork::placesFor(waiting));
  BackgroundWork adding(waiting);
  std::uint32_t first = 0;
  WorkPart part(progress, "rows", [&](auto& state) {
    adding.finish();
    state.value(first);
    state.sameSize(right);
    state.require(first % most == 0 || first == side_.storedCount());
  });
  while (first < side_.storedCount()) {
    progress.check();
    const std::uint32_t count = std::min(most, side_.storedCount() - first);
    std::vector<float>& values = parts[first / most % parts.size()];
    gather(first, count, values);
    adding.add([&, first] { add(first, values, columns, right); });
    first += count;
    part.advance();
  }
  adding.finish();
  part.finish();
}

/// Block by block, as they were cast, whatever was gathered at once: sums round at the end of a block.
void StoredRows::add(std::uint32_t first, std::span<const float> values, std::size_t columns,
                     std::span<float> right) const {
  std::vector<SampleRecord> records;
  std::vector<SurfaceSample> rows;
  while (!values.empty()) {
    const std::size_t count = std::min<std::size_t>(transport_.blockSize(), values.size() / columns);
    records.resize(count);
    side_.sums().records().read(first, records);
    rows.clear();
    for (const SampleRecord& record : records) rows.push_back(record.sample);
    samples().addTo(right, rows, values.first(count * columns));
    first += static_cast<std::uint32_t>(count);
    values = values.subspan(count * columns);
  }
}

}  // namespace prelight
