#include "benchmarks/suites/transfer/transfer_suite.h"

namespace prelight::benchmarks {

const OptionTable<TransferOptions>& TransferOptions::table() {
  static const OptionTable<TransferOptions> table =
      OptionTable<TransferOptions>()
          .add("bakeRays", &TransferOptions::bakeRays, 256, 16, "rays per vertex")
          .add("compressOrder", &TransferOptions::compressOrder, 6, 2, "order of SH")
          .add("compressBounces", &TransferOptions::compressBounces, 2, 0, "bounces")
          .add("compressMethods", &TransferOptions::compressMethods,
               {"half", "band8", "rgbe", "pca:4", "pca:8", "pca:16", "pca:24", "vq:64", "vq:256", "vq:1024",
                "cpca:16:4", "cpca:16:8", "cpca:64:4", "cpca:64:8", "cpca:64:16", "cpca:256:4", "cpca:256:8",
                "cpca:64:8:byte", "pca:16:byte"},
               {"half", "band8", "pca:2", "vq:8", "cpca:4:2"}, "methods of `compress`")
          .add("encodingScenes", &TransferOptions::encodingScenes, {"cornell", "rooms", "shapes", "bumps"},
               {"cornell"}, "scenes of `encodings`")
          .add("encodingPlaces", &TransferOptions::encodingPlaces, 24, 2, "places of each scene")
          .add("encodingSide", &TransferOptions::encodingSide, 32, 4,
               "pixels per side of the pictures of a place")
          .add("encodingSamples", &TransferOptions::encodingSamples, 128, 4, "samples per pixel")
          .add("animationKeys", &TransferOptions::animationKeys, {2, 3, 5, 9, 17}, {2, 3},
               "numbers of evenly spaced keys of `animation`")
          .add("animationErrors", &TransferOptions::animationErrors, {0.1, 0.05, 0.03}, {0.3},
               "errors by which keys are chosen")
          .add("animationMoments", &TransferOptions::animationMoments, 8, 2,
               "moments between two keys that are compared");
  return table;
}

std::unique_ptr<Suite> transferSuite() {
  SuiteOf<TransferOptions>::Runners parts = {
      {"compress", "error and bytes of transfer in each compressed form", runCompress, hasCompressCase},
      {"encodings", "bytes, error and time of ways to store incident light for bumped normals", runEncodings},
      {"animation", "error of transfer between baked moments of an animation", runAnimation},
  };
  return std::make_unique<SuiteOf<TransferOptions>>(
      "transfer", "bytes and error of ways to store transfer and incident light", std::move(parts));
}

}  // namespace prelight::benchmarks
