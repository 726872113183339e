#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "transfer/light_map_report.h"
#include "transfer/radiosity_report.h"

namespace prelight {

/// What a bake did, for reports and for people.
struct BakeReport {
  std::vector<std::pair<std::string, double>> stageSeconds;  ///< in the order they ran
  std::uint64_t rays = 0;                                    ///< in all
  std::uint64_t receivers = 0;
  double aoErrorRms = 0.0;          ///< estimated standard error of AO, RMS over the surface
  double aoErrorMax = 0.0;          ///< the same at the worst vertex
  double skippedRayFraction = 0.0;  ///< rays that the request allowed and the scene did not need
  std::uint64_t bytesBvh = 0;
  std::optional<RadiosityReport> radiosity;  ///< where the bake solved one
  std::optional<LightMapReport> lightMap;    ///< where the bake made one
  std::vector<std::string> notes;
};

}  // namespace prelight
