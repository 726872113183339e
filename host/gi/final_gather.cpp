#include "gi/final_gather.h"

#include <algorithm>

#include "cast/caster.h"

namespace prelight {

namespace {

using namespace device;

constexpr std::size_t groupSize = 64;
/// Of a caster's: the last rays that mirrors and glass pass on are few, and each round of them waits.
constexpr std::uint32_t blocksAtOnce = 4;

}  // namespace

FinalGather::FinalGather(const CompiledScene& compiled, TransportScene& scene,
                         const IrradianceMap& irradiance, const GatherRequest& request)
    : scene_(scene),
      device_(scene.context()),
      irradiance_(irradiance),
      request_(request),
      blockSize_(blocksAtOnce * receiversPerBlock(device_.info(), request.raysPerReceiver)),
      follows_(scene.features().specularLobes()),
      castParameters_(device_, 1),
      parameters_(device_, 1),
      receivers_(device_, blockSize_),
      sums_(device_, 3 * std::size_t{blockSize_}),
      counter_(device_, 1) {
  const std::size_t rays = std::size_t{blockSize_} * request.raysPerReceiver;
  rayBuffers_[0] = Buffer<Ray>(device_, rays);
  rayBuffers_[1] = Buffer<Ray>(device_, follows_ ? rays : 0);
  for (auto& paths : paths_) paths = Buffer<GatherPath>(device_, follows_ ? rays : 0);
  hits_ = Buffer<Hit>(device_, rays);
  radiances_ = Buffer<float>(device_, 3 * rays);
  values_.raysPerReceiver = request.raysPerReceiver;
  values_.seed = static_cast<std::uint32_t>(request.seed ^ (request.seed >> 32));
  values_.mapWidth = static_cast<std::uint32_t>(irradiance.width());
  values_.mapHeight = static_cast<std::uint32_t>(irradiance.height());
  values_.triangleCount = compiled.triangleCount();
  values_.longWay = request.longWay;
  generate_ = cl::Kernel(device_.program("cast/generate_kernels.cl", {}), "generateRays");
  const cl::Program& program =
      device_.program("gather/gather_kernels.cl", scene.options().defineIf(follows_, "PRELIGHT_FOLLOWS"));
  gather_ = cl::Kernel(program, "gatherRadiance");
  sum_ = cl::Kernel(program, "sumRadiance");
  sumIncident_ = cl::Kernel(program, "sumIncident");
}

template <typename Summing>
void FinalGather::gatherBlocks(std::span<const Receiver> receivers, Progress& progress,
                               std::vector<std::uint32_t>* seen, const Summing& sumBlock) {
  for (std::size_t first = 0; first < receivers.size(); first += blockSize_) {
    progress.report("final gathering", static_cast<double>(first) / static_cast<double>(receivers.size()));
    progress.check();
    const std::size_t count = std::min<std::size_t>(blockSize_, receivers.size() - first);
    traceBlock(receivers.subspan(first, count), seen);
    sumBlock(first, count);
  }
}

std::vector<glm::vec3> FinalGather::gather(std::span<const Receiver> receivers, Progress& progress,
                                           std::vector<std::uint32_t>* seen) {
  if (seen != nullptr) seen->clear();
  std::vector<glm::vec3> irradiance(receivers.size());
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  gatherBlocks(receivers, progress, seen, [&](std::size_t first, std::size_t count) {
    setArguments(sum_, parameters_.get(), radiances_.get(), sums_.get());
    device_.launch(sum_, count, groupSize);
    sums_.read(std::span(&irradiance[first].x, 3 * count));
  });
  return irradiance;
}

std::vector<float> FinalGather::gatherIncident(std::span<const Receiver> receivers, Progress& progress) {
  constexpr std::size_t length = 15;
  if (incident_.size() == 0) incident_ = Buffer<float>(device_, length * blockSize_);
  std::vector<float> incident(length * receivers.size());
  gatherBlocks(receivers, progress, nullptr, [&](std::size_t first, std::size_t count) {
    // Those that went on lie where the first ones were.
    if (follows_) device_.launch(generate_, count * request_.raysPerReceiver / 8, groupSize);
    setArguments(sumIncident_, parameters_.get(), receivers_.get(), rayBuffers_[0].get(), radiances_.get(),
                 incident_.get());
    device_.launch(sumIncident_, count, groupSize);
    incident_.read(std::span(&incident[length * first], length * count));
  });
  return incident;
}

void FinalGather::traceBlock(std::span<const Receiver> receivers, std::vector<std::uint32_t>* seen) {
  const auto count = static_cast<std::uint32_t>(receivers.size());
  values_.receiverCount = count;
  values_.lights = scene_.layout();
  parameters_.write(std::span<const GatherParameters>(&values_, 1));
  CastParameters cast{};
  cast.receiverCount = count;
  cast.raysPerReceiver = request_.raysPerReceiver;
  castParameters_.write(std::span<const CastParameters>(&cast, 1));
  receivers_.write(receivers);
  current_ = 0;
  setArguments(generate_, castParameters_.get(), receivers_.get(), rayBuffers_[0].get());
  std::uint32_t active = count * request_.raysPerReceiver;
  device_.launch(generate_, active / 8, groupSize);
  const std::uint32_t first = active;
  for (int depth = 0; depth < request_.depth && active > 0; ++depth) {
    active = collect(active, static_cast<std::uint32_t>(depth));
    if (depth > 0 || seen == nullptr) continue;
    std::vector<Hit> hits(first);
    hits_.read(std::span(hits));
    for (const Hit& hit : hits) seen->push_back(hit.triangle);
  }
}

/// One surface of the rays that are left; returns how many go on.
std::uint32_t FinalGather::collect(std::uint32_t count, std::uint32_t depth) {
  scene_.tracer().traceClosest(rayBuffers_[current_], hits_, count);
  rays_ += count;
  counter_.fill(0);
  setArguments(gather_, parameters_.get(), count, depth);
  cl_uint index = irradiance_.setArguments(gather_, scene_.setArguments(gather_, 3));
  const std::size_t next = 1 - current_;
  for (const cl::Buffer& buffer :
       {receivers_.get(), rayBuffers_[current_].get(), hits_.get(), paths_[current_].get(), radiances_.get(),
        rayBuffers_[next].get(), paths_[next].get(), counter_.get()})
    gather_.setArg(index++, buffer);
  device_.launch(gather_, count, groupSize);
  if (!follows_) return 0;
  current_ = next;
  std::uint32_t left = 0;
  counter_.read(std::span(&left, 1));
  return left;
}

}  // namespace prelight
