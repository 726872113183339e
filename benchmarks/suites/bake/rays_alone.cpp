#include "benchmarks/suites/bake/rays_alone.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <span>
#include <vector>

#include "benchmarks/run/measure.h"
#include "benchmarks/run/processor_time.h"
#include "cast/caster.h"
#include "cast/scene_cast.h"
#include "cast/schedule.h"
#include "plan/shadow_sets.h"
#include "receivers/surface_sampler.h"

namespace prelight::benchmarks {

namespace {

using device::CastParameters;
using device::Hit;
using device::Ray;
using device::Receiver;

constexpr std::size_t launches = 16;  // that are queued at once, as a tracer with nothing to wait for does

/// Blocks of receivers, of which the rays are traced as soon as there are enough for some launches.
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

  /// A block ends where a pass does, as in a bake.
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

  /// Traced, or waiting to be.
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
  std::vector<std::size_t> counts_;  ///< rays of the blocks that wait to be traced
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

}  // namespace prelight::benchmarks
