#include "gi/update/live_light.h"

#include <algorithm>

#include "base/clocks.h"
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

}  // namespace

LiveLight::LiveLight(const Scene& scene, CompiledScene compiled, const Environment* sky, double skyRotation,
                     const LiveLightOptions& options, std::span<const int> movable, const Device& device,
                     Progress& progress)
    : scene_(scene, std::move(compiled)),
      options_(options),
      device_(device),
      layout_(layoutOf(scene, scene_.compiled(), options.texels)),
      regions_(splitByPrimitive(makeSurfaceRegions(scene_.compiled(), usualCreaseAngle), scene_.compiled())),
      transport_({scene_.compiled(), scene.images, scene_.compiled().lights, sky, skyRotation}, device),
      skyRotation_(skyRotation) {
  const std::vector<std::uint32_t> triangles = trianglesThatMove(scene, scene_, movable);
  moving_.add(scene_.compiled(), transport_, triangles);
  std::vector<std::uint8_t> moves(scene_.compiled().triangleCount(), 0);
  for (const std::uint32_t t : triangles) moves[t] = 1;
  findWalls(scene_.compiled(), transport_.tracer(), layout_, moves);
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
  options_.eye = eye;
  if (photons_) photons_->look(eye - scene_.compiled().origin);
}

SceneChange LiveLight::takeChanges() {
  SceneChange change = scene_.takeChanges();
  change.sky = std::exchange(skyTurned_, false);
  return change;
}

void LiveLight::makeLight(Progress& progress) {
  plan_ = planGlobalIllumination(scene_.compiled(), transport_);
  gather_.reset();  // it refers to the approximation
  approximation_.reset();
  photons_.reset();
  caustics_.reset();
  if (runs(plan_, Pass::IndirectLight)) {
    LivePhotonOptions photons;
    photons.request = indirectPhotons(
        transport_, {.photons = options_.photons, .seed = options_.seed, .directByPhotons = true});
    photons.groupSize = options_.groupSize;
    photons.detection = options_.detection;
    photons.photonsPerFrame = options_.photonsPerFrame;
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
    gather_->gatherAll(progress);
  }
  if (runs(plan_, Pass::CausticPhotons)) {
    LivePhotonOptions caustics;
    caustics.request = causticRequest(options_.causticPhotons, options_.seed + 1);
    caustics.groupSize = 0;
    caustics.frames = std::max(1u, options_.causticFrames);
    caustics_ = std::make_unique<LivePhotons>(scene_, transport_, caustics, progress);
  }
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
  if (approximation_ && !change.triangles.empty()) approximation_->follow(change.triangles);
  return false;
}

LiveFrame LiveLight::advance(Progress& progress) {
  LiveFrame frame;
  StageClock stages(frame.stageSeconds);
  const SceneChange change = takeChanges();
  if (follow(change)) {
    makeLight(progress);
    frame.shownChanged = frame.causticsChanged = true;
    stages.mark("everything anew");
    return frame;
  }
  if (gather_ && !change.triangles.empty())
    gather_->moved(change.triangles, approximation_->meanIrradiance(), progress);
  stages.mark("scene");
  if (photons_) {
    PhotonDelta delta;
    frame.photons = photons_->advance(delta, progress);
    if (!delta.removed.empty() || !delta.added.empty()) approximation_->photonsChanged(delta);
    stages.mark("photons");
    if (!approximation_->settled()) {
      const ApproximationFrame estimated =
          approximation_->advance(photons_->photons(), options_.estimatesPerFrame);
      frame.surfaces = estimated.surfaces;
      frame.estimates = estimated.texels;
      gather_->approximationChanged(estimated.changes);
    }
    stages.mark("density");
    frame.gather = gather_->advance(progress);
    frame.shownChanged = frame.gather.texels > 0 || frame.gather.blending > 0;
    stages.mark("gather");
  }
  if (caustics_) {
    PhotonDelta delta;
    frame.caustics = caustics_->advance(delta, progress);
    frame.causticsChanged = !delta.removed.empty() || !delta.added.empty();
    stages.mark("caustics");
  }
  return frame;
}

bool LiveLight::settled() const {
  return (!photons_ || (photons_->settled() && approximation_->settled() && gather_->settled())) &&
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
