#include "fit/sample_records.h"

#include <gtest/gtest.h>

#include <cstring>

namespace prelight {
namespace {

constexpr std::size_t count = 3 * SampleRecords::blockSize + 1000;

SampleRecord recordOf(std::size_t i) {
  const auto number = static_cast<std::uint32_t>(i);
  return {{number, 0.25f, 0.5f, static_cast<float>(i % 7)},
          static_cast<float>(i % 3),
          number / 10000 % errorGroups};
}

/// Records of which `bytes` stay in memory.
SampleRecords filled(std::uint64_t bytes) {
  SampleRecords records(bytes);
  for (std::size_t i = 0; i < count; ++i) records.add(recordOf(i));
  return records;
}

bool same(const SampleRecord& a, const SampleRecord& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

// Reads in memory, in the file, and across the ends of both.
TEST(SampleRecords, AnyMemory_ReadsBackWhatWasAdded) {
  for (const std::uint64_t bytes :
       {std::uint64_t{0}, SampleRecords::blockSize * sizeof(SampleRecord), ~std::uint64_t{0}}) {
    const SampleRecords records = filled(bytes);
    ASSERT_EQ(records.size(), count);
    std::vector<SampleRecord> read(SampleRecords::blockSize + 10);
    for (const std::size_t first : {std::size_t{0}, SampleRecords::blockSize - 5, count - read.size()}) {
      records.read(first, read);
      for (std::size_t i = 0; i < read.size(); ++i)
        ASSERT_TRUE(same(read[i], recordOf(first + i))) << first + i;
    }
  }
}

TEST(SampleRecords, LittleMemory_KeepsNoMoreThanThatAndABlock) {
  EXPECT_LE(filled(0).bytesInMemory(count), SampleRecords::blockSize * sizeof(SampleRecord));
  EXPECT_GE(filled(~std::uint64_t{0}).bytesInMemory(count), count * sizeof(SampleRecord));
}

TEST(SampleRecords, BlocksOfGroups_HaveTheirRecordsInTheirOrder) {
  const SampleRecords records = filled(0);
  std::vector<std::uint32_t> seen, expected;
  records.forBlocks(2, 4, [&](std::span<const SampleRecord> block) {
    for (const SampleRecord& record : block)
      if (record.group == 2 || record.group == 3) seen.push_back(record.sample.triangle);
  });
  for (std::uint32_t i = 0; i < count; ++i)
    if (recordOf(i).group == 2 || recordOf(i).group == 3) expected.push_back(i);
  ASSERT_FALSE(expected.empty());
  EXPECT_EQ(seen, expected);
}

TEST(SampleRecords, BlockOfOtherGroups_IsNotRead) {
  std::size_t blocks = 0;
  filled(0).forBlocks(7, 8, [&](std::span<const SampleRecord> block) {
    ++blocks;
    EXPECT_FALSE(same(block.front(), recordOf(0)));  // The first block has groups 0 to 6.
  });
  EXPECT_GT(blocks, 0u);
}

TEST(SampleRecords, SavedAndLoaded_AreTheSame) {
  StateWriter writer;
  filled(0).save(writer);
  StateReader reader("state", {writer.payload().begin(), writer.payload().end()});
  SampleRecords loaded;
  loaded.load(reader);
  ASSERT_EQ(loaded.size(), count);
  std::size_t i = 0;
  loaded.forAll([&](const SampleRecord& record) { ASSERT_TRUE(same(record, recordOf(i++))); });
}

}  // namespace
}  // namespace prelight
