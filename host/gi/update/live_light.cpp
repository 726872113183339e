#include "gi/update/live_light.h"

#include <algorithm>

#include "base/clocks.h"
#include "charts/irradiance/hollows.h"
#include "charts/make_light_map_layout.h"
#include "charts/wall_search.h"
#include "scene/pose.h"

namespace prelight {

namespace {

LightMapLayout layoutOf(const Scene& scene, const CompiledScene& compiled, std::uint32_t texels) {
  LightMapLayoutRequest request;
  request.texels = texels;
  request.wideMetals = true;
  return makeLightMapLayout(scene, compiled, request);
}

/// Returns the triangles of movable nodes and of nodes that an animation moves, ascending.
std::vector<std::uint32_t> trianglesThatMove(const Scene& scene, const LiveScene& live,
                                             std::span<const int> movable) {
  std::vector<int> nodes(movable.begin(), movable.end());
  for (const Animation& animation : scene.animations) {
    const std::vector<bool> moved = movedMeshNodes(scene, animation);
    for (std::size_t i = 0; i < moved.size(); ++i)
      if (moved[i]) nodes.push_back(scene.meshNodes[i].node);
  }
  std::vector<std::uint32_t> triangles;
  for (const int node : nodes) {
    const std::vector<std::uint32_t> own = live.trianglesOf(node);
    triangles.insert(triangles.end(), own.begin(), own.end());
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

/// The coarse light has this share of the photons and of the rays per texel.
constexpr std::uint64_t coarsePhotons = 16;
constexpr std::uint32_t coarseRays = 64;

/// Returns whether a coarse light is kept. It needs to know what changes, as probes for changes do not.
bool hasCoarseLight(const LiveLightOptions& options) {
  return options.coarser > 0 && options.detection == ChangeDetection::Flights;
}

/// Returns the smaller of two numbers of items, of which 0 is no limit for the first.
std::uint32_t limited(std::uint32_t perFrame, std::uint32_t affordable) {
  return perFrame == 0 ? affordable : std::min(perFrame, affordable);
}

}  // namespace

LiveLightOptions optionsOfWindows() {
  LiveLightOptions options;
  options.frameSeconds = 1.0 / 30.0;
  options.coarser = 4;
  options.gather.texelsPerFrame = 0;
  options.gather.blendFrames = 4;
  return options;
}

LiveLight::LiveLight(const Scene& scene, CompiledScene compiled, const Environment* sky, double skyRotation,
                     const LiveLightOptions& options, std::span<const int> movable, const Device& device,
                     Progress& progress)
    : scene_(scene, std::move(compiled)),
      options_(options),
      device_(device),
      layout_(layoutOf(scene, scene_.compiled(), options.texels)),
      budget_(options.frameSeconds, options.clock),
      regions_(splitByPrimitive(makeSurfaceRegions(scene_.compiled(), usualCreaseAngle), scene_.compiled())),
      transport_({scene_.compiled(), scene.images, scene_.compiled().lights, sky, skyRotation}, device),
      skyRotation_(skyRotation) {
  const std::vector<std::uint32_t> triangles = trianglesThatMove(scene, scene_, movable);
  moving_.add(scene_.compiled(), transport_, triangles);
  std::vector<std::uint8_t> moves(scene_.compiled().triangleCount(), 0);
  for (const std::uint32_t t : triangles) moves[t] = 1;
  leaveHollows(scene_.compiled(), transport_.tracer(), layout_, moves);
  findWalls(scene_.compiled(), transport_.tracer(), layout_, moves);
  if (hasCoarseLight(options)) {
    coarseLayout_ = layoutOf(scene, scene_.compiled(),
                             std::max(1u, options.texels / (options.coarser * options.coarser)));
    leaveHollows(scene_.compiled(), transport_.tracer(), coarseLayout_, moves);
    findWalls(scene_.compiled(), transport_.tracer(), coarseLayout_, moves);
  }
  makeLight(progress);
}

LiveLight::~LiveLight() = default;

void LiveLight::moveNode(int node, const RigidMotion& motion) { scene_.moveNode(node, motion); }
void LiveLight::pose(const CompiledScene& posed) { scene_.pose(posed); }
void LiveLight::setLight(std::size_t index, const Light& light) { scene_.setLight(index, light); }

void LiveLight::setSkyRotation(double angle) {
  transport_.setSkyRotation(angle);
  skyRotation_ = angle;
  skyTurned_ = true;
}

void LiveLight::setEye(const glm::dvec3& eye) {
  if (options_.eye == eye) return;
  options_.eye = eye;
  if (photons_) photons_->look(eye - scene_.compiled().origin);
  if (gather_) gather_->look(eye - scene_.compiled().origin);
}

SceneChange LiveLight::takeChanges() {
  SceneChange change = scene_.takeChanges();
  change.sky = std::exchange(skyTurned_, false);
  return change;
}

void LiveLight::makeIndirect(Progress& progress) {
  LivePhotonOptions photons;
  photons.request = indirectPhotons(
      transport_, {.photons = options_.photons, .seed = options_.seed, .directByPhotons = true});
  photons.groupSize = options_.groupSize;
  photons.detection = options_.detection;
  photons.thinning.beyond = options_.thinBeyond;
  if (options_.eye) photons.thinning.eye = *options_.eye - scene_.compiled().origin;
  photons_ = std::make_unique<LivePhotons>(scene_, transport_, photons, progress);
  approximation_ = std::make_unique<LiveApproximation>(scene_.compiled(), transport_.tracer(), layout_,
                                                       regions_, options_.nearestPhotons, device_);
  const std::vector<device::Photon> all = photons_->photons();
  approximation_->photonsChanged({.removed = {}, .added = all});
  approximation_->advance(all, 0);
  LiveGatherOptions gather = options_.gather;
  gather.seed = options_.seed;
  gather_ = std::make_unique<LiveGather>(scene_.compiled(), transport_, layout_, regions_,
                                         approximation_->map(), gather);
  if (options_.eye) gather_->look(*options_.eye - scene_.compiled().origin);
  if (hasCoarseLight(options_)) {
    CoarseLightOptions coarse;
    coarse.photons.request = photons.request;
    coarse.photons.request.photons = std::max<std::uint64_t>(1, options_.photons / coarsePhotons);
    coarse.photons.groupSize = 0;
    coarse.rays = std::min(coarseRays, gather.rays);
    coarse.fineRays = std::min(gather.rays, GatherRequest::mostRaysPerReceiver);
    coarse.seed = options_.seed;
    coarse_ = std::make_unique<CoarseLight>(scene_, transport_, coarseLayout_, layout_, regions_,
                                            approximation_->map(), coarse, device_, progress);
    gather_->coarseChanged(coarse_->light());
  }
  gather_->gatherAll(progress);
}

void LiveLight::makeLight(Progress& progress) {
  plan_ = planGlobalIllumination(scene_.compiled(), transport_);
  coarse_.reset();  // it refers to the approximation, as the gathering does
  gather_.reset();
  approximation_.reset();
  photons_.reset();
  caustics_.reset();
  if (runs(plan_, Pass::IndirectLight)) makeIndirect(progress);
  if (!runs(plan_, Pass::CausticPhotons)) return;
  LivePhotonOptions caustics;
  caustics.request = causticRequest(options_.causticPhotons, options_.seed + 1);
  caustics.groupSize = 0;
  caustics.frames = std::max(1u, options_.causticFrames);
  caustics_ = std::make_unique<LivePhotons>(scene_, transport_, caustics, progress);
}

void LiveLight::recompute(Progress& progress) {
  follow(takeChanges());
  makeLight(progress);
}

/// Updates all parts that know positions, and lets them look for changes. Returns true if stored light must
/// be discarded, because lights of a kind that the programs were not built for are on now.
bool LiveLight::follow(const SceneChange& change) {
  if (change.empty()) return false;
  if (followChange(change, scene_, moving_, transport_)) return true;
  if (photons_) photons_->changed(change);
  if (caustics_) caustics_->changed(change);
  if (coarse_) coarse_->changed(change);
  if (approximation_ && !change.triangles.empty()) approximation_->follow(change.triangles);
  return false;
}

LiveFrame LiveLight::advance(Progress& progress) {
  LiveFrame frame;
  StageClock stages(frame.stageSeconds);
  budget_.begin();
  const SceneChange change = takeChanges();
  if (follow(change)) {
    makeLight(progress);
    frame.shownChanged = frame.causticsChanged = true;
    stages.mark("everything anew");
    return frame;
  }
  if (gather_ && !change.triangles.empty())
    gather_->moved(change.triangles, approximation_->meanIrradiance(), progress);
  budget_.spend();
  stages.mark("scene");
  if (caustics_) {
    advanceCaustics(frame, progress);
    stages.mark("caustics");
  }
  if (!photons_) return frame;
  if (coarse_) advanceCoarse(frame, stages, progress);
  // Fine light would be of the past before it is done.
  if (!coarse_ || change.empty())
    advanceFine(frame, stages, progress);
  else
    frame.gather = gather_->advance(0, progress);
  frame.shownChanged = frame.coarseRays > 0 || frame.gather.texels > 0 || frame.gather.blending > 0;
  stages.mark("gather");
  return frame;
}

void LiveLight::advanceCaustics(LiveFrame& frame, Progress& progress) {
  PhotonDelta delta;
  frame.caustics = caustics_->advance(delta, progress);
  frame.causticsChanged = !delta.removed.empty() || !delta.added.empty();
  budget_.spend(FrameWork::Photons, frame.caustics.traced);
}

void LiveLight::advanceCoarse(LiveFrame& frame, StageClock& stages, Progress& progress) {
  const std::uint64_t rays = coarse_->advance(progress);
  if (rays == 0) return;
  gather_->coarseChanged(coarse_->light());
  frame.coarseRays += rays;
  budget_.spend(FrameWork::Rays, rays);
  stages.mark("coarse light");
}

/// Sends photons again, then estimates texels, then gathers. With a coarse light, which shows what changes
/// until then, a stage waits for the one before.
void LiveLight::advanceFine(LiveFrame& frame, StageClock& stages, Progress& progress) {
  advancePhotons(frame, progress);
  stages.mark("photons");
  if (coarse_ && !photons_->settled()) {
    frame.gather = gather_->advance(0, progress);
    return;
  }
  advanceEstimates(frame);
  stages.mark("density");
  std::uint32_t texels = 0;
  if (!coarse_ || approximation_->settled()) {
    if (coarse_ && !coarse_->settled()) {
      const std::uint64_t rays = coarse_->refine(progress);
      gather_->coarseChanged(coarse_->light());
      frame.coarseRays += rays;
      budget_.spend(FrameWork::Rays, rays);
      stages.mark("coarse light");
    }
    texels =
        limited(options_.gather.texelsPerFrame, budget_.affordable(FrameWork::Rays) / gather_->raysOfTexel());
  }
  frame.gather = gather_->advance(texels, progress);
  budget_.spend(FrameWork::Rays, frame.gather.rays);
}

void LiveLight::advancePhotons(LiveFrame& frame, Progress& progress) {
  photons_->limit(limited(options_.photonsPerFrame, budget_.affordable(FrameWork::Photons)));
  PhotonDelta delta;
  frame.photons = photons_->advance(delta, progress);
  if (!delta.removed.empty() || !delta.added.empty()) approximation_->photonsChanged(delta);
  budget_.spend(FrameWork::Photons, frame.photons.traced);
}

void LiveLight::advanceEstimates(LiveFrame& frame) {
  if (approximation_->settled()) return;
  const ApproximationFrame estimated = approximation_->advance(
      photons_->photons(), limited(options_.estimatesPerFrame, budget_.affordable(FrameWork::Estimates)));
  frame.surfaces = estimated.surfaces;
  frame.estimates = estimated.texels;
  gather_->approximationChanged(estimated.changes);
  budget_.spend(FrameWork::Estimates, frame.estimates);
}

bool LiveLight::settled() const {
  return (!photons_ || (photons_->settled() && approximation_->settled() && gather_->settled() &&
                        (!coarse_ || coarse_->settled()))) &&
         (!caustics_ || caustics_->settled());
}

std::span<const glm::vec3> LiveLight::indirect() const {
  return gather_ ? gather_->shown() : std::span<const glm::vec3>();
}

std::span<const glm::vec3> LiveLight::approximation() const {
  return approximation_ ? approximation_->irradiance() : std::span<const glm::vec3>();
}

std::vector<double> LiveLight::expectedChanges() const {
  return gather_ ? gather_->expectedChanges() : std::vector<double>();
}

std::vector<device::Photon> LiveLight::caustics() const {
  return caustics_ ? caustics_->photons() : std::vector<device::Photon>();
}

CausticMap causticsOf(const LiveLight& live) {
  const CompiledScene& scene = live.scene().compiled();
  return makeCausticMap(live.caustics(),
                        makeDensitySurface(scene, makeSurfaceRegions(scene, usualCreaseAngle)));
}

void setIrradiance(const LiveLight& live, LightMap& map) {
  setIrradiance(live.indirect(), map);
  fillBlack(map);
}

GlobalIllumination illuminationOf(const LiveLight& live) {
  GlobalIllumination light;
  light.plan = live.plan();
  light.indirect.layout = live.layout();
  light.indirect.values.assign(3 * live.layout().texelCount(), 0.0f);
  if (live.photons() != nullptr) setIrradiance(live, light.indirect);
  light.photons = live.caustics();
  if (light.photons.empty()) return light;
  const CompiledScene& scene = live.scene().compiled();
  light.surface = makeDensitySurface(scene, makeSurfaceRegions(scene, usualCreaseAngle));
  light.caustics = makeCausticMap(light.photons, light.surface);
  return light;
}

}  // namespace prelight
