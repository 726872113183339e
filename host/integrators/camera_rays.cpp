#include "integrators/camera_rays.h"

#include <limits>

#include "scene/camera.h"

namespace prelight::reference {

namespace {

void store(float (&out)[3], const glm::dvec3& v) {
  for (int c = 0; c < 3; ++c) out[c] = static_cast<float>(v[c]);
}

std::uint32_t foldSeed(std::uint64_t seed) {
  return static_cast<std::uint32_t>(seed) ^ (static_cast<std::uint32_t>(seed >> 32) * 0x9e3779b9u);
}

}  // namespace

void setCamera(const Camera& camera, const CompiledScene& scene, int width, int height,
               device::ReferenceParameters& p) {
  const CameraAxes axes = cameraAxes(camera, scene, static_cast<double>(width) / height);
  store(p.eye, axes.eye);
  store(p.right, axes.right);
  store(p.up, axes.up);
  store(p.forward, axes.forward);
  p.perspective = axes.perspective ? 1 : 0;
  p.zNear = static_cast<float>(axes.zNear);
  p.zFar = camera.zFar > 0.0 && camera.zFar < 1e30 ? static_cast<float>(camera.zFar)
                                                   : std::numeric_limits<float>::max();
  p.width = static_cast<std::uint32_t>(width);
  p.height = static_cast<std::uint32_t>(height);
}

void setLens(const Lens& lens, device::ReferenceParameters& p) {
  p.lensRadius = static_cast<float>(0.5 * lens.aperture);
  p.focus = static_cast<float>(lens.focus.value_or(1.0));
}

void setPathParameters(const ReferenceRequest& request, const TransportScene& scene,
                       device::ReferenceParameters& p) {
  p.samplesPerPass = samplesPerPass(request);
  p.seed = foldSeed(request.seed);
  p.rouletteDepth = static_cast<std::uint32_t>(request.rouletteDepth);
  p.mostSegments = static_cast<std::uint32_t>(request.depth);
  p.scene = scene.handle().layout();
}

std::vector<PlannedPass> explainFeatures(const ShadeFeatures& f, const ReferenceRequest& request) {
  const auto pass = [](Pass name, bool runs, const char* why, const char* whyNot) {
    return PlannedPass{name, runs, runs ? why : whyNot};
  };
  const bool deep = request.depth > 1;
  return {pass(Pass::DirectLight, deep && f.scatters && (f.punctual || f.emitters || f.sky),
               "lights are sampled at every vertex",
               !deep        ? "paths of one segment show only lights"
               : f.scatters ? "nothing gives light"
                            : "no surface scatters light"),
          pass(Pass::FurtherVertices, request.depth > 2 && f.scatters,
               "paths go on until they have as many segments as they may",
               f.scatters ? "paths may have no more than two segments" : "no surface scatters light"),
          pass(Pass::VirtualLights, request.integrator == Integrator::Instant && request.depth > 2,
               "they represent diffuse bounces", "paths go on instead"),
          pass(Pass::PunctualLights, f.punctual, "there are some", "there are none"),
          pass(Pass::Emitters, f.emitters, "some triangles emit", "no triangle emits"),
          pass(Pass::Sky, f.sky, "it gives light", "there is none, or it is black"),
          pass(Pass::Mirrors, f.mirror, "some surface reflects without roughness",
               "no surface reflects without roughness"),
          pass(Pass::GlossyLobes, f.glossy, "some surface reflects with roughness",
               "no surface reflects with roughness"),
          pass(Pass::Glass, f.glass, "some material transmits", "no material transmits"),
          pass(Pass::LightThroughSurfaces, f.translucent, "some material transmits light diffusely",
               "no material transmits light diffusely"),
          pass(Pass::Absorption, f.absorption, "some solid glass attenuates", "no solid glass attenuates"),
          pass(Pass::Textures, f.textures, "some material has one", "no material has one")};
}

BuildOptions buildOptions(const ReferenceRequest& request, std::optional<bool> cachedLight,
                          BuildOptions options) {
  const bool whitted = request.integrator == Integrator::Whitted;
  if (cachedLight)
    options.define("PRELIGHT_DIFFUSE_BOUNCES", *cachedLight ? 1 : 0);
  else if (request.integrator != Integrator::Path)
    options.define("PRELIGHT_DIFFUSE_BOUNCES", request.integrator == Integrator::Distributed ? 1 : 0);
  options.defineIf(!request.lens.isPinhole(), "PRELIGHT_LENS");
  if (request.leastDepth > 1) options.define("PRELIGHT_LEAST_DEPTH", request.leastDepth);
  return options.defineIf(whitted, "PRELIGHT_NO_GLOSSY_BOUNCES")
      .defineIf(whitted || request.estimator == Estimator::LightsOnly, "PRELIGHT_LIGHTS_ONLY")
      .defineIf(!whitted && request.estimator == Estimator::ScatterOnly, "PRELIGHT_SCATTER_ONLY");
}

using namespace device;

namespace {

constexpr std::uint32_t kind = 0;  ///< kind of marks that is used
constexpr int mostBacks = 64;      ///< most successive backs that are skipped; the next one is shown

}  // namespace

CulledBacks::CulledBacks(TransportScene& scene, const char* file, const BuildOptions& options,
                         std::uint32_t most)
    : scene_(scene), most_(most) {
  beyond_.rays = Buffer<Ray>(scene.context(), most);
  list_ = {scene.context(), file, options, "listCulled"};
  keep_ = {scene.context(), file, options, "keepBeyond"};
}

void CulledBacks::lookThrough(const Step& step, Buffer<std::uint8_t>& marks, WorkQueue& queue) {
  const DeviceScene& scene = scene_.handle();
  for (int back = 0; back < mostBacks; ++back) {
    list_.launch(step.count, step.parameters, step.count, scene.surface(), scene.shading(), step.rays,
                 step.hits, step.numbers, step.paths, beyond_.rays, marks);
    const std::uint32_t count = queue.list(marks, step.count)[kind];
    if (count == 0) return;
    if (beyond_.listed.size() == 0) {
      beyond_.listed = Buffer<Ray>(scene_.context(), most_);
      beyond_.hits = Buffer<Hit>(scene_.context(), most_);
    }
    queue.move(kind, count, QueuedItems<Ray>{beyond_.rays, 0, beyond_.listed});
    scene_.tracer().traceClosest(beyond_.listed, beyond_.hits, count, 0);
    rays_ += count;
    keep_.launch(count, count, queue.first(kind), queue.lists(), beyond_.hits, step.hits);
  }
}

}  // namespace prelight::reference
