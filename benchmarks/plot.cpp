#include "benchmarks/plot.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "benchmarks/bake_scaling_plots.h"
#include "benchmarks/error_plots.h"
#include "benchmarks/ray_plots.h"
#include "benchmarks/stability/stability_plots.h"
#include "benchmarks/time_plots.h"
#include "benchmarks/transfer_plots.h"

namespace prelight::benchmarks {

std::vector<Plot> makePlots(const Results& results, const std::string& subtitle) {
  struct Kind {
    const char* suite;
    const char* plot;
    std::string (*draw)(const Results&, const std::string&);
  };
  constexpr std::array<Kind, 41> kinds = {{{"cast", "cast", castPlot},
                                           {"viewer", "viewer", viewerPlot},
                                           {"viewer", "viewer-parts", viewerPartsPlot},
                                           {"viewer", "viewer-latency", viewerLatencyPlot},
                                           {"rays", "rays", raysPlot},
                                           {"trees", "trees", treesPlot},
                                           {"build", "build", buildPlot},
                                           {"scaling", "scaling", scalingPlot},
                                           {"scaling", "scaling-build", scalingBuildPlot},
                                           {"bake", "bake", bakePlot},
                                           {"bake-scaling", "bake-scaling", bakeStagesPlot},
                                           {"bake-scaling", "bake-scaling-share", bakeSharePlot},
                                           {"bake-scaling", "bake-scaling-memory", bakeMemoryPlot},
                                           {"bake-scaling", "bake-scaling-error", bakeErrorPlot},
                                           {"error", "error", errorPlot},
                                           {"reference", "reference", referencePlot},
                                           {"full", "full", globalIlluminationPlot},
                                           {"gather", "gather", gatherPlot},
                                           {"gather", "gather-bias", gatherBiasPlot},
                                           {"wavelets", "wavelets", waveletsPlot},
                                           {"relight", "relight", relightPlot},
                                           {"compress", "compress", compressPlot},
                                           {"basis", "basis", basisPlot},
                                           {"animation", "animation", animationPlot},
                                           {"vo", "vo", voPlot},
                                           {"radiosity", "radiosity", radiosityPlot},
                                           {"photons", "photons", photonsPlot},
                                           {"lightmaps", "lightmaps", lightMapsPlot},
                                           {"encodings", "encodings", encodingsPlot},
                                           {"update", "update", updatePlot},
                                           {"skip", "skip", skipPlot},
                                           {"stability", "stability", stabilityOrderPlot},
                                           {"stability", "stability-count", stabilityCountPlot},
                                           {"stability", "stability-size", stabilitySizePlot},
                                           {"techniques", "techniques", techniquesPlot},
                                           {"screen", "screen", screenPlot},
                                           {"near-lamps", "near-lamps", nearLampsPlot},
                                           {"materials", "materials", materialsPlot},
                                           {"objects", "objects", objectsPlot},
                                           {"rasterised", "rasterised", rasterisedPlot},
                                           {"live-light", "live-light", liveLightPlot}}};
  std::vector<Plot> plots;
  for (const Kind& kind : kinds) {
    Results own;
    std::copy_if(results.begin(), results.end(), std::back_inserter(own),
                 [&](const BenchmarkResult& result) { return result.suite == kind.suite; });
    if (!own.empty()) plots.push_back({kind.plot, kind.draw(own, subtitle)});
  }
  return plots;
}

}  // namespace prelight::benchmarks
