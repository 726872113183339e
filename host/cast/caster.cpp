#include "cast/caster.h"

#include <algorithm>

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

std::vector<float> orientedNormals(const CompiledScene& scene) {
  std::vector<float> normals;
  normals.reserve(3 * std::size_t{scene.triangleCount()});
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const glm::vec3 n(orientedNormal(scene, t));
    normals.insert(normals.end(), {n.x, n.y, n.z});
  }
  return normals;
}

double reachOf(const OcclusionLimits& limits) {
  if (limits.obscurance <= 0.0) return limits.farthest;
  return limits.farthest > 0.0 ? std::min(limits.farthest, limits.obscurance) : limits.obscurance;
}

Caster::Caster(const CompiledScene& scene, Tracer& tracer, const CastOptions& options)
    : tracer_(tracer),
      device_(tracer.context()),
      options_(options),
      vertexCount_(scene.vertexCount()),
      translucent_(scene.hasDiffuseTransmission()),
      valueCount_(4 + static_cast<std::uint32_t>(options.shOrder * options.shOrder)),
      blockSize_(receiversPerBlock(device_.info(), options.raysPerReceiver)),
      parameters_(device_, 1),
      shTable_(device_, std::span<const float>(makeShTable(std::max(1, options.shOrder)))),
      receivers_(device_, blockSize_),
      rays_(device_, std::size_t{blockSize_} * options.raysPerReceiver),
      hits_(device_, std::size_t{blockSize_} * options.raysPerReceiver),
      values_(device_, std::size_t{blockSize_} * std::max<std::size_t>(valueCount_, PRELIGHT_PART_VALUES)) {
  const auto shOrder = BuildOptions().define("PRELIGHT_SH_ORDER", options_.shOrder);
  generate_ = {device_, "cast/generate_kernels.cl", {}, "generateRays"};
  project_ = {device_, "project/project_kernels.cl", shOrder, "projectHits"};
  if (options_.lights != nullptr)
    lights_.emplace(scene, *options_.lights, options_.sets, tracer_, blockSize_, options_.incidentOrder);
  if (options_.texelFaceSize > 0) {
    texelCodes_ = {device_, "project/texel_kernels.cl", {}, "codeTexels"};
    texels_ = Buffer<std::uint32_t>(device_, rays_.size());
  }
  if (options_.storedReceivers > 0 || options_.marksInside || options_.occluders != nullptr)
    geometricNormals_ = Buffer<float>(device_, std::span<const float>(orientedNormals(scene)));
  if (options_.occluders != nullptr)
    occluders_.emplace(scene, *options_.occluders, tracer_, geometricNormals_, blockSize_,
                       options_.raysPerReceiver);
  if (options_.marksInside) {
    insideMarks_ = {device_, "cast/inside_kernels.cl", {}, "markInside"};
    twoSided_ = Buffer<std::uint8_t>(device_, std::span<const std::uint8_t>(twoSidedTriangles(scene)));
    inside_ = Buffer<std::uint8_t>(device_, blockSize_);
  }
  if (options_.storedReceivers == 0) return;
  const BuildOptions transport = transportOptions(options_.bounceColumns);
  store_ = {device_, "cast/transport_kernels.cl", transport, "storeSenders"};
  gather_ = {device_, "cast/transport_kernels.cl", transport, "gatherBounce"};
  senders_.emplace(device_, options_.raysPerReceiver, options_.rowsInMemory, blockSize_);
  marks_ = Buffer<std::uint8_t>(device_, scene.triangleCount());
  marks_.fill(0);
}

BuildOptions Caster::transportOptions(std::size_t columns) const {
  return tracer_.surfaceOptions()
      .define("PRELIGHT_COLUMNS", static_cast<int>(std::max<std::size_t>(columns, 1)))
      .defineIf(translucent_, "PRELIGHT_TRANSLUCENT");
}

void Caster::setParameters(std::uint32_t receivers, std::uint32_t firstStored) {
  const CastParameters parameters{receivers,
                                  options_.raysPerReceiver,
                                  valueCount_,
                                  vertexCount_,
                                  firstStored,
                                  static_cast<float>(options_.limits.nearest),
                                  static_cast<float>(reachOf(options_.limits)),
                                  static_cast<float>(options_.limits.obscurance)};
  parameters_.write(std::span(&parameters, 1));
}

void Caster::generate(std::span<const Receiver> receivers) {
  receivers_.write(receivers);
  generate_.launch(receivers.size() * options_.raysPerReceiver / 8, parameters_, receivers_, rays_);
}

void Caster::cast(std::span<const Receiver> receivers, CastValues& values, const CastPurpose& purpose) {
  Tracer& tracer = purpose.set == 0 ? tracer_ : options_.setTracers[purpose.set - 1];
  const auto count = static_cast<std::uint32_t>(receivers.size());
  const std::uint32_t* row = purpose.storedRow;
  setParameters(count, row != nullptr ? senders_.value().roomFor(*row, count).firstRow : 0);
  generate(receivers);
  const std::size_t rayCount = std::size_t{count} * options_.raysPerReceiver;
  const bool closest = purpose.storedRow != nullptr || purpose.occluders || options_.marksInside ||
                       options_.limits.obscurance > 0.0 || (lights_ && lights_->hasEmitters());
  closest ? tracer.traceClosest(rays_, hits_, rayCount) : tracer.traceAny(rays_, hits_, rayCount);
  if (purpose.storedRow != nullptr) store(count, *purpose.storedRow);
  project(count);
  values.values.resize(std::size_t{count} * valueCount_);
  values_.read(std::span(values.values));
  if (options_.texelFaceSize > 0) codeTexels(count, values.texels);
  if (options_.marksInside) markInside(count, values.inside);
  const CastBlockBuffers block{parameters_, receivers_, rays_, hits_};
  if (lights_) lights_->cast(block, count, tracer, purpose.set, values.lights);
  if (purpose.occluders) occluders_.value().cast(block, count, tracer, values.occluders);
}

void Caster::markInside(std::uint32_t receivers, std::vector<std::uint8_t>& inside) {
  insideMarks_.launch(receivers, parameters_, receivers_, rays_, hits_, geometricNormals_, twoSided_,
                      inside_);
  inside.resize(receivers);
  inside_.read(std::span(inside));
}

void Caster::codeTexels(std::uint32_t receivers, std::vector<std::uint32_t>& texels) {
  const std::size_t rayCount = std::size_t{receivers} * options_.raysPerReceiver;
  texelCodes_.launch(rayCount, parameters_, static_cast<std::uint32_t>(options_.texelFaceSize), rays_, hits_,
                     texels_);
  texels.resize(rayCount);
  texels_.read(std::span(texels));
}

void Caster::project(std::uint32_t receivers) {
  project_.launch(receivers, parameters_, shTable_, rays_, hits_, values_);
}

void Caster::store(std::uint32_t receivers, std::uint32_t firstRow) {
  SenderRows& rows = senders_.value();
  store_.launch(std::size_t{receivers} * options_.raysPerReceiver, parameters_,
                tracer_.scene().layoutBuffer(), tracer_.scene().surface(), geometricNormals_, receivers_,
                rays_, hits_, rows.roomFor(firstRow, receivers).buffer, marks_);
  rows.keep(firstRow, receivers);
}

void Caster::save(StateWriter& state, std::uint32_t rows) const {
  state.value(rows);
  std::vector<Sender> part;
  for (std::uint32_t row = 0; row < rows; row += blockSize_) {
    part.resize(std::size_t{std::min(blockSize_, rows - row)} * options_.raysPerReceiver);
    senders_->read(row, part);
    state.values(part);
  }
  if (options_.storedReceivers > 0) state.values(marks_.read());
}

void Caster::load(StateReader& state, std::uint32_t rows, bool backs) {
  std::uint32_t stored = 0;
  state.value(stored);
  state.require(stored == rows && rows <= options_.storedReceivers);
  std::vector<Sender> part;
  bool fromBacks = false;
  for (std::uint32_t row = 0; row < rows; row += blockSize_) {
    part.resize(std::size_t{std::min(blockSize_, rows - row)} * options_.raysPerReceiver);
    state.sameSize(part);
    for (const Sender& sender : part) {
      if (sender.vertex == PRELIGHT_NO_TRIANGLE) continue;
      state.require(sender.vertex / 2 < vertexCount_);
      fromBacks = fromBacks || sender.vertex >= vertexCount_;
    }
    senders_->write(row, part);
  }
  if (options_.storedReceivers == 0) return;
  std::vector<std::uint8_t> marks(marks_.size());
  state.sameSize(marks);
  for (const std::uint8_t mark : marks) state.require(mark <= 1);
  // Bounces have transfer of backs where a back is marked, or has been cast from.
  state.require(!fromBacks || backs || std::find(marks.begin(), marks.end(), 1) != marks.end());
  marks_.write(std::span<const std::uint8_t>(marks));
}

void Caster::resizeTransfer(std::size_t values) {
  if (transfer_.size() != values) transfer_ = Buffer<float>(device_, values);
}

void Caster::setTransfer(std::span<const float> transfer, std::size_t first) {
  transfer_.write(transfer, first);
}

void Caster::gather(std::uint32_t first, std::uint32_t count, const TransferPart& part,
                    std::vector<float>& values) {
  const SenderRows::Place rows = senders_.value().rows(first, count);
  setParameters(count, rows.firstRow);
  gather_.launch(count, parameters_, part.firstValue, part.firstPlace, rows.buffer, transfer_, values_);
  values.resize(std::size_t{count} * PRELIGHT_PART_VALUES);
  values_.read(std::span(values));
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
  setParameters(count, rows.firstRow);
  generate(receivers);
  glossy_.launch(count, parameters_, glossyTable_, rays_, rows.buffer, transfer_, glossyValues_);
  values.resize(count * width);
  glossyValues_.read(std::span(values));
}

}  // namespace prelight
