#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "benchmarks/run/measure.h"
#include "benchmarks/suites/transfer/transfer_suite.h"
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
  results.push_back({scene + "/" + method, "bytes a vertex", bytes / vertices, "B", "float",
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

}  // namespace prelight::benchmarks
