#include "occluders/occluder_cut.h"

#include <gtest/gtest.h>

namespace prelight {
namespace {

/// Records with the given form factors, one row per vertex.
OccluderTransfer rows(const std::vector<std::vector<float>>& formFactors) {
  OccluderTransfer transfer{
      {"a", "b", "c"}, {OccluderVector::Position, OccluderVector::Occlusion}, {0}, {}, {}};
  for (const auto& row : formFactors) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      transfer.occluders.push_back(static_cast<std::uint32_t>(k));
      transfer.vectors.push_back(glm::vec4(static_cast<float>(k)));
      transfer.vectors.push_back(glm::vec4(0.0f, 0.0f, 0.0f, row[k]));
    }
    transfer.offsets.push_back(static_cast<std::uint32_t>(transfer.occluders.size()));
  }
  return transfer;
}

TEST(OccluderThreshold, RecordsBelow_AreDroppedAndCounted) {
  OccluderTransfer transfer = rows({{0.5f, 0.01f, 0.2f}, {}, {0.02f, 0.01f}, {0.3f}});
  const DroppedOccluders dropped = dropOccluders(transfer, 0.05);
  EXPECT_EQ(transfer.offsets, (std::vector<std::uint32_t>{0, 2, 2, 2, 3}));
  EXPECT_EQ(transfer.occluders, (std::vector<std::uint32_t>{0, 2, 0}));
  ASSERT_EQ(transfer.vectors.size(), 6u);
  EXPECT_EQ(transfer.vectors[2].x, 2.0f);
  EXPECT_EQ(transfer.vectors[3].w, 0.2f);
  EXPECT_NEAR(dropped.mean, 0.04 / 4, 1e-8);
  EXPECT_NEAR(dropped.most, 0.03, 1e-8);
}

TEST(OccluderThreshold, Zero_ChangesNothing) {
  OccluderTransfer transfer = rows({{0.5f, 0.01f}, {0.3f}});
  const OccluderTransfer before = transfer;
  EXPECT_EQ(dropOccluders(transfer, 0.0).most, 0.0);
  EXPECT_EQ(transfer.occluders, before.occluders);
  EXPECT_EQ(transfer.vectors, before.vectors);
}

TEST(OccluderThreshold, NoVertices_IsFine) {
  OccluderTransfer transfer = rows({});
  EXPECT_EQ(dropOccluders(transfer, 0.5).mean, 0.0);
}

}  // namespace
}  // namespace prelight
