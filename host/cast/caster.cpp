#include "cast/caster.h"

#include <algorithm>

#include "base/parallel.h"
#include "receivers/surface_sampler.h"
#include "scene/lobes.h"

namespace prelight {

using namespace device;

// Rays of a block: enough to keep all cores busy, few enough that rays and hits stay in cache on a CPU and
// that a launch stays far below a second anywhere.
std::uint32_t receiversPerBlock(const DeviceInfo& device, std::uint32_t raysPerReceiver) {
  return std::max(1u, (device.kind == DeviceKind::Gpu ? 1u << 21 : 1u << 17) / raysPerReceiver);
}

std::vector<std::uint8_t> twoSidedTriangles(const CompiledScene& scene) {
  std::vector<std::uint8_t> twoSided;
  for (const std::uint32_t material : scene.triangleMaterials)
    twoSided.push_back(scene.materials[material].doubleSided || isTranslucent(scene.materials[material]) ? 1
                                                                                                         : 0);
  return twoSided;
}

namespace {

/// [triangle], 1 where its back hides what lies behind.
std::vector<std::uint8_t> hidingTriangles(const CompiledScene& scene, const CastOptions& options) {
  if (!options.solids.empty()) return {options.solids.begin(), options.solids.end()};
  std::vector<std::uint8_t> hides = twoSidedTriangles(scene);
  for (std::uint8_t& mark : hides) mark = mark != 0 ? 0 : 1;
  return hides;
}

}  // namespace

std::vector<float> orientedNormals(const CompiledScene& scene) {
  std::vector<float> normals(3 * std::size_t{scene.triangleCount()});
  parallelRanges(scene.triangleCount(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const glm::vec3 n(orientedNormal(scene, static_cast<std::uint32_t>(t)));
      std::copy_n(&n.x, 3, &normals[3 * t]);
    }
  });
  return normals;
}

double reachOf(const OcclusionLimits& limits) {
  if (limits.obscurance <= 0.0) return limits.farthest;
  return limits.farthest > 0.0 ? std::min(limits.farthest, limits.obscurance) : limits.obscurance;
}

namespace {

std::uint32_t receiversAtOnce(const DeviceInfo& device, std::uint32_t raysPerReceiver,
                              std::span<Column* const> columns) {
  std::uint32_t count = receiversPerBlock(device, raysPerReceiver);
  for (const Column* column : columns) count = column->receiversAtOnce(device.kind, count);
  return count;
}

}  // namespace

Caster::Caster(const CompiledScene& scene, Tracer& tracer, const CastOptions& options,
               std::vector<Column*> columns)
    : scene_(scene),
      tracer_(tracer),
      device_(tracer.context()),
      options_(options),
      columns_(std::move(columns)),
      blockSize_(receiversAtOnce(device_.info(), options.raysPerReceiver, columns_)) {
  const bool alone = std::any_of(columns_.begin(), columns_.end(),
                                 [](const Column* column) { return column->needs().ownRays; });
  const std::size_t places = options_.overlaps && !alone ? DeviceLane::count : 1;
  for (std::size_t i = 0; i < places; ++i) blocks_.push_back(makeBlock({i}));
  generate_ = {device_, "cast/generate_kernels.cl", {}, "generateRays"};
  if (options_.marksInside) {
    insideMarks_ = {device_, "cast/inside_kernels.cl", {}, "markInside"};
    findsSolids_ = !options_.solids.empty();
    hides_ = Buffer<std::uint8_t>(device_, std::span<const std::uint8_t>(hidingTriangles(scene, options_)));
    (void)geometricNormals();
  }
  const CastShape shape{scene, tracer_, options_.sets, blockSize_, options_.raysPerReceiver, places, [this] {
                          return geometricNormals();
                        }};
  for (std::size_t i = 0; i < columns_.size(); ++i) columns_[i]->prepare(i, shape);
}

Caster::Block Caster::makeBlock(DeviceLane lane) const {
  const std::size_t rays = std::size_t{blockSize_} * options_.raysPerReceiver;
  Block block;
  block.lane = lane;
  block.parameters = {device_, 1, lane};
  block.receivers = {device_, blockSize_, lane};
  block.rays = {device_, rays, lane};
  block.hits = {device_, rays, lane};
  if (options_.marksInside) block.inside = {device_, blockSize_, lane};
  return block;
}

/// Made when it is asked for first: few bakes need it.
Buffer<float> Caster::geometricNormals() {
  if (geometricNormals_.size() == 0)
    geometricNormals_ = Buffer<float>(device_, std::span<const float>(orientedNormals(scene_)));
  return geometricNormals_;
}

CastParameters Caster::parametersOf(std::uint32_t receivers) const {
  return {receivers,
          options_.raysPerReceiver,
          0,
          scene_.vertexCount(),
          0,
          static_cast<float>(options_.limits.nearest),
          static_cast<float>(reachOf(options_.limits)),
          static_cast<float>(options_.limits.obscurance)};
}

void Caster::place(Block& block, std::span<const Receiver> receivers, const CastParameters& parameters) {
  block.parameters.write(std::span(&parameters, 1));
  block.receivers.write(receivers);
}

void Caster::generate(Block& block, std::span<const Receiver> receivers, const CastParameters& parameters) {
  place(block, receivers, parameters);
  generate_.launch({receivers.size() * options_.raysPerReceiver / 8, block.lane}, block.parameters,
                   block.receivers, block.rays);
}

CastBlockBuffers Caster::drawDirections(std::span<const Receiver> receivers, std::uint32_t firstRow) {
  Block& block = blocks_.front();
  CastParameters parameters = parametersOf(static_cast<std::uint32_t>(receivers.size()));
  parameters.firstStored = firstRow;
  generate(block, receivers, parameters);
  return {block.parameters, block.receivers, block.rays, block.hits};
}

CastBlock Caster::castBlock(const Block& block) const {
  return {{block.parameters, block.receivers, block.rays, block.hits},
          block.count,
          block.task,
          tracerOf(block.task.set),
          block.lane};
}

bool Caster::needsClosest(const CastTask& task) const {
  if ((marksInside(task) && !findsSolids_) || options_.limits.obscurance > 0.0) return true;
  return std::any_of(columns_.begin(), columns_.end(), [&](const Column* column) {
    return takes(*column, task) && column->needs().closestHits;
  });
}

void Caster::trace(Block& block, std::span<const Receiver> receivers, const CastParameters& parameters) {
  generate(block, receivers, parameters);
  const std::size_t rays = std::size_t{block.count} * options_.raysPerReceiver;
  Tracer& tracer = tracerOf(block.task.set);
  block.closest ? tracer.traceClosest(block.rays, block.hits, rays, 0, block.lane)
                : tracer.traceAny(block.rays, block.hits, rays, 0, block.lane);
}

bool Caster::traces(const CastTask& task) const {
  return marksInside(task) || std::any_of(columns_.begin(), columns_.end(), [&](const Column* column) {
           return takes(*column, task) && column->needs().rays;
         });
}

void Caster::start(std::size_t number, std::span<const Receiver> receivers, const CastTask& task) {
  Block& block = blocks_[number];
  block.count = static_cast<std::uint32_t>(receivers.size());
  block.task = task;
  block.closest = needsClosest(task);
  CastParameters parameters = parametersOf(block.count);
  for (Column* column : columns_)
    if (takes(*column, task)) column->addParameters(task, block.lane, parameters);
  traces(task) ? trace(block, receivers, parameters) : place(block, receivers, parameters);
  for (Column* column : columns_)
    if (takes(*column, task)) column->start(castBlock(block));
  block.placed.clear();
  if (!marksInside(task)) return;
  block.placed.assign(receivers.begin(), receivers.end());
  markInside(block);
}

void Caster::finish(std::size_t place, CastRows& rows) {
  Block& block = blocks_[place];
  rows.columns.resize(columns_.size());
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    rows.columns[i].cast = takes(*columns_[i], block.task);
    if (rows.columns[i].cast) columns_[i]->finish(castBlock(block), rows.columns[i]);
  }
  rows.inside.clear();
  if (!block.placed.empty()) readInside(block, rows.inside);
}

void Caster::markInside(Block& block) {
  insideMarks_.launch({block.count, block.lane}, block.parameters, block.closest ? 1u : 0u,
                      findsSolids_ ? 1u : 4u, block.receivers, block.rays, block.hits, geometricNormals_,
                      hides_, block.inside);
}

// Where any hit was enough, those that may lie inside look once more for the closest.
void Caster::readInside(Block& block, std::vector<std::uint8_t>& inside) {
  inside.resize(block.count);
  block.inside.read(std::span(inside));
  if (block.closest) return;
  std::vector<std::uint32_t> places;
  std::vector<Receiver> suspects;
  for (std::uint32_t i = 0; i < block.count; ++i) {
    if (inside[i] == 0) continue;
    places.push_back(i);
    suspects.push_back(block.placed[i]);
  }
  if (suspects.empty()) return;
  block.count = static_cast<std::uint32_t>(suspects.size());
  block.closest = true;
  generate(block, suspects, parametersOf(block.count));
  tracerOf(block.task.set)
      .traceClosest(block.rays, block.hits, std::size_t{block.count} * options_.raysPerReceiver, 0,
                    block.lane);
  markInside(block);
  std::vector<std::uint8_t> sure(suspects.size());
  block.inside.read(std::span(sure));
  for (std::size_t i = 0; i < places.size(); ++i) inside[places[i]] = sure[i];
}

std::uint64_t Caster::furtherRays() const {
  std::uint64_t rays = 0;
  for (const Column* column : columns_) rays += column->rays();
  return rays;
}

void Caster::save(StateWriter& state) const {
  for (const Column* column : columns_) column->save(state);
}

void Caster::load(StateReader& state) {
  for (Column* column : columns_) column->load(state);
}

void Caster::saveBlock(StateWriter& state, const CastRows& rows, const CastTask& task,
                       std::uint32_t receivers) const {
  state.values(rows.inside);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const ColumnRows& own = rows.columns[i];
    if (!own.cast) continue;
    state.values(own.rows);
    state.value(static_cast<std::uint32_t>(own.records.size()));
    for (const std::vector<std::byte>& records : own.records) state.values(records);
    columns_[i]->saveBlock(state, task, receivers);
  }
}

void Caster::loadBlock(StateReader& state, CastRows& rows, const CastTask& task, std::uint32_t receivers) {
  constexpr std::uint32_t mostRecords = 16;
  state.values(rows.inside);
  state.require(rows.inside.size() == (marksInside(task) ? receivers : 0));
  for (const std::uint8_t mark : rows.inside) state.require(mark <= 1);
  rows.columns.assign(columns_.size(), {});
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    ColumnRows& own = rows.columns[i];
    own.cast = takes(*columns_[i], task);
    if (!own.cast) continue;
    std::uint32_t records = 0;
    state.values(own.rows);
    state.value(records);
    state.require(records <= mostRecords);
    own.records.resize(records);
    for (std::vector<std::byte>& array : own.records) state.values(array);
    columns_[i]->loadBlock(state, task, receivers, own);
  }
}

}  // namespace prelight
