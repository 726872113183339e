#include "cast/stored_transport.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/devices.h"

namespace prelight {
namespace {

using device::Sender;

constexpr std::uint32_t rays = 4, blockRows = 8;

std::vector<Sender> senders(std::uint32_t firstRow, std::uint32_t rows) {
  std::vector<Sender> made;
  for (std::uint32_t i = 0; i < rows * rays; ++i)
    made.push_back({firstRow * rays + i, ~(firstRow * rays + i)});
  return made;
}

std::vector<Sender> senderRange(const Buffer<Sender>& buffer, std::uint32_t firstRow, std::uint32_t rows) {
  std::vector<Sender> read(std::size_t{rows} * rays);
  buffer.read(std::span(read), std::size_t{firstRow} * rays);
  return read;
}

void expectSame(const std::vector<Sender>& got, const std::vector<Sender>& expected) {
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    EXPECT_EQ(got[i].vertex, expected[i].vertex) << i;
    EXPECT_EQ(got[i].albedo, expected[i].albedo) << i;
  }
}

/// Stores rows as the caster does: a kernel writes where there is room, then the rows are kept.
void store(SenderRows& rows, std::uint32_t first, std::uint32_t count) {
  const SenderRows::Place room = rows.roomFor(first, count);
  room.buffer.write(std::span<const Sender>(senders(first, count)), std::size_t{room.firstRow} * rays);
  rows.keep(first, count);
}

// Rows are in memory, across its end, or in the file. They are read in blocks of other sizes than they were
// stored in.
TEST(SenderRows, RowsOfAllPlaces_AreFoundAgain) {
  for (const std::uint32_t inMemory : {0u, 5u, 12u, 40u}) {
    SenderRows rows(test::sharedDevice().context(), rays, inMemory, blockRows);
    for (std::uint32_t first = 0; first < 24; first += blockRows) store(rows, first, blockRows);
    store(rows, 24, 3);
    for (const std::uint32_t block : {8u, 3u}) {
      for (std::uint32_t first = 0; first + block <= 27; first += block) {
        const SenderRows::Place place = rows.rows(first, block);
        expectSame(senderRange(place.buffer, place.firstRow, block), senders(first, block));
      }
    }
  }
}

TEST(SenderRows, SavedRows_AreThoseOfAnyPlace) {
  SenderRows from(test::sharedDevice().context(), rays, 6, blockRows),
      to(test::sharedDevice().context(), rays, 2, blockRows);
  store(from, 0, 8);
  store(from, 8, 8);
  std::vector<Sender> all(std::size_t{16} * rays);
  from.read(0, all);
  expectSame(all, senders(0, 16));
  to.write(0, all);
  const SenderRows::Place place = to.rows(1, 8);
  expectSame(senderRange(place.buffer, place.firstRow, 8), senders(1, 8));
}

}  // namespace
}  // namespace prelight
