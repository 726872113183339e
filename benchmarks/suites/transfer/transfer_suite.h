#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/run/suite.h"

namespace prelight::benchmarks {

/// Options of the suite `transfer`; its table says what each means.
struct TransferOptions : RunOptions {
  std::uint64_t bakeRays;
  int compressOrder;
  int compressBounces;
  std::vector<std::string> compressMethods;
  std::vector<std::string> encodingScenes;
  std::size_t encodingPlaces;
  int encodingSide;
  std::uint64_t encodingSamples;
  std::vector<int> animationKeys;
  std::vector<double> animationErrors;
  int animationMoments;

  static const OptionTable<TransferOptions>& table();
};

/// Error and bytes of each compression of baked transfer.
void runCompress(const Device& device, const TransferOptions& options, SuiteRun& run);

/// Returns whether RunOptions::onlyCase leaves it a case.
bool hasCompressCase(const TransferOptions& options);

/// Bytes, error and time of ways to store incident light, compared with the light itself at points of scenes.
void runEncodings(const Device& device, const TransferOptions& options, SuiteRun& run);

/// Error of transfer between the keys of an animation, by their number and how it is interpolated.
void runAnimation(const Device& device, const TransferOptions& options, SuiteRun& run);

std::unique_ptr<Suite> transferSuite();

}  // namespace prelight::benchmarks
