#include "benchmarks/suites/visibility/visibility_suite.h"

namespace prelight::benchmarks {

const OptionTable<VisibilityOptions>& VisibilityOptions::table() {
  static const OptionTable<VisibilityOptions> table =
      OptionTable<VisibilityOptions>()
          .add("voScenes", &VisibilityOptions::voScenes,
               {"shapes", "swing", "bumps", "caustics", "cornell", "rooms"}, {"shapes"}, "scenes of `vo`")
          .add("voRays", &VisibilityOptions::voRays, 1024, 16, "rays per vertex where errors are measured")
          .add("voLights", &VisibilityOptions::voLights, 16, 2, "lights around a scene, and as many inside")
          .add("voPoints", &VisibilityOptions::voPoints, 10000, 100,
               "points of the surface at which shadows are traced")
          .add("voCostRays", &VisibilityOptions::voCostRays, 10000, 16,
               "rays per vertex where the time of a bake is measured")
          .add("voCostRounds", &VisibilityOptions::voCostRounds, 3, 1, "rounds of those bakes")
          .add("voShadingRounds", &VisibilityOptions::voShadingRounds, 7, 1, "rounds of shading")
          .add("voShadingVertices", &VisibilityOptions::voShadingVertices, 100000, 600,
               "vertices that are shaded")
          .add("voLightCounts", &VisibilityOptions::voLightCounts, {1, 2, 4, 8, 16, 32}, {1, 2, 3},
               "numbers of lights that shade them")
          .add("nearLampScenes", &VisibilityOptions::nearLampScenes, {"cornell", "rooms"}, {"cornell"},
               "scenes of `near-lamps`")
          .add("nearLampOrder", &VisibilityOptions::nearLampOrder, 6, 3, "order of SH")
          .add("nearLampShells", &VisibilityOptions::nearLampShells, 8, 2, "shells of distance")
          .add("nearLampRays", &VisibilityOptions::nearLampRays, 1024, 16, "rays per vertex")
          .add("nearLampWidth", &VisibilityOptions::nearLampWidth, 256, 32, "pixels")
          .add("nearLampHeight", &VisibilityOptions::nearLampHeight, 192, 24, "pixels")
          .add("nearLampSamples", &VisibilityOptions::nearLampSamples, 64, 4,
               "samples of area lights in the traced pictures")
          .add("screenScenes", &VisibilityOptions::screenScenes, {"shapes", "rooms", "cornell"}, {"shapes"},
               "scenes of `screen`, built in or files")
          .add("screenWidth", &VisibilityOptions::screenWidth, 320, 32, "pixels")
          .add("screenHeight", &VisibilityOptions::screenHeight, 180, 18, "pixels")
          .add("screenRays", &VisibilityOptions::screenRays, 512, 16,
               "rays per pixel of the traced accessibility")
          .add("screenFrames", &VisibilityOptions::screenFrames, 5, 1,
               "frames of each technique, the quickest of which counts")
          .add("rasterisedScenes", &VisibilityOptions::rasterisedScenes, {"shapes", "cornell", "rooms"},
               {"shapes"}, "scenes of `rasterised`, built in or files")
          .add("rasterisedReceivers", &VisibilityOptions::rasterisedReceivers, 400, 16,
               "receivers of each scene")
          .add("rasterisedOrder", &VisibilityOptions::rasterisedOrder, 3, "order of SH")
          .add("rasterisedTruthRays", &VisibilityOptions::rasterisedTruthRays, 1u << 14, 256,
               "rays per receiver of the truth")
          .add("rasterisedSides", &VisibilityOptions::rasterisedSides, {16, 32, 64}, {16},
               "texels per side of the drawn hemispheres");
  return table;
}

void VisibilityOptions::takeGiven() {
  screenScenes.insert(screenScenes.begin(), given.models.begin(), given.models.end());
  rasterisedScenes.insert(rasterisedScenes.begin(), given.models.begin(), given.models.end());
}

std::unique_ptr<Suite> visibilitySuite() {
  SuiteOf<VisibilityOptions>::Runners parts = {
      {"vo", "error of the shadows of vector occluders against traced ones, cost of baking and shading them",
       runVo},
#ifdef PRELIGHT_WITH_VIEWER
      {"near-lamps", "error of shadows of lamps within scenes by shells of distance, against shadow rays",
       runNearLamps},
      {"screen", "error of screen-space occlusion against traced accessibility, and time of its frames",
       runScreen},
      {"rasterised",
       "errors and time of SH and gathers that OpenGL draws, by map and resolution, beside rays",
       runRasterised},
#endif
  };
  return std::make_unique<SuiteOf<VisibilityOptions>>(
      "visibility", "shadows and occlusion found without tracing each of them, against traced ones",
      std::move(parts));
}

}  // namespace prelight::benchmarks
