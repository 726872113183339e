#include "cast/light_column.h"

#include <algorithm>

#include "base/spans.h"
#include "basis/incident_values.h"
#include "cast/caster.h"
#include "device/buffer.h"
#include "receivers/surface_sampler.h"

namespace prelight {

namespace {

using namespace device;

/// Emitters that a set leaves out are black for its receivers.
std::vector<GroupEmitter> emittersOf(const GroupedLights& lights, const ShadowSets::Occluders& set) {
  std::vector<GroupEmitter> emitters = lights.emitters;
  for (std::size_t e = 0; e < emitters.size(); ++e)
    if (!std::binary_search(set.triangles.begin(), set.triangles.end(), lights.tables.emitters[e]))
      for (float& factor : emitters[e].factor) factor = 0.0f;
  return emitters;
}

}  // namespace

std::size_t lightValuesOfGroup(int incidentOrder) {
  return incidentOrder > 0 ? static_cast<std::size_t>(incidentValueCount(incidentOrder)) : 1;
}

std::uint64_t lightBytesPerReceiver(std::uint64_t rays, std::uint64_t groups, std::uint64_t values) {
  return rays * (sizeof(Ray) + sizeof(Hit) + 3 * sizeof(float)) + 2 * groups * 3 * values * sizeof(float);
}

std::uint64_t lightBlockBytesOf(std::uint64_t rays, std::uint64_t groups, std::uint64_t values,
                                std::uint64_t most) {
  return std::min(lightBlockBytes(DeviceKind::Cpu), most * lightBytesPerReceiver(rays, groups, values));
}

std::uint32_t receiversPerLightBlock(DeviceKind kind, const GroupedLights& lights, int incidentOrder,
                                     std::uint32_t most) {
  const std::uint64_t each =
      lightBytesPerReceiver(lights.rays.size(), lights.groups.size(), lightValuesOfGroup(incidentOrder));
  return static_cast<std::uint32_t>(
      std::clamp<std::uint64_t>(lightBlockBytes(kind) / std::max<std::uint64_t>(1, each), 1, most));
}

LightCaster::LightCaster(const CompiledScene& scene, const GroupedLights& lights, const ShadowSets* sets,
                         const Tracer& tracer, std::uint32_t blockSize, int incidentOrder)
    : device_(tracer.context()),
      valueCount_(static_cast<std::uint32_t>(lightValuesOfGroup(incidentOrder))),
      hasEmitters_(!lights.emitters.empty()),
      lit_(tracer.context()) {
  PackedArrays<LightGroupLine> pack;
  layout_.groupCount = static_cast<std::uint32_t>(lights.groups.size());
  layout_.rayCount = static_cast<std::uint32_t>(lights.rays.size());
  layout_.rays = pack.add(spanOf(lights.rays));
  layout_.emitterOfTriangle = pack.add(spanOf(lights.emitterOfTriangle));
  layout_.samplesOfGroup = pack.add(spanOf(lights.samplesOfGroup));
  emittersOfSet_.push_back(pack.add(spanOf(lights.emitters)));
  if (sets != nullptr)
    for (const auto& set : sets->sets) emittersOfSet_.push_back(pack.add(emittersOf(lights, set)));
  lines_ = pack.upload(device_);
  lit_.shareSurface(tracer.scene());
  if (hasEmitters_) lit_.setPlainShading(scene);
  lit_.setLights(lights.tables, 0.0);
  const std::size_t rays = std::size_t{blockSize} * layout_.rayCount;
  rays_ = Buffer<Ray>(device_, rays);
  hits_ = Buffer<Hit>(device_, rays);
  rayValues_ = Buffer<float>(device_, (tracer.dimsShadows() ? 4 : 3) * rays);
  values_ = Buffer<float>(device_, std::size_t{blockSize} * layout_.groupCount * 3 * valueCount_);
  auto options = tracer.surfaceOptions()
                     .defineIf(!lights.tables.punctual.empty(), "PRELIGHT_PUNCTUAL")
                     .defineIf(!lights.tables.profiles.empty(), "PRELIGHT_PROFILES")
                     .defineIf(hasEmitters_, "PRELIGHT_EMITTERS")
                     .defineIf(!lights.tables.emitterRoots.empty(), "PRELIGHT_EMITTER_PARTS")
                     .defineIf(incidentOrder > 0, "PRELIGHT_INCIDENT");
  addIncidentOrder(options, incidentOrder);
  generate_ = {device_, "cast/light_kernels.cl", options, "generateLightRays"};
  sum_ = {device_, "cast/light_kernels.cl", options, "sumLightRays"};
  if (hasEmitters_) addHits_ = {device_, "cast/light_kernels.cl", options, "addEmitterHits"};
}

const Buffer<float>& LightCaster::cast(const CastBlockBuffers& block, std::uint32_t receivers, Tracer& tracer,
                                       std::uint32_t set) {
  const std::size_t rayCount = std::size_t{receivers} * layout_.rayCount;
  layout_.emitters = emittersOfSet_[set];
  lit_.shareSurface(tracer.scene());
  generate_.launch(rayCount, block.parameters, layout_, lines_, lit_.layoutBuffer(), lit_.surface(),
                   lit_.shading(), lit_.lights(), block.receivers, rays_, rayValues_);
  tracer.traceShadows(rays_, hits_, rayCount);
  sum_.launch(receivers, block.parameters, layout_, lines_, block.receivers, rays_, hits_, rayValues_,
              values_);
  if (hasEmitters_)
    addHits_.launch(receivers, block.parameters, layout_, lines_, lit_.layoutBuffer(), lit_.surface(),
                    lit_.shading(), lit_.lights(), block.receivers, block.rays, block.hits, values_);
  return values_;
}

void LightCaster::cast(const CastBlockBuffers& block, std::uint32_t receivers, Tracer& tracer,
                       std::uint32_t set, std::vector<float>& values) {
  (void)cast(block, receivers, tracer, set);
  values.resize(std::size_t{receivers} * layout_.groupCount * 3 * valueCount_);
  values_.read(std::span(values));
}

namespace {

constexpr std::uint32_t leastRays = 8;  // that a receiver counts as when blocks are sized

}  // namespace

PointLightCaster::PointLightCaster(const CompiledScene& scene, const GroupedLights& lights, Tracer& tracer,
                                   int incidentOrder)
    : tracer_(tracer),
      vertexCount_(scene.vertexCount()),
      blockSize_(receiversPerBlock(tracer.context().info(),
                                   std::max(leastRays, static_cast<std::uint32_t>(lights.rays.size())))),
      lights_(scene, lights, nullptr, tracer, blockSize_, incidentOrder),
      parameters_(tracer.context(), 1),
      receivers_(tracer.context(), blockSize_) {}

void PointLightCaster::cast(std::span<const device::Receiver> receivers, std::vector<float>& values) {
  values.clear();
  for (std::size_t first = 0; first < receivers.size(); first += blockSize_) {
    const auto block = receivers.subspan(first, std::min<std::size_t>(blockSize_, receivers.size() - first));
    const auto count = static_cast<std::uint32_t>(block.size());
    const device::CastParameters parameters{count, leastRays, 0, vertexCount_, 0, 0.0f, 0.0f, 0.0f};
    parameters_.write(std::span(&parameters, 1));
    receivers_.write(block);
    lights_.cast({parameters_, receivers_, noRays_, noHits_}, count, tracer_, 0, block_);
    values.insert(values.end(), block_.begin(), block_.end());
    rays_ += std::uint64_t{count} * lights_.raysPerReceiver();
  }
}

LightColumn::LightColumn(const GroupedLights& lights, int incidentOrder)
    : FittedColumn(3 * lights.groups.size() * lightValuesOfGroup(incidentOrder),
                   3 * lights.groups.size() * lightValuesOfGroup(incidentOrder)),
      lights_(lights),
      incidentOrder_(incidentOrder) {}

std::uint32_t LightColumn::groups() const { return static_cast<std::uint32_t>(lights_.groups.size()); }

ColumnNeeds LightColumn::needs() const { return {.closestHits = !lights_.emitters.empty(), .ownRays = true}; }

std::uint32_t LightColumn::receiversAtOnce(DeviceKind kind, std::uint32_t usual) const {
  return receiversPerLightBlock(kind, lights_, incidentOrder_, usual);
}

void LightColumn::allocate(const CastShape& shape) {
  caster_.emplace(shape.scene, lights_, shape.sets, shape.tracer, shape.blockSize, incidentOrder_);
}

void LightColumn::finish(const CastBlock& block, ColumnRows& rows) {
  ColumnRows::read(caster_->cast(block.buffers, block.receivers, block.tracer, block.task.set), 0,
                   block.receivers * rowWidth(), rows.rows);
}

}  // namespace prelight
