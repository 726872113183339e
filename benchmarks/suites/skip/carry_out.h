#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "benchmarks/suites/skip/rows.h"
#include "prelight/device.h"
#include "prelight/progress.h"

namespace prelight::benchmarks::skip {

/// Cost and result of a setting. Equal settings have equal outcomes, except for time.
struct Outcome {
  std::uint64_t rays = 0;
  std::uint64_t launches = 0;     ///< launches of kernels
  std::uint64_t workItems = 0;    ///< work-items of all launches
  std::uint64_t deviceBytes = 0;  ///< bytes of all buffers that were made
  double cpuSeconds = 0.0;        ///< processor time on all cores, s, without reading and compiling the scene
  std::vector<float> values;      ///< all baked values, or the picture
};

/// Bakes or draws. Throws Interrupted, and the errors of bakes and pictures.
Outcome carryOut(const Setting& setting, const Device& device, const Progress& progress);

/// Returns whether the values are the same to the bit.
bool sameValues(const Outcome& a, const Outcome& b);

/// Names in results, by Presence.
constexpr std::array<const char*, 3> presenceNames = {"absent", "unneeded", "needed"};

/// Outcomes of a row with its feature absent, present but not needed, and needed.
struct MeasuredRow {
  Row row;
  std::array<Outcome, 3> outcomes;  ///< [Presence]; the time is a median
  double cost = 1.0;  ///< processor time of `unneeded` divided by that of `absent`, median of the rounds

  const Outcome& of(Presence presence) const { return outcomes[static_cast<std::size_t>(presence)]; }
  bool unchanged() const { return sameValues(of(Presence::Absent), of(Presence::Unneeded)); }
};

/// Runs a row once, to compile kernels and to count, and `rounds` (>= 0) more times in turns to measure
/// times.
MeasuredRow measureRow(const Row& row, const Effort& effort, int rounds, const Device& device,
                       const Progress& progress);

/// Returns a Markdown table of rows that says how each feature is present but not needed.
std::string tableOf(const std::vector<MeasuredRow>& rows);

}  // namespace prelight::benchmarks::skip
