#include "radiosity/direct_light.h"

#include <algorithm>
#include <utility>

#include "base/kept_work.h"
#include "base/work_share.h"

namespace prelight {

namespace {

using namespace device;

constexpr std::uint32_t emitterSamples = 8;  ///< per point
constexpr std::uint32_t skySamples = 16;
constexpr std::uint32_t raysPerBlock = 1u << 18;

}  // namespace

DirectLight::DirectLight(const CompiledScene& scene, const ElementPoints& points, Tracer& tracer,
                         std::uint32_t pointsPerElement)
    : scene_(scene),
      points_(&points),
      tracer_(tracer),
      device_(tracer.context()),
      pointsPerElement_(pointsPerElement),
      lit_(tracer.scene()) {}

DirectLight::DirectLight(const CompiledScene& scene, Tracer& tracer)
    : scene_(scene), tracer_(tracer), device_(tracer.context()), pointsPerElement_(1), lit_(tracer.scene()) {}

void DirectLight::setLights(const RadiosityLights& lights) {
  const LightTables tables = makeLightTables(scene_, lights.punctual, lights.sky, false);
  lit_.setLights(tables, lights.skyRotation);
  emitters_ = lights.emitters ? tables.emitters.size() : 0;
  if (emitters_ > 0 && lit_.shading().memory() == nullptr) lit_.setPlainShading(scene_);
  const std::uint32_t before = raysOfPoint();
  counts_.punctual = static_cast<std::uint32_t>(tables.punctual.size());
  counts_.emitterSamples = emitters_ == 0 ? 0 : emitterSamples;
  counts_.skySamples = tables.sky.empty() ? 0 : skySamples;
  const auto options =
      tracer_.surfaceOptions()
          .defineIf(counts_.punctual > 0, "PRELIGHT_PUNCTUAL")
          .defineIf(!tables.profiles.empty(), "PRELIGHT_PROFILES")
          .defineIf(counts_.skySamples > 0, "PRELIGHT_SKY")
          .defineIf(emitters_ > 0, "PRELIGHT_EMITTERS")
          .defineIf(emitters_ > 0 && !tables.emitterRoots.empty(), "PRELIGHT_EMITTER_PARTS")
          .defineIf(emitters_ > 0 && !tables.emitterRoots.empty(), "PRELIGHT_MEAN_EMISSION")
          .defineIf(emitters_ > 0 && emitters_ <= mostIntegratedEmitters, "PRELIGHT_FEW_EMITTERS");
  const char* file = "radiosity/direct_kernels.cl";
  aim_ = {device_, file, options, "aimAtLights"};
  sum_ = {device_, file, options, "sumLights"};
  if (raysOfPoint() == before || raysOfPoint() == 0) return;
  blockPoints_ =
      std::max(pointsPerElement_, raysPerBlock / raysOfPoint() / pointsPerElement_ * pointsPerElement_);
  receivers_ = Buffer<Receiver>(device_, blockPoints_);
  irradiance_ = Buffer<PointIrradiance>(device_, blockPoints_);
  rayBuffer_ = Buffer<Ray>(device_, std::size_t{blockPoints_} * raysOfPoint());
  hits_ = Buffer<Hit>(device_, std::size_t{blockPoints_} * raysOfPoint());
  values_ = Buffer<float>(device_, std::size_t{blockPoints_} * raysOfPoint() * 3);
}

bool DirectLight::manyEmitters() const { return emitters_ > mostIntegratedEmitters; }

std::vector<PointIrradiance> DirectLight::estimate(const std::vector<std::uint32_t>& elements,
                                                   Progress& progress) {
  std::vector<PointIrradiance> values(elements.size() * pointsPerElement_,
                                      PointIrradiance{glm::vec4(0.0f), glm::vec4(0.0f)});
  if (raysOfPoint() == 0) return values;
  const std::size_t block = blockPoints_ / pointsPerElement_;
  std::uint64_t first = 0;
  WorkPart part(progress, "direct light", [&](auto& state) {
    state.value(first);
    state.value(rays_);
    state.require(first <= elements.size());
    state.growing(values, first * pointsPerElement_);
    state.requireFinite(numbersOf(values));
  });
  if (part.finished()) return values;
  SharedLoop loop(part, "direct light of elements");
  while (first < elements.size()) {
    progress.check();
    const std::size_t count = std::min<std::size_t>(block, elements.size() - first);
    const std::span<PointIrradiance> own =
        std::span(values).subspan(first * pointsPerElement_, count * pointsPerElement_);
    std::uint64_t rays = 0;
    const auto compute = [&] {
      std::vector<Receiver> receivers;
      for (const ElementPoints::Place& place : points_->of(elements, first, count, pointsPerElement_, 1))
        receivers.push_back(place.receiver);
      const std::uint64_t before = rays_;
      estimateBlock(receivers, own.data());
      rays = std::exchange(rays_, before) - before;
    };
    loop.run({first, count}, compute, [&](auto& state) {
      state.elements(own);
      state.value(rays);
      state.requireFinite(numbersOf(std::span<const PointIrradiance>(own)));
    });
    rays_ += rays;
    first += count;
    part.advance();
    progress.report("direct light", double(first) / double(elements.size()));
  }
  loop.end();
  part.finish();
  return values;
}

std::vector<PointIrradiance> DirectLight::at(std::span<const Receiver> receivers) {
  std::vector<PointIrradiance> values(receivers.size(), PointIrradiance{glm::vec4(0.0f), glm::vec4(0.0f)});
  for (std::size_t first = 0; raysOfPoint() > 0 && first < receivers.size(); first += blockPoints_)
    estimateBlock(receivers.subspan(first, std::min<std::size_t>(blockPoints_, receivers.size() - first)),
                  &values[first]);
  return values;
}

void DirectLight::prepareIncident(int order) {
  const std::size_t values = 3 * static_cast<std::size_t>(incidentValueCount(order)) * blockPoints_;
  if (incident_.size() < values) incident_ = Buffer<float>(device_, values);
  if (incidentOrder_ == order) return;
  BuildOptions options = tracer_.surfaceOptions();
  addIncidentOrder(options, order);
  sumIncident_ = {device_, "radiosity/incident_kernels.cl", options, "sumIncident"};
  incidentOrder_ = order;
}

std::vector<float> DirectLight::incidentAt(std::span<const Receiver> receivers, int order) {
  const std::size_t length = 3 * static_cast<std::size_t>(incidentValueCount(order));
  std::vector<float> values(length * receivers.size(), 0.0f);
  if (raysOfPoint() == 0) return values;
  prepareIncident(order);
  for (std::size_t first = 0; first < receivers.size(); first += blockPoints_) {
    const std::size_t count = std::min<std::size_t>(blockPoints_, receivers.size() - first);
    aimBlock(receivers.subspan(first, count));
    sumIncident_.launch(count, counts_, receivers_, rayBuffer_, hits_, values_, incident_);
    incident_.read(std::span(&values[length * first], length * count));
  }
  return values;
}

void DirectLight::aimBlock(std::span<const Receiver> receivers) {
  receivers_.write(receivers);
  counts_.points = static_cast<std::uint32_t>(receivers.size());
  const std::size_t rayCount = receivers.size() * raysOfPoint();
  aim_.launch(rayCount, counts_, receivers_, lit_.layoutBuffer(), lit_.surface(), lit_.shading(),
              lit_.lights(), rayBuffer_, values_);
  tracer_.traceShadows(rayBuffer_, hits_, rayCount);
  rays_ += rayCount;
}

void DirectLight::estimateBlock(std::span<const Receiver> receivers, PointIrradiance* values) {
  aimBlock(receivers);
  sum_.launch(receivers.size(), counts_, lit_.layoutBuffer(), lit_.surface(), lit_.shading(), lit_.lights(),
              receivers_, hits_, values_, irradiance_);
  irradiance_.read(std::span(values, receivers.size()));
}

}  // namespace prelight
