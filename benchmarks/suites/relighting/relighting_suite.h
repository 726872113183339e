#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "benchmarks/run/suite.h"

namespace prelight::benchmarks {

/// Options of the suite `relighting`; its table says what each means.
struct RelightingOptions : RunOptions {
  std::vector<int> basisOrders;
  std::size_t basisDirections;
  int basisRounds;
  int waveletFaceSize;
  int waveletReceivers;
  int waveletFrames;
  std::vector<std::size_t> waveletCounts;
  std::uint64_t relightVertices;
  int relightSkyRows;
  int relightRounds;

  static const OptionTable<RelightingOptions>& table();
};

/// Time, operations and error of evaluating SH and CH on the device, by order and way.
void runBasis(const Device& device, const RelightingOptions& options, SuiteRun& run);

/// Error, flicker and row sizes of Haar wavelets by how the light's coefficients are chosen and turned,
/// beside the quincunx lattice.
void runWavelets(const Device& device, const RelightingOptions& options, SuiteRun& run);

/// Bytes per second of relighting and of projecting lights on the device, compared with copying, and their
/// errors.
void runRelight(const Device& device, const RelightingOptions& options, SuiteRun& run);

std::unique_ptr<Suite> relightingSuite();

}  // namespace prelight::benchmarks
