#include "cast/sender_rows.h"

#include <algorithm>

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

/// Of `senders` that begin with row `first`, how many are in memory.
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

}  // namespace prelight
