#include "benchmarks/suites/tracing/tracing_suite.h"

namespace prelight::benchmarks {

const OptionTable<TracingOptions>& TracingOptions::table() {
  static const OptionTable<TracingOptions> table =
      OptionTable<TracingOptions>()
          .add("castRays", &TracingOptions::castRays, 1u << 20, 1u << 14, "rays of each case of `cast`")
          .add("rayCount", &TracingOptions::rayCount, 1u << 19, 1u << 14,
               "rays of each case of `rays` and `scaling`")
          .add("rayRounds", &TracingOptions::rayRounds, 24, 3,
               "short rounds in which Prelight and its peers take turns")
          .add("rayTriangles", &TracingOptions::rayTriangles, {250000, 2000000}, {2000},
               "triangles of the scenes of `rays`, `build` and `trees`", {.least = 1000})
          .add("scalingTriangles", &TracingOptions::scalingTriangles,
               {1000, 10000, 100000, 1000000, 10000000}, {1000, 2000},
               "triangles of the scenes of `scaling`", {.least = 1000, .ascending = true});
  return table;
}

std::unique_ptr<Suite> tracingSuite() {
  SuiteOf<TracingOptions>::Runners parts = {
      {"cast", "rays per second in bake order and in random order, wide tree against narrow", runCast},
      {"rays", "rays per second of bakes, photons and cameras through many triangles, against Embree",
       runRays},
      {"trees", "seconds, bytes and steps per ray of the trees of each build quality", runTrees},
      {"build", "seconds and bytes of the tree over many triangles, against Embree", runBuild},
      {"scaling", "rays per second and the tree, from a thousand triangles to ten million, against Embree",
       runScaling},
  };
  return std::make_unique<SuiteOf<TracingOptions>>(
      "tracing", "rays per second and the trees that they are traced through, against Embree",
      std::move(parts));
}

}  // namespace prelight::benchmarks
