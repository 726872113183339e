#include "integrators/path_tracer.h"

#include <algorithm>

#include "integrators/camera_upload.h"

namespace prelight::reference {

namespace {

using namespace device;

constexpr std::size_t groupSize = 64;

/// Enough to keep a device busy, few enough that a launch stays far below a second. Paths to cached light are
/// short, but for a few through mirrors and glass, which take as many launches for many paths as for few.
std::uint32_t pathsPerBlock(const DeviceInfo& info, bool cachedLight) {
  if (info.kind == DeviceKind::Gpu) return 1u << 20;
  return cachedLight ? 1u << 17 : 1u << 16;
}

std::uint32_t foldSeed(std::uint64_t seed) {
  return static_cast<std::uint32_t>(seed) ^ (static_cast<std::uint32_t>(seed >> 32) * 0x9e3779b9u);
}

}  // namespace

PathTracer::PathTracer(TransportScene& scene, const CompiledScene& compiled, const Camera& camera,
                       const ReferenceRequest& request, const CachedLight* cached)
    : scene_(scene),
      device_(scene.context()),
      request_(request),
      parameters_(device_, 1),
      counters_(device_, 2) {
  const std::uint32_t samples = samplesPerPass(request);
  const auto pixels = static_cast<std::uint32_t>(request.width) * static_cast<std::uint32_t>(request.height);
  blockPixels_ = std::clamp(pathsPerBlock(device_.info(), cached != nullptr) / samples, 1u, pixels);
  values_.samplesPerPass = samples;
  values_.seed = foldSeed(request.seed);
  values_.rouletteDepth = static_cast<std::uint32_t>(request.rouletteDepth);
  values_.lights = scene.layout();
  setCamera(camera, compiled, request.width, request.height, values_);

  const std::size_t paths = std::size_t{blockPixels_} * samples;
  paths_ = Buffer<PathState>(device_, paths);
  for (auto& rays : rayBuffers_) rays = Buffer<Ray>(device_, paths);
  for (auto& queue : queues_) queue = Buffer<std::uint32_t>(device_, paths);
  hits_ = Buffer<Hit>(device_, paths);
  shadowHits_ = Buffer<Hit>(device_, paths);
  shadowRays_ = Buffer<Ray>(device_, paths);
  items_ = Buffer<ShadowItem>(device_, paths);
  meanBuffer_ = Buffer<glm::vec4>(device_, blockPixels_);
  cached_ = cached != nullptr;
  meetsLights_ = cached_ && cached->meetsLights;
  if (cached_)
    buildCachedKernels(request, compiled, *cached);
  else
    buildKernels(request);
  if (request.integrator == Integrator::Instant) virtual_.emplace(scene, compiled, request);
}

void PathTracer::buildKernels(const ReferenceRequest& request) {
  const cl::Program& program =
      device_.program("reference/path_kernels.cl", buildOptions(request, std::nullopt, scene_.options()));
  generate_ = cl::Kernel(program, "generatePaths");
  collect_ = cl::Kernel(program, "collectRadiance");
  sample_ = cl::Kernel(program, "sampleLights");
  if (request.integrator == Integrator::Instant)
    sampleVirtual_ = cl::Kernel(device_.program("reference/virtual_kernels.cl",
                                                buildOptions(request, std::nullopt, scene_.options())),
                                "sampleVirtualLight");
  add_ = cl::Kernel(program, "addArrivals");
  scatter_ = cl::Kernel(program, "scatterPaths");
  average_ = cl::Kernel(program, "averageSamples");
}

void PathTracer::buildCachedKernels(const ReferenceRequest& request, const CompiledScene& compiled,
                                    const CachedLight& cached) {
  const cl::Program& program =
      device_.program("reference/cached_path_kernels.cl",
                      cachedLightOptions(cached, buildOptions(request, meetsLights_, scene_.options())));
  generate_ = cl::Kernel(program, "generatePaths");
  follow_ = followPathsKernel(program, scene_, compiled, cached, values_.samplesPerPass);
  add_ = cl::Kernel(program, "addArrivals");
  average_ = cl::Kernel(program, "averageSamples");
}

const std::vector<glm::vec4>& PathTracer::trace(std::uint64_t pass, std::uint32_t first,
                                                std::uint32_t count) {
  if (virtual_ && virtualPass_ != pass) virtual_->make(pass);
  virtualPass_ = pass;
  values_.pass = static_cast<std::uint32_t>(pass);
  values_.firstPixel = first;
  values_.pathCount = count * values_.samplesPerPass;
  parameters_.write(std::span<const ReferenceParameters>(&values_, 1));
  current_ = 0;
  std::uint32_t active = values_.pathCount;
  setArguments(generate_, parameters_.get(), paths_.get(), queues_[0].get(), rayBuffers_[0].get());
  device_.launch(generate_, active, groupSize);
  for (std::uint32_t depth = 0; active > 0; ++depth) tracePaths(depth, active);
  setArguments(average_, parameters_.get(), paths_.get(), meanBuffer_.get());
  device_.launch(average_, count, groupSize);
  means_.resize(count);
  meanBuffer_.read(std::span(means_));
  return means_;
}

/// One vertex of all paths that are left; `count` becomes the number of those that go on.
void PathTracer::tracePaths(std::uint32_t depth, std::uint32_t& count) {
  scene_.tracer().traceClosest(rayBuffers_[current_], hits_, count);
  rays_ += count;
  if (cached_) {
    count = followToCachedLight(count, depth);
    return;
  }
  collect(count, depth);
  const bool last = depth + 1 >= static_cast<std::uint32_t>(request_.depth);
  if (last || !scene_.features().scatters) {
    count = 0;
    return;
  }
  if (request_.integrator == Integrator::Whitted)
    for (std::uint32_t light = 0; light < scene_.lights().punctual.size(); ++light)
      addDirectLight(count, depth, light);
  if (scene_.lights().groupCount > 0) addDirectLight(count, depth, PRELIGHT_NO_TRIANGLE);
  if (virtual_) addVirtualLights(count);
  count = scatter(count, depth);
  current_ = 1 - current_;
}

/// All of a vertex at once; returns how many paths go on.
std::uint32_t PathTracer::followToCachedLight(std::uint32_t count, std::uint32_t depth) {
  const bool last = depth + 1 >= static_cast<std::uint32_t>(request_.depth);
  const cl_uint meets = last || !scene_.features().scatters ? 0 : 1;
  const cl_uint goesOn = meetsLights_ || scene_.features().specularLobes() ? 1 : 0;
  const std::size_t next = 1 - current_;
  counters_.fill(0);
  setArguments(follow_, parameters_.get(), count, depth, meets, goesOn, rayBuffers_[current_].get(),
               hits_.get(), queues_[current_].get(), paths_.get(), shadowRays_.get(), items_.get(),
               rayBuffers_[next].get(), queues_[next].get(), counters_.get());
  device_.launch(follow_, count, groupSize);
  const auto [shadows, left] = readCounters();
  castShadows(shadows);
  current_ = next;
  return left;
}

void PathTracer::collect(std::uint32_t count, std::uint32_t depth) {
  setArguments(collect_, parameters_.get(), count, depth, rayBuffers_[current_].get(), hits_.get(),
               queues_[current_].get(), paths_.get());
  scene_.setArguments(collect_, 7);
  device_.launch(collect_, count, groupSize);
}

void PathTracer::addDirectLight(std::uint32_t count, std::uint32_t depth, std::uint32_t light) {
  counters_.fill(0);
  setArguments(sample_, parameters_.get(), count, depth, rayBuffers_[current_].get(), hits_.get(),
               queues_[current_].get(), paths_.get());
  const cl_uint index = scene_.setArguments(sample_, 7);
  sample_.setArg(index, light);
  sample_.setArg(index + 1, shadowRays_.get());
  sample_.setArg(index + 2, items_.get());
  sample_.setArg(index + 3, counters_.get());
  device_.launch(sample_, count, groupSize);
  castShadows(readCounters()[0]);
}

/// Of all virtual lights, one after the other.
void PathTracer::addVirtualLights(std::uint32_t count) {
  for (std::uint32_t light = 0; light < virtual_->count(); ++light) {
    counters_.fill(0);
    setArguments(sampleVirtual_, parameters_.get(), count, rayBuffers_[current_].get(), hits_.get(),
                 queues_[current_].get(), paths_.get());
    const cl_uint index = scene_.surface().setArguments(sampleVirtual_, 6);
    sampleVirtual_.setArg(index, virtual_->lights().get());
    sampleVirtual_.setArg(index + 1, light);
    sampleVirtual_.setArg(index + 2, virtual_->leastSquare());
    sampleVirtual_.setArg(index + 3, shadowRays_.get());
    sampleVirtual_.setArg(index + 4, items_.get());
    sampleVirtual_.setArg(index + 5, counters_.get());
    device_.launch(sampleVirtual_, count, groupSize);
    castShadows(readCounters()[0]);
  }
}

/// Adds what so many shadow rays that were made bring.
void PathTracer::castShadows(std::uint32_t shadows) {
  if (shadows == 0) return;
  // The hits of the paths' own rays are needed once more, so shadow rays have theirs.
  scene_.tracer().traceAny(shadowRays_, shadowHits_, shadows);
  rays_ += shadows;
  setArguments(add_, shadows, shadowHits_.get(), items_.get(), paths_.get());
  device_.launch(add_, shadows, groupSize);
}

std::uint32_t PathTracer::scatter(std::uint32_t count, std::uint32_t depth) {
  counters_.fill(0);
  const std::size_t next = 1 - current_;
  setArguments(scatter_, parameters_.get(), count, depth, rayBuffers_[current_].get(), hits_.get(),
               queues_[current_].get(), paths_.get());
  const cl_uint index = scene_.surface().setArguments(scatter_, 7);
  scatter_.setArg(index, rayBuffers_[next].get());
  scatter_.setArg(index + 1, queues_[next].get());
  scatter_.setArg(index + 2, counters_.get());
  device_.launch(scatter_, count, groupSize);
  return readCounters()[1];
}

std::array<std::uint32_t, 2> PathTracer::readCounters() const {
  std::array<std::uint32_t, 2> counters{};
  counters_.read(std::span(counters));
  return counters;
}

}  // namespace prelight::reference
