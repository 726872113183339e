#include "benchmarks/suites/visibility/visibility_suite.h"

namespace prelight::benchmarks {

const OptionTable<VisibilityOptions>& VisibilityOptions::table() {
  static const OptionTable<VisibilityOptions> table =
      OptionTable<VisibilityOptions>()
          .add("voScenes", &VisibilityOptions::voScenes,
               {"shapes", "swing", "bumps", "caustics", "cornell", "rooms"}, {"shapes"}, "scenes of `vo`")
          .add("voRays", &VisibilityOptions::voRays, 1024, 16, "rays per vertex of bakes whose errors are measured")
          .add("voLights", &VisibilityOptions::voLights, 16, 2, "lights around a scene, and as many inside it")
          .add("voPoints", &VisibilityOptions::voPoints, 10000, 100,
               "points of the surface at which shadows are traced")
          .add("voCostRays", &VisibilityOptions::voCostRays, 10000, 16,
               "rays per vertex of bakes whose time is measured")
          .add("voCostRounds", &VisibilityOptions::voCostRounds, 3, 1, "rounds of the bakes whose time is measured")
          .add("voShadingRounds", &VisibilityOptions::voShadingRounds, 7, 1, "rounds of shading")
          .add("voShadingVertices", &VisibilityOptions::voShadingVertices, 100000, 600,
               "vertices that are shaded", {.least = 100})
          .add("voLightCounts", &VisibilityOptions::voLightCounts, {1, 2, 4, 8, 16, 32}, {1, 2, 3},
               "numbers of lights by which they are shaded")
          .add("nearLampScenes", &VisibilityOptions::nearLampScenes, {"cornell", "rooms"}, {"cornell"},
               "scenes of `near-lamps`")
          .add("nearLampOrder", &VisibilityOptions::nearLampOrder, 6, 3, "order of SH of `near-lamps`", {.most = 32})
          .add("nearLampShells", &VisibilityOptions::nearLampShells, 8, 2, "shells of distance", {.least = 2, .most = 32})
          .add("nearLampRays", &VisibilityOptions::nearLampRays, 1024, 16, "rays per vertex of `near-lamps`")
          .add("nearLampWidth", &VisibilityOptions::nearLampWidth, 256, 32, "width of the pictures of `near-lamps`, pixels", {.most = 8192})
          .add("nearLampHeight", &VisibilityOptions::nearLampHeight, 192, 24, "height of the pictures of `near-lamps`, pixels", {.most = 8192})
          .add("nearLampSamples", &VisibilityOptions::nearLampSamples, 64, 4,
               "samples of area lights in the traced pictures")
          .add("screenScenes", &VisibilityOptions::screenScenes, {"shapes", "rooms", "cornell"}, {"shapes"},
               "scenes of `screen`, built in or files")
          .add("screenWidth", &VisibilityOptions::screenWidth, 320, 32, "width of the pictures of `screen`, pixels", {.most = 8192})
          .add("screenHeight", &VisibilityOptions::screenHeight, 180, 18, "height of the pictures of `screen`, pixels", {.most = 8192})
          .add("screenRays", &VisibilityOptions::screenRays, 512, 16,
               "rays per pixel of the traced accessibility")
          .add("screenFrames", &VisibilityOptions::screenFrames, 5, 1,
               "frames of each technique; the quickest counts")
          .add("rasterisedScenes", &VisibilityOptions::rasterisedScenes, {"shapes", "cornell", "rooms"},
               {"shapes"}, "scenes of `rasterised`, built in or files")
          .add("rasterisedReceivers", &VisibilityOptions::rasterisedReceivers, 400, 16,
               "receivers per scene of `rasterised`")
          .add("rasterisedOrder", &VisibilityOptions::rasterisedOrder, 3, "order of SH of `rasterised`", {.most = 32})
          .add("rasterisedTruthRays", &VisibilityOptions::rasterisedTruthRays, 1u << 14, 256,
               "rays per receiver of the traced truth")
          .add("rasterisedSides", &VisibilityOptions::rasterisedSides, {16, 32, 64}, {16},
               "texels per side of the drawn hemispheres", {.least = 4, .most = 1024});
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
