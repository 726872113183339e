#include "benchmarks/suites/transfer/transfer_suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "benchmarks/run/measure.h"
#include "compress/compression_error.h"
#include "prelight/transfer.h"
#include "scene/deform.h"

namespace prelight::benchmarks {

namespace {

HarmonicTransfer bakedTransfer(const BenchmarkScene& scene, const Device& device,
                               const TransferOptions& options, const Progress& progress) {
  BakeRequest request;
  request.sh.order = options.compressOrder;
  request.bounces = options.compressBounces;
  request.effort.rays = options.bakeRays;
  return timedBake(scene, request, device, progress).bake.sh.value();
}

void measureMethod(const std::string& scene, const std::string& method, const HarmonicTransfer& transfer,
                   std::span<const double> surface, std::vector<BenchmarkResult>& results) {
  CompressedTransfer compressed;
  const double seconds =
      secondsOf([&] { compressed = compress(transfer, parseCompression(method), surface); });
  const CompressionError error = compressionError(transfer, decompress(compressed), surface);
  const auto vertices = static_cast<double>(compressed.vertexCount);
  const double bytes = static_cast<double>(compressed.byteCount());
  const auto add = [&](const char* metric, double value, const char* unit) {
    results.push_back({scene + "/" + method, metric, value, unit, {}, {}});
  };
  results.push_back({scene + "/" + method, "bytes per vertex", bytes / vertices, "B", "float",
                     double(transfer.coefficients.size() * sizeof(float)) / bytes});
  add("squared error", error.squared, "m2");
  add("vector error", error.vectorRms, "1");
  add("lighting error", error.lightingRms, "1");
  add("worst lighting error", error.worstLightingRms, "1");
  add("time", seconds, "s");
}

constexpr std::array<const char*, 2> compressedScenes = {"shapes", "cornell"};

bool isChosen(const char* scene, const std::string& method, const TransferOptions& options) {
  return (std::string(scene) + "/" + method).find(options.onlyCase) != std::string::npos;
}

}  // namespace

void runCompress(const Device& device, const TransferOptions& options, SuiteRun& run) {
  if (!hasCompressCase(options))
    throw UsageError("--case " + options.onlyCase, "no case of `compress` has such a name",
                     "they are like \"shapes/rgbe\"");
  StepCounter steps(run, "bench compress", compressedScenes.size() * (1 + options.compressMethods.size()));
  for (const char* name : compressedScenes) {
    const BenchmarkScene scene = loadBuiltinScene(name);
    const HarmonicTransfer transfer = bakedTransfer(scene, device, options, run);
    const std::vector<double> surface = surfaceOfVertices(scene.compiled);
    steps.advance();
    for (const std::string& method : options.compressMethods) {
      if (isChosen(name, method, options)) measureMethod(name, method, transfer, surface, run.results());
      steps.advance();
    }
  }
}

bool hasCompressCase(const TransferOptions& options) {
  return std::any_of(compressedScenes.begin(), compressedScenes.end(), [&](const char* scene) {
    return std::any_of(options.compressMethods.begin(), options.compressMethods.end(),
                       [&](const std::string& method) { return isChosen(scene, method, options); });
  });
}

const OptionTable<TransferOptions>& TransferOptions::table() {
  static const OptionTable<TransferOptions> table =
      OptionTable<TransferOptions>()
          .add("bakeRays", &TransferOptions::bakeRays, 256, 16,
               "rays per vertex of `compress` and `animation`")
          .add("compressOrder", &TransferOptions::compressOrder, 6, 2, "order of SH of `compress`",
               {.most = 32})
          .add("compressBounces", &TransferOptions::compressBounces, 2, 0, "bounces of `compress`",
               {.least = 0, .most = 16})
          .add("compressMethods", &TransferOptions::compressMethods,
               {"half", "band8", "rgbe", "pca:4", "pca:8", "pca:16", "pca:24", "vq:64", "vq:256", "vq:1024",
                "cpca:16:4", "cpca:16:8", "cpca:64:4", "cpca:64:8", "cpca:64:16", "cpca:256:4", "cpca:256:8",
                "cpca:64:8:byte", "pca:16:byte"},
               {"half", "band8", "pca:2", "vq:8", "cpca:4:2"}, "methods of `compress`")
          .add("encodingScenes", &TransferOptions::encodingScenes, {"cornell", "rooms", "shapes", "bumps"},
               {"cornell"}, "scenes of `encodings`")
          .add("encodingPlaces", &TransferOptions::encodingPlaces, 24, 2,
               "points of each scene of `encodings`")
          .add("encodingSide", &TransferOptions::encodingSide, 32, 4,
               "pixels per side of the pictures of what a point sees", {.most = 1024})
          .add("encodingSamples", &TransferOptions::encodingSamples, 128, 4,
               "samples per pixel of those pictures")
          .add("animationKeys", &TransferOptions::animationKeys, {2, 3, 5, 9, 17}, {2, 3},
               "numbers of evenly spaced keys of `animation`", {.least = 2})
          .add("animationErrors", &TransferOptions::animationErrors, {0.1, 0.05, 0.03}, {0.3},
               "errors by which keys are chosen", {.least = 1e-6, .most = 1})
          .add("animationMoments", &TransferOptions::animationMoments, 8, 2,
               "number of moments between two keys that are compared");
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
