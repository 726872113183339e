#include "benchmarks/suites/relighting/relighting_suite.h"

namespace prelight::benchmarks {

const OptionTable<RelightingOptions>& RelightingOptions::table() {
  static const OptionTable<RelightingOptions> table =
      OptionTable<RelightingOptions>()
          .add("basisOrders", &RelightingOptions::basisOrders, {2, 3, 4, 5, 6, 7, 8, 9, 10}, {2, 3},
               "orders of `basis`")
          .add("basisDirections", &RelightingOptions::basisDirections, 1u << 18, 1u << 12,
               "directions of each way, a multiple of 64")
          .add("basisRounds", &RelightingOptions::basisRounds, 25, 3, "short rounds in which ways take turns")
          .add("waveletFaceSize", &RelightingOptions::waveletFaceSize, 64, 8,
               "texels per side of a face of `wavelets`, a power of two from 4 to 512")
          .add("waveletReceivers", &RelightingOptions::waveletReceivers, 300, 12, "receivers")
          .add("waveletFrames", &RelightingOptions::waveletFrames, 61, 3, "frames of one degree each")
          .add("waveletCounts", &RelightingOptions::waveletCounts, {10, 30, 100, 300, 1000}, {5, 20},
               "numbers of coefficients of the light")
          .add("relightVertices", &RelightingOptions::relightVertices, 100000, 200, "vertices of `relight`")
          .add("relightSkyRows", &RelightingOptions::relightSkyRows, 512, 16, "rows of its sky")
          .add("relightRounds", &RelightingOptions::relightRounds, 40, 3,
               "short rounds in which kernels and copies take turns");
  return table;
}

std::unique_ptr<Suite> relightingSuite() {
  SuiteOf<RelightingOptions>::Runners parts = {
      {"basis", "time, operations and error of evaluating SH and CH on the device, by order", runBasis},
      {"wavelets", "error and flicker of Haar wavelets by the number of the light's coefficients",
       runWavelets},
      {"relight", "bytes per second of relighting and light projection on the device, against copying",
       runRelight},
  };
  return std::make_unique<SuiteOf<RelightingOptions>>(
      "relighting", "bases of light: their evaluation, their errors and relighting with them",
      std::move(parts));
}

}  // namespace prelight::benchmarks
