#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "benchmarks/run/suite.h"

namespace prelight::benchmarks {

/// Options of the suite `bake`; its table says what each means.
struct BakeOptions : RunOptions {
  std::uint64_t bakeRays;
  std::vector<std::uint64_t> scalingTriangles;
  std::vector<std::uint64_t> scalingRays;
  std::uint64_t scalingMostRays;
  std::uint64_t scalingTracedRays;
  std::uint64_t scalingLongBake;
  std::vector<std::uint64_t> peerTriangles;
  std::vector<std::uint32_t> peerSides;
  std::uint64_t peerRays;
  std::size_t errorPlaces;
  std::uint32_t truthSide;
  std::vector<std::uint64_t> errorRays;
  std::uint64_t errorReferenceRays;

  static const OptionTable<BakeOptions>& table();
};

/// Seconds of each stage of three bakes of each built-in scene, compared with the simplest of them.
void runStages(const Device& device, const BakeOptions& options, SuiteRun& run);

/// Seconds of each stage, processor use and memory of whole bakes of growing scenes in separate processes,
/// compared with tracing their rays alone.
void runBakeScaling(const Device& device, const BakeOptions& options, SuiteRun& run);

/// Returns whether RunOptions::onlyCase leaves it a case.
bool hasBakeScalingCase(const BakeOptions& options);

/// Error and time of AO by the number of rays, and the error that the bake itself reports.
void runError(const Device& device, const BakeOptions& options, SuiteRun& run);

std::unique_ptr<Suite> bakeSuite();

}  // namespace prelight::benchmarks
