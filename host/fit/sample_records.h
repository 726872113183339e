#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "base/spill_file.h"
#include "base/state_file.h"
#include "receivers/surface_sampler.h"

namespace prelight {

/// Data of a receiver that is kept after its block: its place, and its open fraction for the error estimate.
struct SampleRecord {
  SurfaceSample sample;
  float open = 0.0f;
  std::uint32_t group = 0;  ///< group of the error estimate, < errorGroups
};

/// Number of groups that passes are distributed to. The scatter of the groups gives the standard error.
constexpr std::uint32_t errorGroups = 8;

/// Records in order of addition, in blocks: the first blocks in memory, the others in a file. Any number of
/// threads may read at once.
class SampleRecords {
 public:
  static constexpr std::size_t blockSize = std::size_t{1} << 16;

  /// A cast keeps no more of each side.
  static constexpr std::size_t most = std::size_t{1} << 24;  // 400 MB

  SampleRecords() = default;

  /// Keeps about `bytes` of records in memory, at least one block.
  explicit SampleRecords(std::uint64_t bytes)
      : blocksInMemory_(bytes / (blockSize * sizeof(SampleRecord)) + 1) {}

  void add(const SampleRecord& record);
  std::size_t size() const { return size_; }

  /// Returns how much memory `count` records would take here.
  std::uint64_t bytesInMemory(std::size_t count) const {
    return std::min((count + blockSize - 1) / blockSize, blocksInMemory_) * blockSize * sizeof(SampleRecord);
  }

  /// Reads `records` from index `first` on.
  void read(std::size_t first, std::span<SampleRecord> records) const;

  /// Calls use(records) for every block with records of groups [begin, end), in order.
  template <typename Use>
  void forBlocks(std::uint32_t begin, std::uint32_t end, const Use& use) const {
    std::vector<SampleRecord> read;
    const std::uint32_t wanted = (1u << end) - (1u << begin);
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      if ((blocks_[b].groups & wanted) != 0) use(blockOf(b, read));
  }

  /// Calls use(record) for all records in order.
  template <typename Use>
  void forAll(const Use& use) const {
    forBlocks(0, errorGroups, [&](std::span<const SampleRecord> block) {
      for (const SampleRecord& record : block) use(record);
    });
  }

  void save(StateWriter& state) const;

  /// Replaces all records. The caller checks the values that were read.
  void load(StateReader& state);

 private:
  struct Block {
    std::vector<SampleRecord> records;  ///< empty if the block is in the file
    std::uint32_t groups = 0;           ///< bit g: the block has records of group g
  };

  std::size_t countOf(std::size_t block) const { return std::min(blockSize, size_ - block * blockSize); }
  std::span<const SampleRecord> blockOf(std::size_t block, std::vector<SampleRecord>& read) const;
  void moveToFile(std::size_t block);

  std::size_t blocksInMemory_ = std::numeric_limits<std::size_t>::max();
  std::size_t size_ = 0;
  std::vector<Block> blocks_;
  /// Made when needed. A block's place in the file is the one it would have if all blocks were there.
  std::shared_ptr<SpillFile> file_;
};

}  // namespace prelight
