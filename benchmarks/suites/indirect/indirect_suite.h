#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/run/suite.h"

namespace prelight::benchmarks {

/// Options of the suite `indirect`; its table says what each means.
struct IndirectOptions : RunOptions {
  std::vector<std::uint64_t> photonCounts;
  std::uint64_t photonCount;
  std::uint64_t photonLookups;
  int causticSide;
  std::vector<std::uint64_t> causticPhotons;
  std::vector<int> causticNearest;
  std::vector<double> causticRadii;
  int photonPasses;
  int photonsPerPass;
  std::vector<std::string> gatherScenes;
  std::uint32_t gatherTexels;
  std::vector<std::uint32_t> gatherRays;
  std::uint32_t gatherLongRun;
  int gatherTruthRuns;
  std::vector<std::string> lightMapScenes;
  std::uint64_t lightMapRays;
  std::uint64_t lightMapPhotons;
  std::vector<std::uint32_t> lightMapTexels;
  std::vector<double> lightMapErrors;
  std::size_t lightMapPlaces;
  std::uint64_t lightMapTruthRays;
  std::vector<std::string> radiosityScenes;
  std::uint32_t radiosityRays;
  double radiosityTolerance;
  int radiositySeeds;

  static const OptionTable<IndirectOptions>& table();

  /// Replaces the suite's own values by those of the command line.
  void takeGiven();
};

/// Seconds to sort photons into maps and to look up irradiance, for trees and grids, beside the numbers of
/// Larsen's thesis (2004, Tables 8.1, 8.2, 14.1), and error by the number of photons.
void runPhotons(const Device& device, const IndirectOptions& options, SuiteRun& run);

/// Error against time of indirect light at texels by each GatherChoice, and its bias in a long run.
void runGather(const Device& device, const IndirectOptions& options, SuiteRun& run);

/// Error, number of texels, bytes and time of light maps, by the size of their texels and by the error for
/// which sizes are chosen.
void runLightMaps(const Device& device, const IndirectOptions& options, SuiteRun& run);

/// Errors of form factors by rays and by hemicubes; sweeps, seconds and residuals of each radiosity solver;
/// seconds for new lights compared with new form factors.
void runRadiosity(const Device& device, const IndirectOptions& options, SuiteRun& run);

std::unique_ptr<Suite> indirectSuite();

}  // namespace prelight::benchmarks
