#include "benchmarks/bake_scaling_peer.h"

#include <fmt/format.h>

#include <optional>

#include "benchmarks/measure.h"
#include "benchmarks/surface_error.h"
#include "benchmarks/vertex_baker.h"
#include "io/baked_file.h"
#include "prelight/error.h"
#include "scene/gltf/loader.h"

namespace prelight::benchmarks {

namespace {

constexpr const char* peerName = "Embree at vertices";

/// Which of the values a technique makes.
bool carriesTransfer(const std::string& technique) { return technique.find("--sh") != std::string::npos; }

class Comparison {
 public:
  Comparison(std::string scene, const std::filesystem::path& file, std::size_t threads,
             const BenchmarkOptions& options, const Progress& progress)
      : scene_(std::move(scene)), threads_(threads), options_(options), progress_(progress) {
    Warnings warnings;
    compiled_ = compileScene(loadScene(readGltf(file, warnings), warnings), warnings);
    const std::unique_ptr<RayPeer> rays = makeEmbreePeer(compiled_, PeerQuality::Medium, threads);
    truth_ =
        findSurfaceTruth(compiled_, *rays, options.bakeScalingPlaces, options.bakeScalingTruthSide, progress);
  }

  void compare(const FinishedBake& bake) {
    const bool transfer = carriesTransfer(bake.technique);
    Warnings warnings;
    const std::optional<Bake> read = readBake(readGltf(bake.file, warnings), compiled_);
    if (!read || read->ao.empty() || (transfer && (!read->sh || read->sh->channels != 3)))
      throw Error(ExitCode::RuntimeFailure, bake.file.string(), "it lacks what was baked");
    const double error = transfer ? transferError(read->sh->coefficients) : accessibilityError(read->ao);
    add(bake.name, "error", error, transfer ? "of SH" : "AO");
    const TimeToError peer = timeToError(curveOf(transfer), error);
    add(bake.name, "bake", bake.seconds, "s", nameOf(peer.kind), peer.seconds / bake.seconds);
  }

  std::vector<BenchmarkResult> take() { return std::move(results_); }

 private:
  static std::string nameOf(TimeToError::Kind kind) {
    if (kind == TimeToError::Kind::AtMost) return fmt::format("{}, better after its fewest rays", peerName);
    if (kind == TimeToError::Kind::AtLeast) return fmt::format("{}, worse after its most rays", peerName);
    return fmt::format("{}, to the same error", peerName);
  }

  double transferError(const std::vector<float>& values) const {
    const SurfaceError found = surfaceError(compiled_, truth_.places, truth_.transfer, values);
    return found.error / found.size;
  }

  double accessibilityError(const std::vector<float>& values) const {
    return surfaceError(compiled_, truth_.places, truth_.accessibility, values).error;
  }

  /// Errors over seconds, measured when they are asked for first.
  const std::vector<Point>& curveOf(bool transfer) {
    std::vector<Point>& curve = transfer ? transferCurve_ : accessibilityCurve_;
    for (std::size_t i = curve.size(); i < options_.bakeScalingPeerSides.size(); ++i) {
      const std::uint32_t side = options_.bakeScalingPeerSides[i];
      const std::uint64_t rays = std::uint64_t{side} * side;
      if (i > 0 && rays * compiled_.vertexCount() > options_.bakeScalingPeerRays) break;
      curve.push_back(measurePeer(side, transfer));
      const std::string name =
          fmt::format("{}/{} {}/{} rays", scene_, peerName, transfer ? "SH" : "AO", rays);
      add(name, "error", curve.back().y, transfer ? "of SH" : "AO");
      add(name, "bake", curve.back().x, "s");
      progress_.check();
    }
    return curve;
  }

  Point measurePeer(std::uint32_t side, bool transfer) const {
    std::vector<double> seconds;
    double error = 0.0;
    do {
      const VertexBake bake = bakeAtVertices(compiled_, {side, transfer}, threads_).value();
      seconds.push_back(bake.seconds);
      error = transfer ? transferError(bake.transfer) : accessibilityError(bake.ao);
    } while (static_cast<int>(seconds.size()) < options_.runs &&
             compiled_.vertexCount() * std::uint64_t{side} * side < options_.bakeScalingLongBake);
    return {median(seconds), error};
  }

  void add(const std::string& name, const std::string& metric, double value, const std::string& unit,
           const std::string& peer = {}, std::optional<double> ratio = {}) {
    results_.push_back({"bake-scaling", name, metric, value, unit, peer, ratio});
  }

  std::string scene_;
  std::size_t threads_;
  const BenchmarkOptions& options_;
  const Progress& progress_;
  CompiledScene compiled_;
  SurfaceTruth truth_;
  std::vector<Point> transferCurve_, accessibilityCurve_;
  std::vector<BenchmarkResult> results_;
};

}  // namespace

std::vector<BenchmarkResult> compareWithVertexBaker(const std::string& scene,
                                                    const std::vector<FinishedBake>& bakes,
                                                    std::size_t threads, const BenchmarkOptions& options,
                                                    Progress& progress) {
  if (embreeVersion().empty() || bakes.empty()) return {};
  const StopOnly stop(progress);
  Comparison comparison(scene, bakes.front().file, threads, options, stop);
  for (const FinishedBake& bake : bakes) comparison.compare(bake);
  return comparison.take();
}

}  // namespace prelight::benchmarks
