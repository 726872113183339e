#pragma once

#include <array>
#include <string>

#include "benchmarks/suites/skip/carry_out.h"

namespace prelight::benchmarks::skip {

/// [Presence] names in results.
constexpr std::array<const char*, 3> presenceNames = {"absent", "unneeded", "needed"};

/// A row, carried out with its feature absent, not needed and needed.
struct MeasuredRow {
  Row row;
  std::array<Outcome, 3> outcomes;  ///< [Presence]; the time is a median
  double cost = 1.0;                ///< processor time of unneeded over that of absent, median of the rounds

  const Outcome& of(Presence presence) const { return outcomes[static_cast<std::size_t>(presence)]; }
  bool unchanged() const { return sameValues(of(Presence::Absent), of(Presence::Unneeded)); }
};

/// Carries a row out once, for kernels to be compiled and for what is counted, and `rounds` (>= 0) times for
/// its times, in which the three take turns.
MeasuredRow measureRow(const Row& row, const Effort& effort, int rounds, const Device& device,
                       const Progress& progress);

/// A Markdown table of rows, with how each feature is present in vain.
std::string tableOf(const std::vector<MeasuredRow>& rows);

}  // namespace prelight::benchmarks::skip
