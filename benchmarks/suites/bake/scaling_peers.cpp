#include "benchmarks/suites/bake/scaling_peers.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "benchmarks/peers/embree/vertex_baker.h"
#include "benchmarks/run/measure.h"
#include "benchmarks/run/timing.h"
#include "benchmarks/suites/bake/surface_error.h"
#include "cast/caster.h"
#include "cast/scene_cast.h"
#include "cast/schedule.h"
#include "io/baked_file.h"
#include "plan/shadow_sets.h"
#include "prelight/error.h"
#include "receivers/surface_sampler.h"
#include "scene/gltf/load/loader.h"

namespace prelight::benchmarks {

namespace {

using device::CastParameters;
using device::Hit;
using device::Ray;
using device::Receiver;

constexpr std::size_t launches = 16;  // launches in the queue at once, as in a tracer that waits for nothing

/// Traces the rays of blocks of receivers as soon as there are enough for several launches.
class BlockTracer {
 public:
  BlockTracer(Tracer& tracer, const CompiledScene& scene, std::uint32_t raysPerReceiver, bool closest,
              int rounds)
      : tracer_(tracer),
        device_(tracer.context()),
        vertexCount_(scene.vertexCount()),
        raysPerReceiver_(raysPerReceiver),
        closest_(closest),
        rounds_(rounds),
        block_(receiversPerBlock(device_.info(), raysPerReceiver)),
        parameters_(device_, 1),
        hits_(device_, std::size_t{block_} * raysPerReceiver),
        generate_(device_, "cast/generate_kernels.cl", {}, "generateRays") {
    for (std::size_t l = 0; l < launches; ++l)
      rays_.emplace_back(device_, std::size_t{block_} * raysPerReceiver);
  }

  void add(const Receiver& receiver) {
    pending_.push_back(receiver);
    if (pending_.size() == block_) endBlock();
  }

  /// Ends a block. Blocks end with each pass, as in a bake.
  void endBlock() {
    if (pending_.empty()) return;
    generate(rays_[counts_.size()]);
    counts_.push_back(pending_.size() * raysPerReceiver_);
    added_ += counts_.back();
    pending_.clear();
    if (counts_.size() == launches) trace();
  }

  TracingCost finish() {
    endBlock();
    trace();
    return cost_;
  }

  /// Returns the rays that were traced or wait to be traced.
  std::uint64_t rays() const { return added_; }

 private:
  void generate(Buffer<Ray>& rays) {
    const CastParameters parameters{
        static_cast<std::uint32_t>(pending_.size()), raysPerReceiver_, 0, vertexCount_, 0, 0.0f, 0.0f, 0.0f};
    parameters_.write(std::span(&parameters, 1));
    const Buffer<Receiver> receivers(device_, std::span<const Receiver>(pending_));
    generate_.launch(pending_.size() * raysPerReceiver_ / 8, parameters_, receivers, rays);
    device_.finish();
  }

  void trace() {
    double least = std::numeric_limits<double>::max(), leastProcessor = least;
    for (int round = 0; round < rounds_ && !counts_.empty(); ++round) {
      const double processor = processorSeconds();
      least = std::min(least, secondsOf([&] {
                         for (std::size_t l = 0; l < counts_.size(); ++l)
                           closest_ ? tracer_.traceClosest(rays_[l], hits_, counts_[l])
                                    : tracer_.traceAny(rays_[l], hits_, counts_[l]);
                         device_.finish();
                       }));
      leastProcessor = std::min(leastProcessor, processorSeconds() - processor);
    }
    if (counts_.empty()) return;
    cost_.seconds += least;
    cost_.processorSeconds += leastProcessor;
    for (const std::size_t count : counts_) cost_.rays += count;
    counts_.clear();
  }

  Tracer& tracer_;
  DeviceContext& device_;
  std::uint32_t vertexCount_;
  std::uint32_t raysPerReceiver_;
  bool closest_;
  int rounds_;
  std::uint32_t block_;
  Buffer<CastParameters> parameters_;
  Buffer<Hit> hits_;
  Kernel<Buffer<CastParameters>, Buffer<Receiver>, Buffer<Ray>> generate_;
  std::vector<Buffer<Ray>> rays_;
  std::vector<Receiver> pending_;
  std::vector<std::size_t> counts_;  ///< [block] rays that wait to be traced
  std::uint64_t added_ = 0;
  TracingCost cost_;
};

}  // namespace

TracingCost traceRaysAlone(const CompiledScene& scene, const BakeRequest& request, Tracer& tracer,
                           std::uint64_t enough, int rounds, const Progress& progress) {
  const FitMesh mesh = makeFitMesh(scene, makeShadowSets(scene, request.shadowSets).setOfVertices(scene));
  const Schedule schedule = makeSchedule(request, mesh.slotCount(), std::chrono::steady_clock::now());
  SurfaceSampler sampler = frontSampler(scene, mesh, schedule);
  BlockTracer blocks(tracer, scene, schedule.raysPerReceiver, request.bounces > 0 && request.sh.order > 0,
                     rounds);
  for (std::uint32_t pass = 0; pass < schedule.passes && blocks.rays() < enough; ++pass) {
    sampler.pass(schedule.receiversPerPass, schedule.raysPerReceiver,
                 [&](const SurfaceSample&, const Receiver& receiver) { blocks.add(receiver); });
    blocks.endBlock();
    progress.check();
  }
  return blocks.finish();
}

namespace {

constexpr const char* peerName = "Embree at vertices";

/// Returns whether a technique bakes transfer, not only AO.
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

  /// Compares the bakes of one technique.
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

  /// Returns the peer's bakes, ascending in rays.
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

  /// Adds Prelight's time, compared with the peer's time to the same error.
  void addRow(const std::string& name, const std::string& metric, double seconds, const TimeToError& peer) {
    const std::string bound = peer.kind == TimeToError::Kind::AtLeast  ? ", at least"
                              : peer.kind == TimeToError::Kind::AtMost ? ", at most"
                                                                       : "";
    add(name, metric, seconds, "s", fmt::format("{} to the same error{}", peerName, bound),
        peer.seconds / seconds);
  }

  /// Adds Prelight's time to the peer's error, compared with the peer's time.
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
