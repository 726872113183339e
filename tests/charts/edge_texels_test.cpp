#include "charts/texel_cells.h"

#include <gtest/gtest.h>

#include "charts/layout_places.h"
#include "support/scenes.h"

namespace prelight {
namespace {

/// A square of 11 x 11 texels.
struct Square {
  CompiledScene scene = test::ground(1, 1.0f);
  LightMapLayout layout = test::layoutOf(scene, 0.2);
  std::vector<float> sharp = std::vector<float>(layout.texels.size(), 1.0f);
  std::vector<float> all = sharp;
  std::vector<std::uint8_t> hidden = std::vector<std::uint8_t>(layout.texels.size(), 0);

  std::vector<std::uint32_t> edges() const { return edgeTexels(layout, {sharp, all, hidden}); }
  std::uint32_t column(std::size_t i) const {
    return layout.texels[i].texel % static_cast<std::uint32_t>(layout.width);
  }
};

TEST(EdgeTexels, EvenLight_HasNone) { EXPECT_TRUE(Square().edges().empty()); }

TEST(EdgeTexels, ShadowsEdge_HasThoseOnBothSides) {
  Square square;
  for (std::size_t i = 0; i < square.sharp.size(); ++i)
    if (square.column(i) < 5) square.sharp[i] = square.all[i] = 0.0f;
  const std::vector<std::uint32_t> edges = square.edges();
  EXPECT_EQ(edges.size(), 2u * 11u);
  for (const std::uint32_t i : edges) EXPECT_TRUE(square.column(i) == 4 || square.column(i) == 5);
}

TEST(EdgeTexels, StepThatOtherLightDrowns_IsNone) {
  Square square;
  for (std::size_t i = 0; i < square.sharp.size(); ++i) {
    square.sharp[i] = square.column(i) < 5 ? 0.0f : 1.0f;
    square.all[i] = 100.0f;
  }
  EXPECT_TRUE(square.edges().empty());
}

TEST(EdgeTexels, HiddenAndPartedTexels_AreLeftOut) {
  Square square;
  for (std::size_t i = 0; i < square.sharp.size(); ++i) {
    if (square.column(i) >= 5) continue;
    square.sharp[i] = square.all[i] = 0.0f;
    square.hidden[i] = 1;
  }
  EXPECT_TRUE(square.edges().empty());
  square.hidden.assign(square.hidden.size(), 0);
  for (LightMapTexel& texel : square.layout.texels) texel.whole = false;
  EXPECT_TRUE(square.edges().empty());
}

}  // namespace
}  // namespace prelight
