#include "cast/caster.h"

#include <algorithm>
#include <cstring>

#include "base/parallel.h"
#include "basis/sh_table.h"
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

std::uint32_t receiversAtOnce(const DeviceInfo& device, const CastOptions& options) {
  const std::uint32_t usual = receiversPerBlock(device, options.raysPerReceiver);
  return options.lights == nullptr
             ? usual
             : receiversPerLightBlock(device.kind, *options.lights, options.incidentOrder, usual);
}

}  // namespace

Caster::Caster(const CompiledScene& scene, Tracer& tracer, const CastOptions& options)
    : tracer_(tracer),
      device_(tracer.context()),
      options_(options),
      vertexCount_(scene.vertexCount()),
      translucent_(scene.hasDiffuseTransmission()),
      valueCount_(4 + static_cast<std::uint32_t>(options.shOrder * options.shOrder)),
      blockSize_(receiversAtOnce(device_.info(), options)),
      shTable_(device_, std::span<const float>(makeShTable(std::max(1, options.shOrder)))) {
  // Lights, occluders and what goes on from mirrors have rays of their own, in buffers of one block.
  const bool alone =
      options_.lights != nullptr || options_.occluders != nullptr || options_.specular.followed();
  const std::size_t places = options_.overlaps && !alone ? DeviceLane::count : 1;
  for (std::size_t i = 0; i < places; ++i) blocks_.push_back(makeBlock({i}));
  const auto shOrder = BuildOptions().define("PRELIGHT_SH_ORDER", options_.shOrder);
  generate_ = {device_, "cast/generate_kernels.cl", {}, "generateRays"};
  project_ = {device_, "project/project_kernels.cl", shOrder, "projectHits"};
  if (options_.lights != nullptr)
    lights_.emplace(scene, *options_.lights, options_.sets, tracer_, blockSize_, options_.incidentOrder);
  if (options_.specular.followed())
    specular_.emplace(scene, options_.specular, tracer_, std::size_t{blockSize_} * options_.raysPerReceiver,
                      options_.raysPerReceiver);
  if (options_.shells.count() > 0) shells_.emplace(device_, options_.shells, blockSize_, blocks_.size());
  if (options_.sectors > 0) sectors_.emplace(device_, options_.sectors, blockSize_, blocks_.size());
  if (options_.texelFaceSize > 0) texelCodes_ = {device_, "project/texel_kernels.cl", {}, "codeTexels"};
  if (options_.storedReceivers > 0 || options_.marksInside || options_.occluders != nullptr)
    geometricNormals_ = Buffer<float>(device_, std::span<const float>(orientedNormals(scene)));
  if (options_.occluders != nullptr)
    occluders_.emplace(scene, *options_.occluders, tracer_, geometricNormals_, blockSize_,
                       options_.raysPerReceiver);
  if (options_.marksInside) {
    insideMarks_ = {device_, "cast/inside_kernels.cl", {}, "markInside"};
    findsSolids_ = !options_.solids.empty();
    hides_ = Buffer<std::uint8_t>(device_, std::span<const std::uint8_t>(hidingTriangles(scene, options_)));
  }
  if (options_.storedReceivers == 0) return;
  const BuildOptions transport = transportOptions(options_.bounceColumns);
  store_ = {device_, "cast/transport_kernels.cl", transport, "storeSenders"};
  gather_ = {device_, "cast/transport_kernels.cl", transport, "gatherBounce"};
  if (specular_) storeFollowed_ = {device_, "cast/transport_kernels.cl", transport, "storeFollowed"};
  senders_.emplace(device_, options_.raysPerReceiver, options_.rowsInMemory, blockSize_, blocks_.size());
  marks_ = Buffer<std::uint8_t>(device_, scene.triangleCount());
  marks_.fill(0);
  device_.finish();  // before the other lane marks any
}

Caster::Block Caster::makeBlock(DeviceLane lane) const {
  const std::size_t rays = std::size_t{blockSize_} * options_.raysPerReceiver;
  Block block;
  block.lane = lane;
  block.parameters = {device_, 1, lane};
  block.receivers = {device_, blockSize_, lane};
  block.rays = {device_, rays, lane};
  block.hits = {device_, rays, lane};
  block.values = {device_, std::size_t{blockSize_} * std::max(valueCount_, options_.partValues), lane};
  if (options_.texelFaceSize > 0) block.texels = {device_, rays, lane};
  if (options_.marksInside) block.inside = {device_, blockSize_, lane};
  return block;
}

BuildOptions Caster::transportOptions(std::size_t columns) const {
  return tracer_.surfaceOptions()
      .define("PRELIGHT_COLUMNS", static_cast<int>(std::max<std::size_t>(columns, 1)))
      .define("PRELIGHT_PART_VALUES", options_.partValues)
      .defineIf(translucent_, "PRELIGHT_TRANSLUCENT")
      .defineIf(specular_.has_value(), "PRELIGHT_FOLLOWED");
}

void Caster::setParameters(Block& block, std::uint32_t receivers, std::uint32_t firstStored) {
  const CastParameters parameters{receivers,
                                  options_.raysPerReceiver,
                                  valueCount_,
                                  vertexCount_,
                                  firstStored,
                                  static_cast<float>(options_.limits.nearest),
                                  static_cast<float>(reachOf(options_.limits)),
                                  static_cast<float>(options_.limits.obscurance)};
  block.parameters.write(std::span(&parameters, 1));
}

void Caster::generate(Block& block, std::span<const Receiver> receivers) {
  block.receivers.write(receivers);
  generate_.launch({receivers.size() * options_.raysPerReceiver / 8, block.lane}, block.parameters,
                   block.receivers, block.rays);
}

void Caster::start(std::size_t place, std::span<const Receiver> receivers, const CastPurpose& purpose) {
  Block& block = blocks_[place];
  Tracer& tracer = tracerOf(purpose.set);
  block.count = static_cast<std::uint32_t>(receivers.size());
  block.set = purpose.set;
  block.occluders = purpose.occluders;
  block.shells = shells_ && purpose.shells;
  block.sectors = sectors_ && purpose.sectors;
  block.storedRow.reset();
  if (purpose.storedRow != nullptr) block.storedRow = *purpose.storedRow;
  setParameters(
      block, block.count,
      block.storedRow ? senders_.value().roomFor(*block.storedRow, block.count, block.lane).firstRow : 0);
  generate(block, receivers);
  const std::size_t rayCount = std::size_t{block.count} * options_.raysPerReceiver;
  const bool marks = options_.marksInside && purpose.inside;
  block.closest = (marks && !findsSolids_) || block.storedRow || purpose.occluders || block.shells ||
                  options_.limits.obscurance > 0.0 || specular_ || (lights_ && lights_->hasEmitters());
  block.closest ? tracer.traceClosest(block.rays, block.hits, rayCount, 0, block.lane)
                : tracer.traceAny(block.rays, block.hits, rayCount, 0, block.lane);
  if (block.storedRow) store(block);
  project_.launch({block.count, block.lane}, block.parameters, shTable_, block.rays, block.hits,
                  block.values);
  if (options_.texelFaceSize > 0) codeTexels(block);
  block.placed.clear();
  if (marks) {
    block.placed.assign(receivers.begin(), receivers.end());
    markInside(block);
  }
  if (block.shells)
    shells_->start({block.parameters, block.receivers, block.rays, block.hits}, block.count, block.lane);
  if (block.sectors)
    sectors_->start({block.parameters, block.receivers, block.rays, block.hits}, block.count, block.lane);
}

void Caster::finish(std::size_t place, CastValues& values) {
  Block& block = blocks_[place];
  values.values.resize(std::size_t{block.count} * valueCount_);
  block.values.read(std::span(values.values));
  if (specular_) follow(block, values);
  if (block.storedRow) senders_.value().keep(*block.storedRow, block.count, block.lane);
  if (options_.texelFaceSize > 0) {
    values.texels.resize(std::size_t{block.count} * options_.raysPerReceiver);
    block.texels.read(std::span(values.texels));
  }
  const CastBlockBuffers buffers{block.parameters, block.receivers, block.rays, block.hits};
  Tracer& tracer = tracerOf(block.set);
  if (lights_) lights_->cast(buffers, block.count, tracer, block.set, values.lights);
  if (block.shells) shells_->finish(block.count, block.lane, values.shells);
  if (block.sectors) sectors_->finish(block.count, block.lane, values.sectors);
  if (block.occluders) occluders_.value().cast(buffers, block.count, tracer, values.occluders);
  values.inside.clear();
  if (!block.placed.empty()) readInside(block, values.inside);
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
  setParameters(block, block.count, 0);
  generate(block, suspects);
  tracerOf(block.set).traceClosest(block.rays, block.hits,
                                   std::size_t{block.count} * options_.raysPerReceiver, 0, block.lane);
  markInside(block);
  std::vector<std::uint8_t> sure(suspects.size());
  block.inside.read(std::span(sure));
  for (std::size_t i = 0; i < places.size(); ++i) inside[places[i]] = sure[i];
}

void Caster::codeTexels(Block& block) {
  texelCodes_.launch({std::size_t{block.count} * options_.raysPerReceiver, block.lane}, block.parameters,
                     static_cast<std::uint32_t>(options_.texelFaceSize), block.rays, block.hits,
                     block.texels);
}

void Caster::store(const Block& block) {
  const SenderRows::Place room = senders_.value().roomFor(*block.storedRow, block.count, block.lane);
  store_.launch({std::size_t{block.count} * options_.raysPerReceiver, block.lane}, block.parameters,
                tracer_.scene().layoutBuffer(), tracer_.scene().surface(), geometricNormals_, block.receivers,
                block.rays, block.hits, room.buffer, marks_);
}

/// Rays that meet mirrors and glass bring what is seen by way of those, in place of what was stored of them.
void Caster::follow(const Block& block, CastValues& values) {
  const CastBlockBuffers buffers{block.parameters, block.receivers, block.rays, block.hits};
  specular_->cast(buffers, block.count, tracerOf(block.set));
  if (options_.specular.shOrder > 0) specular_->project(buffers, block.count, values.specular);
  if (!block.storedRow) return;
  const SenderRows::Place room = senders_.value().roomFor(*block.storedRow, block.count, block.lane);
  storeFollowed_.launch({std::size_t{block.count} * options_.raysPerReceiver, block.lane}, block.parameters,
                        tracer_.scene().layoutBuffer(), tracer_.scene().surface(), geometricNormals_,
                        block.receivers, specular_->ends(), room.buffer, marks_);
}

void Caster::save(StateWriter& state, std::uint32_t rows) const {
  state.value(furtherRays());
  state.value(walkSteps());
  if (options_.storedReceivers == 0) return;
  std::vector<Sender> part;
  state.growing(0, rows, options_.raysPerReceiver * sizeof(Sender),
                [&](std::uint64_t first, std::uint64_t count) {
                  part.resize(count * options_.raysPerReceiver);
                  senders_->read(static_cast<std::uint32_t>(first), part);
                  return std::as_bytes(std::span(part));
                });
  state.values(marks_.read());
}

Caster::Loaded Caster::load(StateReader& state) {
  Loaded loaded;
  state.value(earlierRays_);
  state.value(earlierSteps_);
  state.require(earlierSteps_ <= earlierRays_);
  if (options_.storedReceivers == 0) return loaded;
  std::vector<Sender> part;
  const std::size_t rowBytes = options_.raysPerReceiver * sizeof(Sender);
  state.growing(rowBytes, [&](std::uint64_t first, std::span<const std::byte> rows) {
    const std::uint64_t end = first + rows.size() / rowBytes;
    state.require(end <= options_.storedReceivers);
    part.resize(rows.size() / sizeof(Sender));
    std::memcpy(part.data(), rows.data(), rows.size());
    for (const Sender& sender : part) {
      if (sender.vertex == PRELIGHT_NO_TRIANGLE) continue;
      state.require(sender.vertex / 2 < vertexCount_);
      loaded.fromBacks = loaded.fromBacks || sender.vertex >= vertexCount_;
    }
    senders_->write(static_cast<std::uint32_t>(first), part);
    loaded.rows = static_cast<std::uint32_t>(end);
  });
  std::vector<std::uint8_t> marks(marks_.size());
  state.sameSize(marks);
  for (const std::uint8_t mark : marks) state.require(mark <= 1);
  loaded.marked = std::find(marks.begin(), marks.end(), 1) != marks.end();
  marks_.write(std::span<const std::uint8_t>(marks));
  return loaded;
}

void Caster::resizeTransfer(std::size_t values) {
  if (transfer_.size() != values) transfer_ = Buffer<float>(device_, values);
}

void Caster::setTransfer(std::span<const float> transfer, std::size_t first) {
  transfer_.write(transfer, first);
}

void Caster::gather(std::uint32_t first, std::uint32_t count, const TransferPart& part,
                    std::vector<float>& values) {
  SenderRows& senders = senders_.value();
  Block& block = blocks_.front();
  const std::size_t room = std::size_t{rowsPerGather()} * options_.partValues;
  if (gatheredValues_.size() < room) gatheredValues_ = Buffer<float>(device_, room);
  values.resize(std::size_t{count} * options_.partValues);
  for (std::uint32_t done = 0, some = 0; done < count; done += some) {
    some = senders.inMemory(first + done, count - done) ? count - done : std::min(blockSize_, count - done);
    const SenderRows::Place rows = senders.rows(first + done, some);
    setParameters(block, some, rows.firstRow);
    gather_.launch(some, block.parameters, part.firstValue, part.firstPlace, rows.buffer, transfer_,
                   gatheredValues_);
    gatheredValues_.read(std::span(values).subspan(std::size_t{done} * options_.partValues,
                                                   std::size_t{some} * options_.partValues));
  }
}

void Caster::gatherGlossy(std::span<const Receiver> receivers, std::uint32_t first, int order,
                          std::size_t columns, std::vector<float>& values) {
  const std::size_t width = static_cast<std::size_t>(order * order) * 3 * columns;
  const auto options = transportOptions(columns).define("PRELIGHT_GLOSSY_ORDER", order);
  glossy_ = {device_, "cast/transport_kernels.cl", options, "gatherGlossy"};
  if (glossyTable_.size() == 0)
    glossyTable_ = Buffer<float>(device_, std::span<const float>(makeShTable(order)));
  if (glossyValues_.size() < blockSize_ * width) glossyValues_ = Buffer<float>(device_, blockSize_ * width);
  const auto count = static_cast<std::uint32_t>(receivers.size());
  const SenderRows::Place rows = senders_.value().rows(first, count);
  Block& block = blocks_.front();
  setParameters(block, count, rows.firstRow);
  generate(block, receivers);
  glossy_.launch(count, block.parameters, glossyTable_, block.rays, rows.buffer, transfer_, glossyValues_);
  values.resize(count * width);
  glossyValues_.read(std::span(values));
}

}  // namespace prelight
