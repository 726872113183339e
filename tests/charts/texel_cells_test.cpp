#include "charts/texel_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "charts/layout_places.h"
#include "charts/light_map_lookup.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using test::layoutOf;
using test::positionOf;

glm::dvec2 placeOf(const LightMapLayout& layout, const LightMapTexel& texel) {
  return lightMapPlace(layout, texel.face, double(texel.b1), double(texel.b2));
}

/// All places of all texels, on any mesh, lie on the texel's chart and within its cell, in pairs opposite one
/// another about the texel's place.
void checkCells(const CompiledScene& scene, double texelSize) {
  const LightMapLayout layout = layoutOf(scene, texelSize);
  const TexelCells cells(scene, layout);
  std::size_t spread = 0;
  for (const LightMapTexel& texel : layout.texels) {
    const glm::dvec2 middle = placeOf(layout, texel);
    const TexelCells::Places places = cells.around(texel);
    std::set<double> columns;
    for (std::size_t i = 0; i < places.size(); i += 2) {
      const glm::dvec2 one = placeOf(layout, places[i]), other = placeOf(layout, places[i + 1]);
      ASSERT_EQ(layout.chartOf[places[i].face], layout.chartOf[texel.face]);
      ASSERT_EQ(places[i].texel, texel.texel);
      ASSERT_LE(std::max(std::abs(one.x - middle.x), std::abs(one.y - middle.y)), 0.5 * TexelCells::side);
      // Places keep off the edges of their triangles by a thousandth of the way to the centroid.
      ASSERT_NEAR(0.5 * (one.x + other.x), middle.x, layout.width / 1024.0);
      ASSERT_NEAR(0.5 * (one.y + other.y), middle.y, layout.width / 1024.0);
      columns.insert(std::round(100.0 * one.x));
    }
    if (columns.size() == TexelCells::placeCount / 2) ++spread;
  }
  EXPECT_GE(double(spread), 0.75 * double(layout.texels.size()));
}

TEST(TexelCells, OneTriangleForManyTexels_SpreadsThePlaces) { checkCells(test::ground(1, 1.0f), 0.05); }

TEST(TexelCells, ManyTrianglesForATexel_SpreadThePlaces) { checkCells(test::ground(80, 1.0f), 0.1); }

TEST(TexelCells, FirstPlaces_AreSpreadToo) {
  const CompiledScene scene = test::ground(1, 1.0f);
  const LightMapLayout layout = layoutOf(scene, 0.1);
  const TexelCells cells(scene, layout);
  const LightMapTexel& texel = layout.texels[layout.texels.size() / 2];
  const TexelCells::Places places = cells.around(texel);
  for (const std::size_t count : {4u, 8u, 16u}) {
    std::set<int> columns, rows;  // At least half as many as there are places.
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dvec2 offset =
          (placeOf(layout, places[i]) - placeOf(layout, texel)) / TexelCells::side + 0.5;
      columns.insert(static_cast<int>(std::floor(offset.x * double(count))));
      rows.insert(static_cast<int>(std::floor(offset.y * double(count))));
    }
    EXPECT_GE(columns.size(), count / 2) << count;
    EXPECT_GE(rows.size(), count / 2) << count;
  }
}

TEST(TexelCells, TexelThatIsNotWhole_KeepsToItsPlace) {
  const CompiledScene scene = test::ground(1, 1.0f);
  const LightMapLayout layout = layoutOf(scene, 0.1);
  LightMapTexel texel = layout.texels[layout.texels.size() / 2];
  texel.whole = false;
  for (const LightMapTexel& place : TexelCells(scene, layout).around(texel)) {
    EXPECT_EQ(place.b1, texel.b1);
    EXPECT_EQ(place.b2, texel.b2);
  }
}

TEST(TexelCells, ChartOfOneTexel_IsCoveredWhole) {
  CompiledScene scene = test::ground(1, 10.0f);
  test::append(scene, test::ground(2, 0.05f, 1.0f));
  const LightMapLayout layout = layoutOf(scene, 1.0);
  const LightMapTexel* small = nullptr;
  for (const LightMapTexel& texel : layout.texels)
    if (texel.face >= 2) small = &texel;
  ASSERT_NE(small, nullptr);
  ASSERT_EQ(texelsOf(layout, small->face), 0.0);
  const TexelCells::Places places = TexelCells(scene, layout).around(*small);
  std::set<std::uint32_t> faces;
  glm::dvec3 mean(0.0);
  for (const LightMapTexel& place : places) {
    faces.insert(place.face);
    mean += positionOf(scene, place) / double(places.size());
  }
  EXPECT_EQ(faces.size(), 8u);
  EXPECT_NEAR(mean.x, 0.0, 0.005);
  EXPECT_NEAR(mean.z, 0.0, 0.005);
}

}  // namespace
}  // namespace prelight
