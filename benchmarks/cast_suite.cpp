#include <algorithm>
#include <random>
#include <span>

#include "bake/surface_sampler.h"
#include "benchmarks/measure.h"
#include "benchmarks/suites.h"
#include "bvh/tracer.h"
#include "device/buffer.h"
#include "shared/cast_types.h"

namespace prelight::benchmarks {

namespace {

using device::CastParameters;
using device::Hit;
using device::Ray;
using device::Receiver;

constexpr std::uint32_t raysPerReceiver = 64;  // as a bake of 1024 rays a vertex
constexpr std::uint64_t seed = 1;

/// Rays of a launch, as in a bake: what fits a CPU's cache, what fills a GPU.
std::size_t raysPerLaunch(const DeviceInfo& info) {
  return info.kind == DeviceKind::Gpu ? std::size_t{1} << 21 : std::size_t{1} << 16;
}

std::vector<Receiver> placeReceivers(const CompiledScene& scene, std::uint64_t rays) {
  std::vector<Receiver> receivers;
  SurfaceSampler(scene, seed, Side::Front)
      .pass(static_cast<double>(rays / raysPerReceiver), raysPerReceiver,
            [&](const SurfaceSample&, const Receiver& receiver) { receivers.push_back(receiver); });
  return receivers;
}

/// The rays of a bake in the order in which it casts them: receivers by triangle, all directions of a
/// receiver together.
std::vector<Ray> raysInBakeOrder(const CompiledScene& scene, DeviceContext& device, std::uint64_t count) {
  const std::vector<Receiver> receivers = placeReceivers(scene, count);
  const CastParameters parameters{
      static_cast<std::uint32_t>(receivers.size()), raysPerReceiver, 0, scene.vertexCount(), 0, {}};
  Buffer<CastParameters> parameterBuffer(device, std::span(&parameters, 1));
  Buffer<Receiver> receiverBuffer(device, std::span<const Receiver>(receivers));
  Buffer<Ray> rays(device, receivers.size() * raysPerReceiver);
  cl::Kernel generate(device.program("cast/generate_kernels.cl", {}), "generateRays");
  setArguments(generate, parameterBuffer.get(), receiverBuffer.get(), rays.get());
  device.launch(generate, rays.size(), 64);
  return rays.read();
}

/// Rays on the device, a buffer a launch.
class RayBlocks {
 public:
  RayBlocks(DeviceContext& device, std::span<const Ray> rays) : device_(device), count_(rays.size()) {
    const std::size_t block = std::min(rays.size(), raysPerLaunch(device.info()));
    hits_ = Buffer<Hit>(device, block);
    for (std::size_t first = 0; first < rays.size(); first += block)
      blocks_.emplace_back(device, rays.subspan(first, std::min(block, rays.size() - first)));
  }

  double raysPerSecond(double seconds) const { return static_cast<double>(count_) / seconds; }

  /// Seconds until the device has traced all of them.
  double trace(Tracer& tracer, bool any) {
    device_.finish();
    return secondsOf([&] {
      for (const Buffer<Ray>& rays : blocks_)
        any ? tracer.traceAny(rays, hits_, rays.size()) : tracer.traceClosest(rays, hits_, rays.size());
      device_.finish();
    });
  }

 private:
  DeviceContext& device_;
  std::size_t count_;
  std::vector<Buffer<Ray>> blocks_;
  Buffer<Hit> hits_;
};

std::string treeName(BvhLayout layout) { return layout == BvhLayout::Wide ? "wide tree" : "narrow tree"; }

BvhLayout otherLayout(BvhLayout layout) {
  return layout == BvhLayout::Wide ? BvhLayout::Narrow : BvhLayout::Wide;
}

/// The tree that the device is given and the other one, over the same scene.
struct Trees {
  Tracer chosen;
  Tracer other;

  Trees(const CompiledScene& scene, const Device& device)
      : chosen(scene, device), other(scene, device, otherLayout(chosen.layout())) {}
};

/// One order of rays and one kind of query, and the seconds of both trees over the runs.
struct CastCase {
  std::string name;
  RayBlocks* rays;
  bool any;
  std::vector<double> chosen = {};
  std::vector<double> other = {};

  void run(Trees& trees) {
    chosen.push_back(rays->trace(trees.chosen, any));
    other.push_back(rays->trace(trees.other, any));
  }

  BenchmarkResult result(const Trees& trees) const {
    return {"cast",
            name,
            "throughput",
            rays->raysPerSecond(median(chosen)),
            "rays/s",
            treeName(trees.other.layout()),
            median(other) / median(chosen)};
  }
};

/// Trees and cases take turns, run by run, so that all meet the same disturbances.
void measureScene(const BenchmarkScene& scene, const Device& device, const BenchmarkOptions& options,
                  StepCounter& steps, std::vector<BenchmarkResult>& results) {
  Trees trees(scene.compiled, device);
  std::vector<Ray> rays = raysInBakeOrder(scene.compiled, device.context(), options.castRays);
  RayBlocks inBakeOrder(device.context(), rays);
  std::shuffle(rays.begin(), rays.end(), std::mt19937_64(seed));
  RayBlocks inRandomOrder(device.context(), rays);
  const std::vector<CastCase> cases = {{scene.name + "/bake order/closest hit", &inBakeOrder, false},
                                       {scene.name + "/bake order/any hit", &inBakeOrder, true},
                                       {scene.name + "/random order/closest hit", &inRandomOrder, false},
                                       {scene.name + "/random order/any hit", &inRandomOrder, true}};
  for (CastCase warmUp : cases) warmUp.run(trees);
  steps.advance();
  std::vector<CastCase> measured = cases;
  for (int run = 0; run < options.runs; ++run) {
    for (CastCase& one : measured) one.run(trees);
    steps.advance();
  }
  for (const CastCase& one : measured) results.push_back(one.result(trees));
}

}  // namespace

std::vector<BenchmarkResult> runCastSuite(const Device& device, const BenchmarkOptions& options,
                                          Progress& progress) {
  const std::vector<BenchmarkScene> scenes = loadBuiltinScenes();
  StepCounter steps(progress, "bench cast", scenes.size() * static_cast<std::size_t>(options.runs + 1));
  std::vector<BenchmarkResult> results;
  for (const BenchmarkScene& scene : scenes) measureScene(scene, device, options, steps, results);
  return results;
}

}  // namespace prelight::benchmarks
