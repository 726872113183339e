#include "benchmarks/suites/live/live_suite.h"

namespace prelight::benchmarks {

const OptionTable<LiveOptions>& LiveOptions::table() {
  static const OptionTable<LiveOptions> table =
      OptionTable<LiveOptions>()
          .add("updateCells", &LiveOptions::updateCells, {1, 36, 115}, {1, 4},
               "cells per side of the walls of the moving room of `update`")
          .add("updateFrames", &LiveOptions::updateFrames, 64, 16, "frames in which the objects of the moving room move")
          .add("updateSide", &LiveOptions::updateSide, 512, 32, "pixels per side of the drawn picture", {.most = 8192})
          .add("updatePhotons", &LiveOptions::updatePhotons, 20000, 500, "photons of the built-in scenes")
          .add("updateScenes", &LiveOptions::updateScenes,
               {{"cornell", "Short box"},
                {"rooms", "Right crate"},
                {"shapes", "Cone"},
                {"caustics", "Glass sphere"}},
               {{"cornell", "Short box"}}, "built-in scenes and the node of each that is moved once")
          .add("followingScenes", &LiveOptions::followingScenes,
               {{"rooms", "Light"},
                {"rooms", "Right crate"},
                {"cornell", "Lamp"},
                {"cornell", "Short box"}},
               {{"cornell", "Short box"}}, "built-in scenes and the node of each that `following` moves")
          .add("followingFrames", &LiveOptions::followingFrames, 60, 4, "frames in which a node moves")
          .add("followingEvery", &LiveOptions::followingEvery, 1, 4, "light is computed anew in every n-th frame")
          .add("followingMilliseconds", &LiveOptions::followingMilliseconds, 33.0, 33.0,
               "milliseconds of work per frame on two cores, that is half of the processor time")
          .add("followingPhotons", &LiveOptions::followingPhotons, 50000, 1000, "photons of the light")
          .add("followingTexels", &LiveOptions::followingTexels, 28800, 200,
               "texels of the light, as in a window of 1280 x 720 pixels")
          .add("liveLightRows", &LiveOptions::liveLightRows, {"rooms", "shapes"}, {"rooms"},
               "scenes, built in or files, that `live-light` puts in rows")
          .add("liveLightCopies", &LiveOptions::liveLightCopies, 8, 2, "copies of a scene in its row")
          .add("liveLightHeight", &LiveOptions::liveLightHeight, 90, 9,
               "height in pixels of the picture in which light is compared", {.most = 8192})
          .add("liveLightRays", &LiveOptions::liveLightRays, 256, 16, "rays per texel")
          .add("liveLightTexels", &LiveOptions::liveLightTexels, 8192, 200, "texels at which light is gathered")
          .add("liveLightTruth", &LiveOptions::liveLightTruth, 1000000, 4000, "photons of the truth")
          .add("liveLightPhotons", &LiveOptions::liveLightPhotons, {8000, 32000}, {1000},
               "numbers of photons whose light is compared");
  return table;
}

void LiveOptions::takeGiven() {
  liveLightRows.insert(liveLightRows.begin(), given.models.begin(), given.models.end());
}

std::unique_ptr<Suite> liveSuite() {
  SuiteOf<LiveOptions>::Runners parts = {
      {"update", "seconds of frames in which light follows moving objects, and what they do again",
       runUpdate},
      {"following", "error of light that follows a moving node, and how soon it settles", runFollowing},
#ifdef PRELIGHT_WITH_VIEWER
      {"live-light", "light that follows what moves: lamps thinned by distance, in pictures", runLiveLight},
#endif
  };
  return std::make_unique<SuiteOf<LiveOptions>>("live", "light that follows moving objects and lamps",
                                                std::move(parts));
}

}  // namespace prelight::benchmarks
