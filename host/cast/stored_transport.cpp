#include "cast/stored_transport.h"

#include <algorithm>
#include <cstring>

#include "basis/sh_evaluate.h"
#include "cast/caster.h"
#include "cast/specular_column.h"

namespace prelight {

using device::Sender;

SenderRows::SenderRows(DeviceContext& device, std::uint32_t raysPerRow, std::uint32_t inMemory,
                       std::uint32_t blockRows, std::size_t lanes)
    : raysPerRow_(raysPerRow), inMemory_(inMemory), memory_(device, std::size_t{inMemory} * raysPerRow) {
  for (std::size_t lane = 0; lane < lanes; ++lane)
    blocks_.emplace_back(device, std::size_t{blockRows} * raysPerRow, DeviceLane{lane});
}

void SenderRows::keep(std::uint32_t first, std::uint32_t count, DeviceLane lane) {
  if (inMemory(first, count)) return;
  host_.resize(std::size_t{count} * raysPerRow_);
  blocks_[lane.number].read(std::span(host_));
  write(first, host_);
}

SenderRows::Place SenderRows::rows(std::uint32_t first, std::uint32_t count) {
  if (inMemory(first, count)) return {memory_, first};
  host_.resize(std::size_t{count} * raysPerRow_);
  read(first, host_);
  blocks_.front().write(std::span<const Sender>(host_));
  return {blocks_.front(), 0};
}

/// Returns how many of `senders`, which begin with row `first`, are in memory.
std::size_t SenderRows::sendersInMemory(std::uint32_t first, std::size_t senders) const {
  return std::min(senders, std::size_t{inMemory_ - std::min(first, inMemory_)} * raysPerRow_);
}

void SenderRows::read(std::uint32_t first, std::span<Sender> senders) const {
  const std::size_t start = std::size_t{first} * raysPerRow_, near = sendersInMemory(first, senders.size());
  memory_.read(senders.first(near), start);
  if (near < senders.size())
    file_.value().read((start + near) * sizeof(Sender), std::as_writable_bytes(senders.subspan(near)));
}

void SenderRows::write(std::uint32_t first, std::span<const Sender> senders) {
  const std::size_t start = std::size_t{first} * raysPerRow_, near = sendersInMemory(first, senders.size());
  memory_.write(senders.first(near), start);
  if (near == senders.size()) return;
  if (!file_) file_.emplace();
  file_->write((start + near) * sizeof(Sender), std::as_bytes(senders.subspan(near)));
}

using namespace device;

void StoredTransport::allocate(const CastShape& shape) {
  tracer_ = &shape.tracer;
  device_ = &shape.tracer.context();
  vertexCount_ = shape.scene.vertexCount();
  translucent_ = shape.scene.hasDiffuseTransmission();
  blockSize_ = shape.blockSize;
  raysPerReceiver_ = shape.raysPerReceiver;
  geometricNormals_ = shape.geometricNormals();
  const BuildOptions options = buildOptions(shape_.columns);
  const char* file = "cast/transport_kernels.cl";
  store_ = {*device_, file, options, "storeSenders"};
  gather_ = {*device_, file, options, "gatherBounce"};
  if (followed_ != nullptr) storeFollowed_ = {*device_, file, options, "storeFollowed"};
  senders_.emplace(*device_, raysPerReceiver_, shape_.rowsInMemory, blockSize_, shape.lanes);
  gatherParameters_ = Buffer<CastParameters>(*device_, 1);
  marks_ = Buffer<std::uint8_t>(*device_, shape.scene.triangleCount());
  marks_.fill(0);
  device_->finish();  // before the other lane marks any
}

BuildOptions StoredTransport::buildOptions(std::size_t columns) const {
  return tracer_->surfaceOptions()
      .define("PRELIGHT_COLUMNS", static_cast<int>(std::max<std::size_t>(columns, 1)))
      .define("PRELIGHT_PART_VALUES", shape_.partValues)
      .defineIf(translucent_, "PRELIGHT_TRANSLUCENT")
      .defineIf(followed_ != nullptr, "PRELIGHT_FOLLOWED");
}

void StoredTransport::addParameters(const CastTask& task, DeviceLane lane, CastParameters& parameters) {
  parameters.firstStored = senders_->roomFor(*task.firstRow, parameters.receiverCount, lane).firstRow;
}

void StoredTransport::start(const CastBlock& block) {
  const SenderRows::Place room = senders_->roomFor(*block.task.firstRow, block.receivers, block.lane);
  store_.launch({std::size_t{block.receivers} * raysPerReceiver_, block.lane}, block.buffers.parameters,
                tracer_->scene().layoutBuffer(), tracer_->scene().surface(), geometricNormals_,
                block.buffers.receivers, block.buffers.rays, block.buffers.hits, room.buffer, marks_);
}

/// Rays that meet mirrors and glass bring what is seen by way of those, in place of what was stored of them.
void StoredTransport::finish(const CastBlock& block, ColumnRows& /*rows*/) {
  const std::uint32_t first = *block.task.firstRow;
  const SenderRows::Place room = senders_->roomFor(first, block.receivers, block.lane);
  if (followed_ != nullptr)
    storeFollowed_.launch({std::size_t{block.receivers} * raysPerReceiver_, block.lane},
                          block.buffers.parameters, tracer_->scene().layoutBuffer(),
                          tracer_->scene().surface(), geometricNormals_, block.buffers.receivers,
                          followed_->ends(), room.buffer, marks_);
  senders_->keep(first, block.receivers, block.lane);
  stored_ = first + block.receivers;
}

void StoredTransport::save(StateWriter& state) const {
  std::vector<Sender> part;
  state.growing(0, stored_, raysPerReceiver_ * sizeof(Sender), [&](std::uint64_t first, std::uint64_t count) {
    part.resize(count * raysPerReceiver_);
    senders_->read(static_cast<std::uint32_t>(first), part);
    return std::as_bytes(std::span(part));
  });
}

void StoredTransport::load(StateReader& state) {
  loaded_.rows = 0;
  loaded_.fromBacks = false;
  std::vector<Sender> part;
  const std::size_t rowBytes = raysPerReceiver_ * sizeof(Sender);
  state.growing(rowBytes, [&](std::uint64_t first, std::span<const std::byte> rows) {
    const std::uint64_t end = first + rows.size() / rowBytes;
    state.require(end <= shape_.rows);
    part.resize(rows.size() / sizeof(Sender));
    std::memcpy(part.data(), rows.data(), rows.size());
    requireSenders(state, part);
    senders_->write(static_cast<std::uint32_t>(first), part);
    loaded_.rows = static_cast<std::uint32_t>(end);
  });
  stored_ = loaded_.rows;
}

void StoredTransport::loadMarks(StateReader& state) {
  std::vector<std::uint8_t> marks(marks_.size());
  state.sameSize(marks);
  for (const std::uint8_t mark : marks) state.require(mark <= 1);
  loaded_.marked = std::find(marks.begin(), marks.end(), 1) != marks.end();
  marks_.write(std::span<const std::uint8_t>(marks));
}

/// Bounces read the transfer of senders, wherever they are said to be.
void StoredTransport::requireSenders(const StateReader& state, std::span<const Sender> senders) {
  for (const Sender& sender : senders) {
    if (sender.vertex == PRELIGHT_NO_TRIANGLE) continue;
    state.require(sender.vertex / 2 < vertexCount_);
    loaded_.fromBacks = loaded_.fromBacks || sender.vertex >= vertexCount_;
  }
}

/// Marks that another block has set meanwhile may be among those of this one: they are put together in the
/// end.
void StoredTransport::saveBlock(StateWriter& state, const CastTask& task, std::uint32_t receivers) {
  std::vector<Sender> senders(std::size_t{receivers} * raysPerReceiver_);
  senders_->read(*task.firstRow, senders);
  state.values(senders);
  state.values(toldMarks_.fresh(marks_));
}

void StoredTransport::loadBlock(StateReader& state, const CastTask& task, std::uint32_t receivers,
                                const ColumnRows& rows) {
  Column::loadBlock(state, task, receivers, rows);
  std::vector<Sender> senders;
  state.values(senders);
  state.require(senders.size() == std::size_t{receivers} * raysPerReceiver_);
  requireSenders(state, senders);
  senders_->write(*task.firstRow, senders);
  stored_ = *task.firstRow + receivers;
  std::vector<std::uint32_t> marked;
  state.values(marked);
  for (const std::uint32_t triangle : marked) state.require(triangle < marks_.size());
  mark(marked, marks_);
}

void StoredTransport::resizeTransfer(std::size_t values) {
  if (transfer_.size() != values) transfer_ = Buffer<float>(*device_, values);
}

void StoredTransport::setTransfer(std::span<const float> transfer, std::size_t first) {
  transfer_.write(transfer, first);
}

void StoredTransport::gather(std::uint32_t first, std::uint32_t count, const TransferPart& part,
                             std::vector<float>& values) {
  const std::size_t width = shape_.partValues, room = rowsPerGather() * width;
  if (gatheredValues_.size() < room) gatheredValues_ = Buffer<float>(*device_, room);
  values.resize(count * width);
  for (std::uint32_t done = 0, some = 0; done < count; done += some) {
    some = senders_->inMemory(first + done, count - done) ? count - done : std::min(blockSize_, count - done);
    const SenderRows::Place rows = senders_->rows(first + done, some);
    const CastParameters parameters{some, raysPerReceiver_, 0, vertexCount_, rows.firstRow, 0.0f, 0.0f, 0.0f};
    gatherParameters_.write(std::span(&parameters, 1));
    gather_.launch(some, gatherParameters_, part.firstValue, part.firstPlace, rows.buffer, transfer_,
                   gatheredValues_);
    gatheredValues_.read(std::span(values).subspan(done * width, some * width));
  }
}

void StoredTransport::gatherGlossy(Caster& caster, std::span<const Receiver> receivers, std::uint32_t first,
                                   int order, std::size_t columns, std::vector<float>& values) {
  const std::size_t width = static_cast<std::size_t>(order * order) * 3 * columns;
  const auto options = buildOptions(columns).define("PRELIGHT_GLOSSY_ORDER", order);
  glossy_ = {*device_, "cast/transport_kernels.cl", options, "gatherGlossy"};
  if (glossyTable_.size() == 0)
    glossyTable_ = Buffer<float>(*device_, std::span<const float>(makeShTable(order)));
  if (glossyValues_.size() < blockSize_ * width) glossyValues_ = Buffer<float>(*device_, blockSize_ * width);
  const auto count = static_cast<std::uint32_t>(receivers.size());
  const SenderRows::Place rows = senders_->rows(first, count);
  const CastBlockBuffers block = caster.drawDirections(receivers, rows.firstRow);
  glossy_.launch(count, block.parameters, glossyTable_, block.rays, rows.buffer, transfer_, glossyValues_);
  values.resize(count * width);
  glossyValues_.read(std::span(values));
}

}  // namespace prelight
