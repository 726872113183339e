#include "cast/caster.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "cast/hemisphere_column.h"
#include "cast/stored_transport.h"
#include "techniques/haar/texel_column.h"
#include "receivers/surface_sampler.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using device::Receiver;

constexpr std::uint32_t directions = 256;  // Rays per receiver.

/// At least `count` receivers all over the front faces of a scene.
std::vector<Receiver> receiversOn(const CompiledScene& scene, std::size_t count) {
  std::vector<Receiver> receivers;
  SurfaceSampler sampler(scene, 7, Side::Front);
  while (receivers.size() < count)
    sampler.pass(static_cast<double>(count), directions,
                 [&](const SurfaceSample&, const Receiver& receiver) { receivers.push_back(receiver); });
  return receivers;
}

/// Blocks of different sizes, to be cast one after the other.
std::vector<std::span<const Receiver>> blocksOf(std::span<const Receiver> receivers, std::size_t size) {
  std::vector<std::span<const Receiver>> blocks;
  for (std::size_t first = 0; first < receivers.size(); first += blocks.back().size())
    blocks.push_back(receivers.subspan(first, std::min(receivers.size() - first, size - blocks.size() % 3)));
  return blocks;
}

CompiledScene ballOnGround() {
  CompiledScene scene = test::ground(8, 2.0f);
  test::append(scene, test::sphere(8, 0.8f, {0.0f, 0.9f, 0.0f}));
  return scene;
}

/// Columns of a caster whose blocks may overlap.
struct OverlappingColumns {
  HemisphereColumn hemisphere{3};
  TexelColumn texels{8, 0};

  std::vector<Column*> all() { return {&hemisphere, &texels}; }
};

TEST(Caster, BlocksUnderWay_SeeWhatTheySeeAlone) {
  const CompiledScene scene = ballOnGround();
  Tracer tracer(scene, test::sharedDevice());
  CastOptions options;
  options.raysPerReceiver = directions;
  OverlappingColumns columns, others;
  Caster alone(scene, tracer, options, columns.all());
  options.overlaps = true;
  Caster overlapping(scene, tracer, options, others.all());
  ASSERT_EQ(overlapping.places(), 2u);
  const std::vector<Receiver> receivers = receiversOn(scene, 7 * std::size_t{100});
  const auto blocks = blocksOf(receivers, 100);
  std::vector<CastRows> seen(blocks.size());
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    overlapping.start(i % 2, blocks[i]);
    if (i > 0) overlapping.finish((i - 1) % 2, seen[i - 1]);
  }
  overlapping.finish((blocks.size() - 1) % 2, seen.back());
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    CastRows rows;
    alone.cast(blocks[i], rows);
    for (std::size_t c = 0; c < rows.columns.size(); ++c)
      EXPECT_EQ(seen[i].columns[c].rows, rows.columns[c].rows) << i << ' ' << c;
    EXPECT_EQ(rows.of(columns.hemisphere).of<float>().size(),
              blocks[i].size() * columns.hemisphere.rowWidth());
    EXPECT_EQ(rows.of(columns.texels).of<std::uint32_t>().size(), blocks[i].size() * directions);
  }
}

/// Rows of a closed room, some in memory and the rest in a file, stored with two blocks in flight.
class StoredRoom : public ::testing::Test {
 protected:
  StoredRoom()
      : scene_(test::box(4, {-1, -1, -1}, {1, 1, 1}, true)),
        tracer_(scene_, test::sharedDevice()),
        transport_(shapeOf(receiversPerBlock(test::sharedDevice().info(), directions))),
        caster_(scene_, tracer_, optionsOf(), {&transport_}) {
    const std::vector<Receiver> receivers = receiversOn(scene_, 3 * std::size_t{caster_.blockSize()});
    const auto blocks = blocksOf(receivers, caster_.blockSize());
    CastRows values;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      caster_.start(i % 2, blocks[i], {Side::Front, 0, rows_});
      if (i > 0) caster_.finish((i - 1) % 2, values);
      rows_ += static_cast<std::uint32_t>(blocks[i].size());
    }
    caster_.finish((blocks.size() - 1) % 2, values);
  }

  static CastOptions optionsOf() {
    CastOptions options;
    options.raysPerReceiver = directions;
    options.overlaps = true;
    return options;
  }

  static TransportShape shapeOf(std::uint32_t block) { return {8 * block, block + block / 2, 1}; }

  void send(const std::function<float(std::size_t place)>& value) {
    std::vector<float> transfer(std::size_t{scene_.vertexCount()} * widestPart);
    for (std::size_t i = 0; i < transfer.size(); ++i) transfer[i] = value(i);
    transport_.resizeTransfer(transfer.size());
    transport_.setTransfer(transfer);
  }

  CompiledScene scene_;
  Tracer tracer_;
  StoredTransport transport_;
  Caster caster_;
  std::uint32_t rows_ = 0;
};

// In a closed white room everything that a receiver sees sends the same light.
TEST_F(StoredRoom, EvenTransfer_ComesBackInEveryRow) {
  send([](std::size_t) { return 0.75f; });
  std::vector<float> values;
  transport_.gather(0, rows_, {}, values);
  ASSERT_EQ(values.size(), std::size_t{rows_} * widestPart);
  for (std::size_t row = 0; row < rows_; ++row)
    for (std::size_t c = 0; c < 3; ++c) ASSERT_NEAR(values[row * widestPart + c], 0.75f, 1e-5f) << row;
}

TEST_F(StoredRoom, RowsGatheredAtOnce_AreThoseOfEachBlock) {
  std::mt19937 random(3);
  send([&](std::size_t) { return std::uniform_real_distribution<float>()(random); });
  ASSERT_GT(rows_, 2 * caster_.blockSize());
  ASSERT_LE(rows_, transport_.rowsPerGather());
  std::vector<float> atOnce, part;
  transport_.gather(0, rows_, {}, atOnce);
  for (std::uint32_t first = 0; first < rows_; first += 100) {
    const std::uint32_t count = std::min(100u, rows_ - first);
    transport_.gather(first, count, {}, part);
    const auto* begin = &atOnce[std::size_t{first} * widestPart];
    ASSERT_EQ(std::vector<float>(begin, begin + part.size()), part) << first;
  }
}

}  // namespace
}  // namespace prelight
