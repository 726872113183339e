#include "benchmarks/suites/indirect/indirect_suite.h"

namespace prelight::benchmarks {

const OptionTable<IndirectOptions>& IndirectOptions::table() {
  static const OptionTable<IndirectOptions> table =
      OptionTable<IndirectOptions>()
          .add("photonCounts", &IndirectOptions::photonCounts, {10000, 100000, 1000000}, {2000},
               "photons of the maps in which trees and grids are compared", {.ascending = true})
          .add("photonCount", &IndirectOptions::photonCount, 1000000, 2000,
               "photons of the maps that are laid out like the thesis'")
          .add("photonLookups", &IndirectOptions::photonLookups, 1u << 15, 500,
               "places at which irradiance is looked up")
          .add("causticSide", &IndirectOptions::causticSide, 256, 32,
               "pixels per side of the picture of a caustic", {.most = 8192})
          .add("causticPhotons", &IndirectOptions::causticPhotons, {10000, 50000, 200000, 1000000}, {2000},
               "photons of the caustic, a case for each number")
          .add("causticNearest", &IndirectOptions::causticNearest, {10, 20, 50, 100}, {10},
               "photons nearest to a point from which its light is estimated")
          .add("causticRadii", &IndirectOptions::causticRadii, {1.0, 2.0, 4.0}, {2.0},
               "fixed radii of estimates, pixels", {.least = 0.01})
          .add("photonPasses", &IndirectOptions::photonPasses, 1024, 4, "passes of the progressive estimate")
          .add("photonsPerPass", &IndirectOptions::photonsPerPass, 1000, 500, "photons of each pass")
          .add("gatherScenes", &IndirectOptions::gatherScenes, {"cornell", "rooms", "caustics"}, {"cornell"},
               "scenes of `gather`, built in or files")
          .add("gatherTexels", &IndirectOptions::gatherTexels, 4096, 200, "texels of each scene")
          .add("gatherRays", &IndirectOptions::gatherRays, {16, 32, 64, 128, 256, 512}, {8, 16},
               "rays per texel or record", {.powerOfTwo = true})
          .add("gatherLongRun", &IndirectOptions::gatherLongRun, 2048, 32,
               "rays per texel of the two long runs that show the bias", {.powerOfTwo = true})
          .add("gatherTruthRuns", &IndirectOptions::gatherTruthRuns, 4, 1,
               "largest number of runs of each of the two truths, with twice as many rays as the long runs")
          .add("lightMapScenes", &IndirectOptions::lightMapScenes, {"cornell", "rooms", "shapes"},
               {"cornell"}, "scenes of `lightmaps`")
          .add("lightMapRays", &IndirectOptions::lightMapRays, 1024, 16, "rays per texel")
          .add("lightMapPhotons", &IndirectOptions::lightMapPhotons, 1u << 18, 1000, "photons")
          .add("lightMapTexels", &IndirectOptions::lightMapTexels, {1u << 12, 1u << 14, 1u << 16, 1u << 18},
               {256, 1024}, "texels of maps whose texels have one size")
          .add("lightMapErrors", &IndirectOptions::lightMapErrors, {0.1, 0.05, 0.02}, {0.5, 0.3},
               "errors by which sizes of texels are chosen", {.least = 1e-6, .most = 1})
          .add("lightMapPlaces", &IndirectOptions::lightMapPlaces, 20000, 200,
               "points of the surface at which maps are compared")
          .add("lightMapTruthRays", &IndirectOptions::lightMapTruthRays, 4096, 16,
               "rays per point, traced twice")
          .add("radiosityScenes", &IndirectOptions::radiosityScenes, {"cornell", "rooms"}, {"cornell"},
               "scenes of `radiosity`")
          .add("radiosityRays", &IndirectOptions::radiosityRays, 512, 64, "rays per element", {.powerOfTwo = true})
          .add("radiosityTolerance", &IndirectOptions::radiosityTolerance, 1e-5, 0.03,
               "residual at which solvers are timed; curves go on to a tenth of it", {.least = 1e-12, .most = 1})
          .add("radiositySeeds", &IndirectOptions::radiositySeeds, 8, 1,
               "number of seeds over which errors of form factors are averaged");
  return table;
}

void IndirectOptions::takeGiven() {
  gatherScenes.insert(gatherScenes.begin(), given.models.begin(), given.models.end());
}

std::unique_ptr<Suite> indirectSuite() {
  SuiteOf<IndirectOptions>::Runners parts = {
      {"photons",
       "seconds to sort photons and to look irradiance up, trees against grids; error against work",
       runPhotons},
      {"gather", "error of indirect light against time, and its bias, by how its texels are gathered",
       runGather},
      {"lightmaps", "error, texels, bytes and seconds of light maps by the size of texels and by error",
       runLightMaps},
      {"radiosity", "errors of form factors, residuals of the solvers, seconds of new lights", runRadiosity},
  };
  return std::make_unique<SuiteOf<IndirectOptions>>(
      "indirect", "error and time of indirect light: photons, gathers, light maps and radiosity",
      std::move(parts));
}

}  // namespace prelight::benchmarks
