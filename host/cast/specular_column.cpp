#include "cast/specular_column.h"

#include <algorithm>

#include "basis/sh_evaluate.h"
#include "gpu/transport_scene.h"
#include "scene/lobes.h"

namespace prelight {

namespace {

using namespace device;

constexpr std::uint32_t mostSurfaces = 48;  // on a way; what is caught in glass for longer counts as absorbed

/// [material], where rays go on.
std::vector<std::uint8_t> waysOf(const CompiledScene& scene, const SpecularWays& ways) {
  std::vector<std::uint8_t> marks;
  for (const CompiledMaterial& m : scene.materials)
    marks.push_back(
        static_cast<std::uint8_t>((ways.mirrors && (carriesSpecularly(m) || (ways.glossy && carriesGloss(m)))
                                       ? PRELIGHT_GOES_ON_SPECULARLY
                                       : 0) |
                                  (ways.media && hasInside(m) ? PRELIGHT_GOES_ON_WITHIN : 0)));
  return marks;
}

}  // namespace

SpecularCaster::SpecularCaster(const CompiledScene& scene, const SpecularWays& ways, const Tracer& tracer,
                               std::size_t rays, std::uint32_t raysPerReceiver)
    : raysPerReceiver_(raysPerReceiver),
      mostRays_(static_cast<std::uint32_t>(rays)),
      columns_(static_cast<std::uint32_t>(ways.shOrder * ways.shOrder)),
      scene_(tracer.scene()),
      queue_(tracer.context(), mostRays_),
      specular_(tracer.context(), std::span<const std::uint8_t>(waysOf(scene, ways))),
      marks_(tracer.context(), rays),
      ends_(tracer.context(), rays),
      pathRays_(tracer.context(), 2 * rays),
      pathHits_(tracer.context(), rays),
      paths_(tracer.context(), 2 * rays) {
  DeviceContext& device = tracer.context();
  ways.images != nullptr ? scene_.setShading(scene, *ways.images) : scene_.setPlainShading(scene);
  BuildOptions options = tracer.surfaceOptions();
  defineFeatures(findShadeFeatures(scene, LightTables()), options).define("PRELIGHT_SH_ORDER", ways.shOrder);
  const char* file = "cast/specular_kernels.cl";
  list_ = {device, file, options, "listSpecular"};
  start_ = {device, file, options, "startSpecular"};
  follow_ = {device, file, options, "followSpecular"};
  if (ways.media) {
    beginWalks_ = {device, file, options, "beginSpecularWalks"};
    endWalks_ = {device, file, options, "endSpecularWalks"};
    walker_.emplace(device, options, mostRays_);
  }
  if (columns_ == 0) return;
  project_ = {device, file, options, "projectSpecular"};
  shTable_ = Buffer<float>(device, std::span<const float>(makeShTable(ways.shOrder)));
  values_ = Buffer<float>(device, rays / raysPerReceiver_ * 3 * columns_);
}

void SpecularCaster::cast(const CastBlockBuffers& block, std::uint32_t receivers, Tracer& tracer) {
  std::uint32_t count = receivers * raysPerReceiver_;
  list_.launch(count, count, scene_.layoutBuffer(), scene_.surface(), specular_, block.hits, ends_, marks_);
  count = queue_.list(marks_, count)[0];
  if (count > 0)
    start_.launch(count, count, queue_.first(0), queue_.lists(), block.rays, block.hits, paths_, pathRays_,
                  pathHits_);
  for (std::uint32_t depth = 0; depth < mostSurfaces && count > 0; ++depth) {
    if (depth > 0) {
      tracer.traceClosest(pathRays_, pathHits_, count);
      rays_ += count;
    }
    const SpecularStep step{count, depth, mostRays_};
    if (walker_) walk(block, step, tracer);
    follow_.launch(count, block.parameters, step, scene_.layoutBuffer(), scene_.surface(), scene_.shading(),
                   specular_, block.receivers, paths_, pathRays_, pathHits_, ends_, marks_);
    count = queue_.list(marks_, count)[0];
    queue_.move(0, count, QueuedItems<Ray>{pathRays_, mostRays_, pathRays_},
                QueuedItems<SpecularPath>{paths_, mostRays_, paths_});
  }
}

void SpecularCaster::walk(const CastBlockBuffers& block, const SpecularStep& step, Tracer& tracer) {
  beginWalks_.launch(step.count, block.parameters, step, scene_.layoutBuffer(), scene_.surface(),
                     scene_.shading(), block.receivers, paths_, pathRays_, pathHits_, walker_->walks(),
                     marks_);
  walker_->run(scene_, tracer, pathRays_, pathHits_, marks_, step.count);
  endWalks_.launch(step.count, step.count, walker_->walks(), paths_);
}

const Buffer<float>& SpecularCaster::project(const CastBlockBuffers& block, std::uint32_t receivers) {
  project_.launch(receivers, block.parameters, shTable_, ends_, values_);
  return values_;
}

void SpecularCaster::project(const CastBlockBuffers& block, std::uint32_t receivers,
                             std::vector<float>& values) {
  (void)project(block, receivers);
  values.resize(std::size_t{receivers} * 3 * columns_);
  values_.read(std::span(values));
}

namespace {

std::size_t widthOf(const SpecularWays& ways) {
  return 3 * static_cast<std::size_t>(ways.shOrder * ways.shOrder);
}

}  // namespace

SpecularColumn::SpecularColumn(const SpecularWays& ways)
    : FittedColumn(widthOf(ways), widthOf(ways)), ways_(ways) {}

void SpecularColumn::allocate(const CastShape& shape) {
  caster_.emplace(shape.scene, ways_, shape.tracer, std::size_t{shape.blockSize} * shape.raysPerReceiver,
                  shape.raysPerReceiver);
}

void SpecularColumn::finish(const CastBlock& block, ColumnRows& rows) {
  caster_->cast(block.buffers, block.receivers, block.tracer);
  if (hasValues())
    ColumnRows::read(caster_->project(block.buffers, block.receivers), 0, block.receivers * rowWidth(),
                     rows.rows);
}

std::unique_ptr<ColumnSums> SpecularColumn::makeSums(const SideShape& side) {
  return hasValues() ? FittedColumn::makeSums(side) : nullptr;
}

void SpecularColumn::save(StateWriter& state) const {
  state.value(rays());
  state.value(steps());
}

void SpecularColumn::load(StateReader& state) {
  state.value(earlierRays_);
  state.value(earlierSteps_);
  state.require(earlierSteps_ <= earlierRays_);
}

void SpecularColumn::saveBlock(StateWriter& state, const CastTask& /*task*/, std::uint32_t /*receivers*/) {
  state.value(toldRays_.growth(caster_->rays()));
  state.value(toldSteps_.growth(caster_->steps()));
}

void SpecularColumn::loadBlock(StateReader& state, const CastTask& task, std::uint32_t receivers,
                               const ColumnRows& rows) {
  FittedColumn::loadBlock(state, task, receivers, rows);
  std::uint64_t ownRays = 0, ownSteps = 0;
  state.value(ownRays);
  state.value(ownSteps);
  state.require(ownSteps <= ownRays);
  earlierRays_ += ownRays;
  earlierSteps_ += ownSteps;
}

}  // namespace prelight
