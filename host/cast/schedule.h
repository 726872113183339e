#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "prelight/plan.h"

namespace prelight {

/// How a request's rays are spread over receivers and passes.
struct Schedule {
  std::uint64_t seed = 0;
  std::uint32_t raysPerReceiver = 64;  ///< 8..128, a power of two
  double receiversPerPass = 0.0;
  std::uint32_t passes = 8;         ///< at least; a multiple of errorGroups
  std::uint32_t replicates = 1;     ///< independent sequences that passes take turns with: 1 or errorGroups
  double leastError = 0.0;          ///< of a vertex's AO to assume, whatever the receivers around it show
  std::optional<double> error;      ///< go on, on the triangles that need it, until this standard error
  std::uint32_t maxDoublings = 10;  ///< with error: give up after so many
  std::optional<std::chrono::steady_clock::time_point> deadline;  ///< go on until then
};

/// `vertices` are the fit's unknowns. `start` is when the bake began: a time budget counts from there and
/// leaves a part for fitting and bouncing.
Schedule makeSchedule(const BakeRequest& request, std::uint32_t vertices,
                      std::chrono::steady_clock::time_point start);

/// Rays of a place that no fit smooths, a voxel or texel: those of a vertex, as a power of two from 16 to
/// 4096.
std::uint32_t raysEach(const BakeRequest& request);

}  // namespace prelight
