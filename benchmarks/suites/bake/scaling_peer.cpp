#include "benchmarks/suites/bake/scaling_peer.h"

#include <fmt/format.h>

#include <optional>

#include "benchmarks/peers/embree/vertex_baker.h"
#include "benchmarks/run/measure.h"
#include "benchmarks/suites/bake/surface_error.h"
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
             const BakeOptions& options, const Progress& progress)
      : scene_(std::move(scene)), threads_(threads), options_(options), progress_(progress) {
    Warnings warnings;
    compiled_ = compileScene(loadScene(readGltf(file, warnings), warnings), warnings);
    const std::unique_ptr<RayPeer> rays = makeEmbreePeer(compiled_, PeerQuality::Medium, threads);
    truth_ = findSurfaceTruth(compiled_, *rays, options.errorPlaces, options.truthSide, progress);
  }

  /// Bakes of one technique.
  void compare(const std::vector<FinishedBake>& bakes) {
    const std::string& technique = bakes.front().technique;
    const bool transfer = carriesTransfer(technique);
    std::vector<Measured> own;
    for (const FinishedBake& bake : bakes)
      own.push_back({bake.name, bake.seconds, bake.processorSeconds, errorOf(bake.file, transfer)});
    const std::vector<Measured> peer = measurePeer(transfer);
    for (const Measured& one : own) {
      addError(one, transfer);
      addRow(one.name, "bake", one.seconds, timeToError(curveOf(peer, &Measured::seconds), one.error));
      addRow(one.name, "bake processor", one.processorSeconds,
             timeToError(curveOf(peer, &Measured::processorSeconds), one.error));
    }
    for (const Measured& one : peer) {
      addError(one, transfer);
      add(one.name, "bake", one.seconds, "s");
      add(one.name, "bake processor", one.processorSeconds, "s");
      const std::string name =
          fmt::format("{}/{}/as Embree at {}", scene_, technique, one.name.substr(one.name.rfind('/') + 1));
      addReverse(name, "bake", timeToError(curveOf(own, &Measured::seconds), one.error), one.seconds);
      addReverse(name, "bake processor", timeToError(curveOf(own, &Measured::processorSeconds), one.error),
                 one.processorSeconds);
    }
  }

  std::vector<BenchmarkResult> take() { return std::move(results_); }

 private:
  struct Measured {
    std::string name;
    double seconds = 0.0;
    double processorSeconds = 0.0;
    double error = 0.0;
  };

  static std::vector<Point> curveOf(const std::vector<Measured>& measured, double Measured::*seconds) {
    std::vector<Point> curve;
    for (const Measured& one : measured) curve.push_back({one.*seconds, one.error});
    return curve;
  }

  double errorOf(const std::filesystem::path& file, bool transfer) const {
    Warnings warnings;
    const std::optional<Bake> read = readBake(readGltf(file, warnings), compiled_);
    if (!read || read->ao.empty() || (transfer && (!read->sh || read->sh->channels != 3)))
      throw Error(ExitCode::RuntimeFailure, file.string(), "it lacks what was baked");
    return transfer ? transferError(read->sh->coefficients) : accessibilityError(read->ao);
  }

  double transferError(const std::vector<float>& values) const {
    const SurfaceError found = surfaceError(compiled_, truth_.places, truth_.transfer, values);
    return found.error / found.size;
  }

  double accessibilityError(const std::vector<float>& values) const {
    return surfaceError(compiled_, truth_.places, truth_.accessibility, values).error;
  }

  /// Ascending in rays.
  std::vector<Measured> measurePeer(bool transfer) const {
    std::vector<Measured> measured;
    for (const std::uint32_t side : options_.peerSides) {
      const std::uint64_t rays = std::uint64_t{side} * side;
      if (!measured.empty() && rays * compiled_.vertexCount() > options_.peerRays) break;
      measured.push_back(measurePeer(side, transfer));
      progress_.check();
    }
    return measured;
  }

  Measured measurePeer(std::uint32_t side, bool transfer) const {
    const std::uint64_t rays = std::uint64_t{side} * side;
    const int runs = rays * compiled_.vertexCount() < options_.scalingLongBake ? options_.runs : 1;
    std::vector<double> seconds, processor;
    double error = 0.0;
    for (int run = 0; run < runs; ++run) {
      const VertexBake bake = bakeAtVertices(compiled_, {side, transfer}, threads_).value();
      seconds.push_back(bake.seconds), processor.push_back(bake.processorSeconds);
      if (run == 0) error = transfer ? transferError(bake.transfer) : accessibilityError(bake.ao);
    }
    return {fmt::format("{}/{} {}/{} rays", scene_, peerName, transfer ? "SH" : "AO", rays), median(seconds),
            median(processor), error};
  }

  void addError(const Measured& one, bool transfer) {
    add(one.name, "error", one.error, transfer ? "of SH" : "AO");
  }

  /// Prelight's time, and the peer's to the same error.
  void addRow(const std::string& name, const std::string& metric, double seconds, const TimeToError& peer) {
    const std::string bound = peer.kind == TimeToError::Kind::AtLeast  ? ", at least"
                              : peer.kind == TimeToError::Kind::AtMost ? ", at most"
                                                                       : "";
    add(name, metric, seconds, "s", fmt::format("{} to the same error{}", peerName, bound),
        peer.seconds / seconds);
  }

  /// Prelight's time to the peer's error, and the peer's.
  void addReverse(const std::string& name, const std::string& metric, const TimeToError& own, double peer) {
    const std::string bound = own.kind == TimeToError::Kind::AtMost    ? ", at least"
                              : own.kind == TimeToError::Kind::AtLeast ? ", at most"
                                                                       : "";
    add(name, metric, own.seconds, "s", fmt::format("{}{}", peerName, bound), peer / own.seconds);
  }

  void add(const std::string& name, const std::string& metric, double value, const std::string& unit,
           const std::string& peer = {}, std::optional<double> ratio = {}) {
    results_.push_back({name, metric, value, unit, peer, ratio});
  }

  std::string scene_;
  std::size_t threads_;
  const BakeOptions& options_;
  const Progress& progress_;
  CompiledScene compiled_;
  SurfaceTruth truth_;
  std::vector<BenchmarkResult> results_;
};

}  // namespace

std::vector<BenchmarkResult> compareWithVertexBaker(const std::string& scene,
                                                    const std::vector<FinishedBake>& bakes,
                                                    std::size_t threads, const BakeOptions& options,
                                                    Progress& progress) {
  if (embreeVersion().empty() || bakes.empty()) return {};
  const StopOnly stop(progress);
  Comparison comparison(scene, bakes.front().file, threads, options, stop);
  for (std::size_t first = 0; first < bakes.size();) {
    std::size_t end = first;
    while (end < bakes.size() && bakes[end].technique == bakes[first].technique) ++end;
    comparison.compare({bakes.begin() + static_cast<std::ptrdiff_t>(first),
                        bakes.begin() + static_cast<std::ptrdiff_t>(end)});
    first = end;
  }
  return comparison.take();
}

}  // namespace prelight::benchmarks
