#include "benchmarks/suites/pictures/pictures_suite.h"

#include <tuple>

namespace prelight::benchmarks {

const OptionTable<PicturesOptions>& PicturesOptions::table() {
  static const OptionTable<PicturesOptions> table =
      OptionTable<PicturesOptions>()
          .add("referenceSize", &PicturesOptions::referenceSize, 64, 16,
               "pixels per side of the pictures of `reference`; those of `full` have twice as many", {.most = 4096})
          .add("referenceSamples", &PicturesOptions::referenceSamples, {2, 8, 32, 128}, {2, 4},
               "samples per pixel of `reference` and `full`", {.ascending = true})
          .add("referenceLongRun", &PicturesOptions::referenceLongRun, 2048, 16,
               "samples per pixel of the pictures against which errors are measured")
          .add("materialRays", &PicturesOptions::materialRays, {64, 256, 1024}, {16},
               "rays per vertex or texel of `materials`", {.ascending = true})
          .add("materialOrders", &PicturesOptions::materialOrders, {3, 4, 5, 6}, {2},
               "orders of SH in `materials`", {.most = 32, .ascending = true})
          .add("materialSamples", &PicturesOptions::materialSamples, {4, 16, 64}, {2},
               "samples per pixel of the path-traced pictures that compete")
          .add("materialTruthSamples", &PicturesOptions::materialTruthSamples, 512, 4,
               "samples per pixel of each of the two path-traced truths")
          .add("materialWidth", &PicturesOptions::materialWidth, 160, 32, "width of the pictures of `materials`, pixels", {.most = 8192})
          .add("materialHeight", &PicturesOptions::materialHeight, 120, 24, "height of the pictures of `materials`, pixels", {.most = 8192})
          .add("objectModels", &PicturesOptions::objectModels, {"ring", "plate"}, {"ring"},
               "objects that `objects` moves: `ring`, `plate` or files")
          .add("objectRays", &PicturesOptions::objectRays, 512, 16, "rays per vertex of `objects`")
          .add("objectMoves", &PicturesOptions::objectMoves, 9, 1, "timed moves of each object")
          .add("objectSamples", &PicturesOptions::objectSamples, 512, 4,
               "samples per pixel of each of the two path-traced truths")
          .add("objectWidth", &PicturesOptions::objectWidth, 240, 32, "width of the pictures of `objects`, pixels", {.most = 8192})
          .add("objectHeight", &PicturesOptions::objectHeight, 135, 18, "height of the pictures of `objects`, pixels", {.most = 8192});
  return table;
}

void PicturesOptions::takeGiven() {
  objectModels.insert(objectModels.end(), given.models.begin(), given.models.end());
  objectRays = given.rays.value_or(objectRays);
  if (given.rays) materialRays = {*given.rays};
  objectSamples = given.samples.value_or(objectSamples);
  materialTruthSamples = given.samples.value_or(materialTruthSamples);
  if (given.size) {
    std::tie(objectWidth, objectHeight) = *given.size;
    std::tie(materialWidth, materialHeight) = *given.size;
  }
}

std::unique_ptr<Suite> picturesSuite() {
  SuiteOf<PicturesOptions>::Runners parts = {
      {"reference", "error of the reference renderer against time, and the error that it reports",
       runReference},
      {"full", "error of pictures with all light against time, beside path tracing", runFull},
#ifdef PRELIGHT_WITH_VIEWER
      {"objects",
       "error and time of the shadows of objects that move among baked scenes, by how they are found",
       runObjects},
      {"materials", "error against time of bodies that scatter light, measured materials and reliefs",
       runMaterials},
#endif
  };
  return std::make_unique<SuiteOf<PicturesOptions>>(
      "pictures", "error of pictures against time, beside path tracing", std::move(parts));
}

}  // namespace prelight::benchmarks
