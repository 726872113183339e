#include "integrators/path_tracer.h"

#include <algorithm>
#include <utility>

#include "integrators/camera_rays.h"

namespace prelight::reference {

namespace {

using namespace device;

/// Returns the number of paths per block: enough to keep a device busy, and few enough that a launch takes
/// far less than a second. Paths to cached light are short except for a few through mirrors and glass, which
/// need as many launches for many paths as for few.
std::uint32_t pathsPerBlock(const DeviceInfo& info, bool cachedLight) {
  if (info.kind == DeviceKind::Gpu) return 1u << 20;
  return cachedLight ? 1u << 17 : 1u << 16;
}

/// Parts of the ray buffer: rays that are followed; rays that a step continues and rays to lights, both at
/// the indices of their paths; and the latter compacted.
enum RayPart : std::uint32_t { followed, sentOn, sentToLights, shadowRays, rayParts };

/// Number of light samples that one is resampled from.
constexpr int lightCandidates = 4;

/// Returns whether one light sample says too little about the surface: many samples of a sky lie behind it or
/// hardly contribute, and one of many lamps may be near.
bool choosesLights(const TransportScene& scene) {
  return scene.features().sky || scene.lights().punctual.size() > 1;
}

}  // namespace

PathTracer::PathTracer(TransportScene& scene, const CompiledScene& compiled, const Camera& camera,
                       const ReferenceRequest& request, const CachedLight* cached)
    : scene_(scene), device_(scene.context()), request_(request), parameters_(device_, 1) {
  if (cached != nullptr) cached_ = *cached;
  const std::uint32_t samples = samplesPerPass(request);
  const auto pixels = static_cast<std::uint32_t>(request.width) * static_cast<std::uint32_t>(request.height);
  blockPixels_ = std::clamp(pathsPerBlock(device_.info(), cached != nullptr) / samples, 1u, pixels);
  setPathParameters(request, scene, values_);
  setCamera(camera, compiled, request.width, request.height, values_);
  setLens(request.lens, values_);

  mostPaths_ = blockPixels_ * samples;
  values_.parts = request.parts ? mostPaths_ : 0;
  paths_ = Buffer<PathState>(device_, std::size_t{mostPaths_} + values_.parts);
  rayBuffer_ = Buffer<Ray>(device_, rayParts * std::size_t{mostPaths_});
  numbers_ = Buffer<std::uint32_t>(device_, mostPaths_);
  nextNumbers_ = Buffer<std::uint32_t>(device_, mostPaths_);
  hits_ = Buffer<Hit>(device_, mostPaths_);
  shadowHits_ = Buffer<Hit>(device_, mostPaths_);
  marks_ = Buffer<std::uint8_t>(device_, mostPaths_);
  queue_.emplace(device_, mostPaths_);
  meanBuffer_ = Buffer<glm::vec4>(device_, blockPixels_);
  if (request.parts) partBuffer_ = Buffer<glm::vec4>(device_, tracedParts * blockPixels_);
  if (cached_)
    buildCachedKernels(request);
  else
    buildKernels(request);
  if (scene.features().media) buildWalkKernels(request);
  if (request.integrator == Integrator::Instant) virtual_.emplace(scene, compiled, request);
  if (cached_ || !CausticPasses::areNeeded(scene, compiled, request)) return;
  caustics_.emplace(scene, compiled, request, std::uint64_t{pixels} * samples);
  if (caustics_->any())
    buildCausticKernels(request);
  else
    caustics_.reset();
}

void PathTracer::buildCausticKernels(const ReferenceRequest& request) {
  const char* file = "integrate/caustic_path_kernels.cl";
  BuildOptions options = buildOptions(request, std::nullopt, scene_.options());
  DensityEstimator::addOptions(options, {});
  addPhotons_ = {device_, file, options, "addPhotonLight"};
  averageBlurs_ = {device_, file, options, "averageBlurs"};
  blurs_ = Buffer<float>(device_, mostPaths_);
}

/// Prepares data of a pass besides the scene: virtual lights and caustics.
void PathTracer::preparePass(std::uint64_t pass) {
  if (preparedPass_ == pass) return;
  if (virtual_) virtual_->make(pass);
  if (caustics_) caustics_->make(pass);
  preparedPass_ = pass;
}

void PathTracer::buildKernels(const ReferenceRequest& request) {
  const char* file = "integrate/path_kernels.cl";
  BuildOptions options = buildOptions(request, std::nullopt, scene_.options());
  if (choosesLights(scene_) && request.integrator == Integrator::Path)
    options.define("PRELIGHT_LIGHT_CANDIDATES", lightCandidates);
  generate_ = {device_, file, options, "generatePaths"};
  collect_ = {device_, file, options, "collectRadiance"};
  sample_ = {device_, file, options, "sampleLights"};
  if (request.integrator == Integrator::Instant)
    sampleVirtual_ = {device_, "integrate/virtual_kernels.cl", options, "sampleVirtualLight"};
  add_ = {device_, file, options, "addArrivals"};
  scatter_ = {device_, file, options, "scatterPaths"};
  average_ = {device_, file, options, "averageSamples"};
  if (scene_.features().culled) culled_.emplace(scene_, file, options, mostPaths_);
  if (request.parts) averageParts_ = {device_, file, options, "averageParts"};
}

void PathTracer::buildCachedKernels(const ReferenceRequest& request) {
  const char* file = "integrate/cached_path_kernels.cl";
  BuildOptions options =
      cachedLightOptions(*cached_, buildOptions(request, cached_->meetsLights, scene_.options()));
  if (choosesLights(scene_)) options.define("PRELIGHT_LIGHT_CANDIDATES", lightCandidates);
  generate_ = {device_, file, options, "generatePaths"};
  follow_ = {device_, file, options, "followPaths"};
  add_ = {device_, file, options, "addArrivals"};
  average_ = {device_, file, options, "averageSamples"};
  measureExcess_ = {device_, file, options, "measureExcess"};
  excessBuffer_ = Buffer<float>(device_, blockPixels_);
  if (scene_.features().culled) culled_.emplace(scene_, file, options, mostPaths_);
  if (request.parts) averageParts_ = {device_, file, options, "averageParts"};
  setCachedLight(*cached_, values_.samplesPerPass, cachedValues_);
  cachedParameters_ = Buffer<CachedPathParameters>(device_, 1);
  cachedCaustics_ =
      cached_->caustics != nullptr ? cached_->caustics->estimator.lines() : Buffer<DensityLine>(device_, 0);
}

void PathTracer::buildWalkKernels(const ReferenceRequest& request) {
  const char* file = "integrate/walk_kernels.cl";
  const BuildOptions options = buildOptions(request, std::nullopt, scene_.options());
  beginWalks_ = {device_, file, options, "beginWalks"};
  endWalks_ = {device_, file, options, "endWalks"};
  walker_.emplace(device_, options, mostPaths_);
}

const std::vector<glm::vec4>& PathTracer::trace(std::uint64_t pass, std::uint32_t first,
                                                std::uint32_t count) {
  preparePass(pass);
  values_.pass = static_cast<std::uint32_t>(pass);
  values_.firstPixel = first;
  values_.pathCount = count * values_.samplesPerPass;
  parameters_.write(std::span<const ReferenceParameters>(&values_, 1));
  if (cached_) {
    cachedValues_.paths = values_;
    cachedParameters_.write(std::span<const CachedPathParameters>(&cachedValues_, 1));
  }
  std::uint32_t active = values_.pathCount;
  generate_.launch(active, parameters_, paths_, numbers_, rayBuffer_);
  if (caustics_) blurs_.fill(0.0f);
  for (std::uint32_t depth = 0; active > 0; ++depth) tracePaths(depth, active);
  average_.launch(count, parameters_, paths_, meanBuffer_);
  if (caustics_) averageBlurs_.launch(count, parameters_, blurs_, meanBuffer_);
  means_.resize(count);
  meanBuffer_.read(std::span(means_));
  if (cached_) {
    measureExcess_.launch(count, parameters_, paths_, excessBuffer_);
    excess_.resize(count);
    excessBuffer_.read(std::span(excess_));
  }
  if (!request_.parts) return means_;
  averageParts_.launch(tracedParts * count, parameters_, paths_, partBuffer_);
  partMeans_.resize(tracedParts * count);
  partBuffer_.read(std::span(partMeans_));
  return means_;
}

PathStep PathTracer::step(std::uint32_t count, std::uint32_t depth) const {
  PathStep step{};
  step.count = count;
  step.depth = depth;
  step.next = sentOn * mostPaths_;
  step.shadow = sentToLights * mostPaths_;
  step.light = PRELIGHT_NO_TRIANGLE;
  return step;
}

/// Processes one vertex of all remaining paths. `count` becomes the number of paths that continue.
void PathTracer::tracePaths(std::uint32_t depth, std::uint32_t& count) {
  scene_.tracer().traceClosest(rayBuffer_, hits_, count, followed * mostPaths_);
  rays_ += count;
  if (culled_) lookThroughBacks(count, depth);
  if (walker_) walkMedia(count, depth);
  if (cached_) {
    count = followToCachedLight(count, depth);
    return;
  }
  collect(count, depth);
  if (isLast(depth) || !scene_.features().scatters) {
    count = 0;
    return;
  }
  if (caustics_) addPhotons(count, depth);
  if (scene_.features().panes || depth + 2 >= static_cast<std::uint32_t>(request_.leastDepth))
    addLights(count, depth);
  count = scatter(count, depth);
}

/// Returns whether no path has a segment after its vertex of this number. Panes do not count as vertices, so
/// that in their presence the kernels decide.
bool PathTracer::isLast(std::uint32_t depth) const {
  return !scene_.features().panes && depth + 1 >= static_cast<std::uint32_t>(request_.depth);
}

void PathTracer::addLights(std::uint32_t count, std::uint32_t depth) {
  if (request_.integrator == Integrator::Whitted)
    for (std::uint32_t light = 0; light < scene_.lights().punctual.size(); ++light)
      addDirectLight(count, depth, light);
  if (scene_.lights().groupCount > 0) addDirectLight(count, depth, PRELIGHT_NO_TRIANGLE);
  if (virtual_) addVirtualLights(count, depth);
}

/// Makes the continuing rays the followed ones.
std::uint32_t PathTracer::follow(std::uint32_t left) {
  queue_->move(PRELIGHT_PATH_NEXT, left,
               QueuedItems<Ray>{rayBuffer_, sentOn * mostPaths_, rayBuffer_, followed * mostPaths_},
               QueuedItems<std::uint32_t>{numbers_, 0, nextNumbers_});
  std::swap(numbers_, nextNumbers_);
  return left;
}

/// Processes a vertex in one launch. Returns how many paths continue.
std::uint32_t PathTracer::followToCachedLight(std::uint32_t count, std::uint32_t depth) {
  PathStep now = step(count, depth);
  now.meets = isLast(depth) || !scene_.features().scatters ? 0 : 1;
  now.goesOn = cached_->meetsLights || scene_.features().specularLobes() ? 1 : 0;
  const DeviceScene& scene = scene_.handle();
  follow_.launch(count, cachedParameters_, now, scene.surface(), scene.shading(), scene.lights(),
                 cached_->indirect->lines(), cachedCaustics_, rayBuffer_, hits_, numbers_, paths_, marks_);
  const auto listed = queue_->list(marks_, count);
  castShadows(listed[PRELIGHT_PATH_SHADOW]);
  return follow(listed[PRELIGHT_PATH_NEXT]);
}

/// Beyond the first surface, only rays that met mirrors and glass are still camera rays.
void PathTracer::lookThroughBacks(std::uint32_t count, std::uint32_t depth) {
  if (depth > 0 && !scene_.features().specularLobes()) return;
  culled_->lookThrough({parameters_, count, rayBuffer_, hits_, numbers_, paths_}, marks_, *queue_);
}

/// Replaces rays into scattering media by those that leave them: a walk counts as no segment of a path.
void PathTracer::walkMedia(std::uint32_t count, std::uint32_t depth) {
  const DeviceScene& scene = scene_.handle();
  beginWalks_.launch(count, parameters_, step(count, depth), scene.surface(), scene.shading(), rayBuffer_,
                     hits_, numbers_, paths_, walker_->walks(), marks_);
  walker_->run(scene, scene_.tracer(), rayBuffer_, hits_, marks_, count);
  endWalks_.launch(count, count, walker_->walks(), numbers_, paths_);
}

void PathTracer::collect(std::uint32_t count, std::uint32_t depth) {
  const DeviceScene& scene = scene_.handle();
  collect_.launch(count, parameters_, step(count, depth), scene.surface(), scene.shading(), scene.lights(),
                  rayBuffer_, hits_, numbers_, paths_);
}

void PathTracer::addPhotons(std::uint32_t count, std::uint32_t depth) {
  const DeviceScene& scene = scene_.handle();
  addPhotons_.launch(count, parameters_, step(count, depth), scene.surface(), scene.shading(),
                     caustics_->parameters(), caustics_->lines(), caustics_->radius(), rayBuffer_, hits_,
                     numbers_, paths_, blurs_);
}

void PathTracer::addDirectLight(std::uint32_t count, std::uint32_t depth, std::uint32_t light) {
  PathStep now = step(count, depth);
  now.light = light;
  const DeviceScene& scene = scene_.handle();
  sample_.launch(count, parameters_, now, scene.surface(), scene.shading(), scene.lights(), rayBuffer_, hits_,
                 numbers_, paths_, marks_);
  castShadows(queue_->list(marks_, count)[PRELIGHT_PATH_SHADOW]);
}

/// Adds the light of all virtual lights, one after another.
void PathTracer::addVirtualLights(std::uint32_t count, std::uint32_t depth) {
  const DeviceScene& scene = scene_.handle();
  PathStep now = step(count, depth);
  now.leastSquare = virtual_->leastSquare();
  for (now.light = 0; now.light < virtual_->count(); ++now.light) {
    sampleVirtual_.launch(count, parameters_, now, scene.surface(), scene.shading(), rayBuffer_, hits_,
                          numbers_, paths_, virtual_->lights(), marks_);
    castShadows(queue_->list(marks_, count)[PRELIGHT_PATH_SHADOW]);
  }
}

/// Adds the light of `shadows` listed shadow rays.
void PathTracer::castShadows(std::uint32_t shadows) {
  if (shadows == 0) return;
  // Shadow rays have separate hits, because those of the paths' rays are needed again.
  const std::uint32_t part = RayPart::shadowRays * mostPaths_;
  queue_->move(PRELIGHT_PATH_SHADOW, shadows,
               QueuedItems<Ray>{rayBuffer_, sentToLights * mostPaths_, rayBuffer_, part});
  scene_.tracer().traceShadows(rayBuffer_, shadowHits_, shadows, part);
  rays_ += shadows;
  add_.launch(shadows, shadows, queue_->first(PRELIGHT_PATH_SHADOW), queue_->lists(), shadowHits_, numbers_,
              paths_, values_.parts);
}

std::uint32_t PathTracer::scatter(std::uint32_t count, std::uint32_t depth) {
  const DeviceScene& scene = scene_.handle();
  scatter_.launch(count, parameters_, step(count, depth), scene.surface(), scene.shading(), rayBuffer_, hits_,
                  numbers_, paths_, marks_);
  return follow(queue_->list(marks_, count)[PRELIGHT_PATH_NEXT]);
}

}  // namespace prelight::reference
