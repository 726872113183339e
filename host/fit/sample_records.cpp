#include "fit/sample_records.h"

#include <algorithm>
#include <cstring>

namespace prelight {

void SampleRecords::add(const SampleRecord& record) {
  if (size_ % blockSize == 0) {
    // The last block still grows, so a block is moved only when the next begins.
    if (blocks_.size() > blocksInMemory_) moveToFile(blocks_.size() - 1);
    blocks_.emplace_back().records.reserve(blockSize);
  }
  Block& block = blocks_.back();
  block.records.push_back(record);
  block.groups |= 1u << record.group;
  ++size_;
}

void SampleRecords::moveToFile(std::size_t block) {
  if (!file_) file_ = std::make_shared<SpillFile>();
  std::vector<SampleRecord>& records = blocks_[block].records;
  file_->write(block * blockSize * sizeof(SampleRecord), std::as_bytes(std::span(records)));
  records = std::vector<SampleRecord>();  // assigning {} would keep the memory
}

std::span<const SampleRecord> SampleRecords::blockOf(std::size_t block,
                                                     std::vector<SampleRecord>& read) const {
  if (!blocks_[block].records.empty()) return blocks_[block].records;
  read.resize(countOf(block));
  file_->read(block * blockSize * sizeof(SampleRecord), std::as_writable_bytes(std::span(read)));
  return read;
}

void SampleRecords::read(std::size_t first, std::span<SampleRecord> records) const {
  while (!records.empty()) {
    const std::size_t block = first / blockSize, at = first % blockSize;
    const std::size_t count = std::min(records.size(), countOf(block) - at);
    const std::vector<SampleRecord>& kept = blocks_[block].records;
    if (!kept.empty())
      std::copy_n(kept.begin() + static_cast<std::ptrdiff_t>(at), count, records.begin());
    else
      file_->read(first * sizeof(SampleRecord), std::as_writable_bytes(records.first(count)));
    first += count;
    records = records.subspan(count);
  }
}

void SampleRecords::save(StateWriter& state) const {
  std::vector<SampleRecord> piece;
  state.growing(0, size_, sizeof(SampleRecord), [&](std::uint64_t first, std::uint64_t count) {
    piece.resize(count);
    read(first, piece);
    return std::as_bytes(std::span(piece));
  });
}

void SampleRecords::load(StateReader& state) {
  std::vector<SampleRecord> piece;
  size_ = 0;
  blocks_.clear();
  state.growing(sizeof(SampleRecord), [&](std::uint64_t /*first*/, std::span<const std::byte> elements) {
    piece.resize(elements.size() / sizeof(SampleRecord));
    std::memcpy(piece.data(), elements.data(), elements.size());
    for (const SampleRecord& record : piece) {
      state.require(record.group < errorGroups);
      add(record);
    }
  });
}

}  // namespace prelight
