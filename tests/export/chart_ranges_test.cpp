#include "export/exported_vertices.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace prelight {
namespace {

/// A row of charts of `texels` texels each, with one value each. Face i is chart i.
struct Row {
  LightMapLayout layout;
  Picture picture;
};

Row rowOf(const std::vector<float>& values, const std::vector<int>& texels) {
  Row row;
  for (std::uint32_t chart = 0; chart < values.size(); ++chart) {
    row.layout.chartOf.push_back(chart);
    for (int i = 0; i < texels[chart]; ++i) {
      row.layout.texels.push_back({static_cast<std::uint32_t>(row.picture.pixels.size()), chart, 0.3f, 0.3f});
      row.picture.pixels.emplace_back(values[chart]);
    }
  }
  row.layout.chartCount = static_cast<std::uint32_t>(values.size());
  row.layout.width = row.picture.width = static_cast<int>(row.picture.pixels.size());
  row.layout.height = row.picture.height = 1;
  return row;
}

TEST(ChartRanges, DarkCharts_HaveAPictureOfTheirOwn) {
  const Row row = rowOf({100.0f, 90.0f, 1.0f, 0.9f}, {3, 3, 3, 3});
  const ChartRanges ranges = findChartRanges(row.picture, row.layout);
  ASSERT_EQ(ranges.count, 2);
  EXPECT_EQ(ranges.at(row.layout, 0), ranges.at(row.layout, 1));
  EXPECT_EQ(ranges.at(row.layout, 2), 1);
  EXPECT_EQ(ranges.at(row.layout, 3), 1);
  for (const int range : {0, 1}) {
    const Picture part = pictureOfRange(row.picture, row.layout, ranges, range);
    for (std::size_t i = 0; i < part.pixels.size(); ++i) {
      const bool within = ranges.at(row.layout, row.layout.texels[i].face) == range;
      if (within) {
        EXPECT_EQ(part.pixels[i], row.picture.pixels[i]);
      } else {
        EXPECT_EQ(part.pixels[i].x > 10.0f, range == 0) << "what is beside takes after the range";
      }
    }
  }
}

TEST(ChartRanges, FewDarkTexels_JoinTheBrighterRange) {
  const Row row = rowOf({100.0f, 1.0f}, {60, 1});
  EXPECT_EQ(findChartRanges(row.picture, row.layout).count, 1);
}

TEST(ChartRanges, EachHoldsAtMostItsShareOfBrightness_ButTheLast) {
  const Row row = rowOf({512.0f, 65.0f, 64.0f, 8.0f, 1.0f, 0.0f}, {2, 2, 2, 2, 2, 2});
  const ChartRanges ranges = findChartRanges(row.picture, row.layout);
  EXPECT_EQ(ranges.count, 4);
  EXPECT_EQ(ranges.rangeOf, (std::vector<std::uint8_t>{0, 0, 1, 2, 3, 3}));
}

TEST(ChartRanges, NothingLit_IsOneRange) {
  const Row row = rowOf({0.0f, 0.0f}, {4, 4});
  const ChartRanges ranges = findChartRanges(row.picture, row.layout);
  EXPECT_EQ(ranges.at(row.layout, 0), ranges.at(row.layout, 1));
  const Picture part = pictureOfRange(row.picture, row.layout, ranges, ranges.at(row.layout, 0));
  EXPECT_TRUE(std::all_of(part.pixels.begin(), part.pixels.end(),
                          [](const glm::vec3& pixel) { return pixel == glm::vec3(0.0f); }));
}

}  // namespace
}  // namespace prelight
