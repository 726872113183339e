#include "benchmarks/suites/bake/bake_suite.h"

namespace prelight::benchmarks {

const OptionTable<BakeOptions>& BakeOptions::table() {
  static const OptionTable<BakeOptions> table =
      OptionTable<BakeOptions>()
          .add("bakeRays", &BakeOptions::bakeRays, 256, 16, "rays per vertex of `stages`")
          .add("scalingTriangles", &BakeOptions::scalingTriangles,
               {10000, 100000, 407000, 1390000, 4690000, 10000000}, {10000, 100000},
               "triangles of the scenes of `bake-scaling`, ascending")
          .add("scalingRays", &BakeOptions::scalingRays, {16, 64, 256, 1024, 4096}, {16},
               "rays per vertex of its bakes, ascending")
          .add("scalingMostRays", &BakeOptions::scalingMostRays, 180000000,
               "rays of a bake at most, unless it has 64 per vertex")
          .add("scalingTracedRays", &BakeOptions::scalingTracedRays, 1u << 22, 1u << 18,
               "rays that are enough to time tracing alone")
          .add("scalingLongBake", &BakeOptions::scalingLongBake, 1u << 23, 0,
               "rays from which on a bake runs only once")
          .add("peerTriangles", &BakeOptions::peerTriangles, {407000, 1390000}, {10000},
               "triangles of the scenes on which errors are compared with a baker over Embree")
          .add("peerSides", &BakeOptions::peerSides, {2, 4, 8, 16, 32}, {2, 4},
               "sides of its squares of rays, ascending")
          .add("peerRays", &BakeOptions::peerRays, 180000000, "rays of that baker at most")
          .add("errorPlaces", &BakeOptions::errorPlaces, 4096, 64,
               "places of the surface at which those errors are measured")
          .add("truthSide", &BakeOptions::truthSide, 32, 4,
               "side of the square of paths at each place, which are traced twice")
          .add("errorRays", &BakeOptions::errorRays, {64, 128, 256, 512, 1024}, {16, 32},
               "rays per vertex of `error`, ascending")
          .add("errorReferenceRays", &BakeOptions::errorReferenceRays, 4096, 64,
               "rays per vertex of its reference");
  return table;
}

std::unique_ptr<Suite> bakeSuite() {
  SuiteOf<BakeOptions>::Runners parts = {
      {"stages", "seconds of each stage of a bake of AO, of AO and SH, and of both with a bounce", runStages},
      {"bake-scaling", "seconds, memory and share of tracing of whole bakes, from 10 k triangles to 10 M",
       runBakeScaling, hasBakeScalingCase},
      {"error", "error of AO against time, and the error that a bake reports against the measured one",
       runError},
  };
  return std::make_unique<SuiteOf<BakeOptions>>("bake", "time, memory and error of bakes", std::move(parts));
}

}  // namespace prelight::benchmarks
