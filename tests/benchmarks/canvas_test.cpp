#include "benchmarks/canvas.h"

#include <gtest/gtest.h>

#include <cmath>

#include "benchmarks/contact_sheet.h"

namespace prelight::benchmarks {
namespace {

constexpr std::string_view black = "#000000";

/// Sum over a canvas of how much blacker than white it is.
double ink(const Canvas& canvas) {
  double sum = 0.0;
  for (const glm::vec3& pixel : canvas.pixels()) sum += 1.0 - static_cast<double>(pixel.g);
  return sum;
}

TEST(Canvas, Shapes_CoverTheirArea) {
  Canvas rectangle(40, 30);
  rectangle.rectangle({3.25, 4.5}, 10.5, 7.25, black);
  EXPECT_NEAR(ink(rectangle), 10.5 * 7.25, 1e-3);
  Canvas circle(40, 40);
  circle.circle({20.3, 19.8}, 9.0, black);
  EXPECT_NEAR(ink(circle), 3.14159 * 81.0, 0.02 * 3.14159 * 81.0);
  Canvas line(40, 40);
  line.line({{5, 5}, {35, 30}}, {black, 2.0});
  EXPECT_NEAR(ink(line), 2.0 * std::hypot(30, 25), 6.0);  // and round ends
}

TEST(Canvas, ScaledShapes_CoverTheSquareOfTheScale) {
  Canvas canvas(20, 20, 3.0);
  EXPECT_EQ(canvas.width(), 60);
  canvas.rectangle({2, 2}, 4, 5, black);
  EXPECT_NEAR(ink(canvas), 9.0 * 20.0, 1e-3);
}

TEST(Canvas, Text_IsWrittenWhereItsAnchorSays) {
  const auto columns = [](Anchor anchor) {
    Canvas canvas(200, 30);
    canvas.text({100, 20}, "FLIP 0.12", {.size = 13, .color = black, .anchor = anchor});
    int first = 200, last = -1;
    for (int y = 0; y < canvas.height(); ++y)
      for (int x = 0; x < canvas.width(); ++x)
        if (canvas.pixels()[static_cast<std::size_t>(y) * 200 + x].g < 0.5f) {
          first = std::min(first, x);
          last = std::max(last, x);
        }
    return std::pair(first, last);
  };
  const auto [startFirst, startLast] = columns(Anchor::Start);
  EXPECT_GE(startFirst, 100);
  EXPECT_NEAR(startLast, 100 + 9 * 7, 7);
  const auto [endFirst, endLast] = columns(Anchor::End);
  EXPECT_LE(endLast, 100);
  const auto [middleFirst, middleLast] = columns(Anchor::Middle);
  EXPECT_NEAR(0.5 * (middleFirst + middleLast), 100.0, 4.0);
  EXPECT_NEAR(endLast - endFirst, startLast - startFirst, 1);
}

TEST(Canvas, DifferentTexts_DifferAndSpacesAreEmpty) {
  const auto written = [](std::string_view text) {
    Canvas canvas(40, 20);
    canvas.text({2, 14}, text, {.size = 13, .color = black});
    return std::vector<glm::vec3>(canvas.pixels().begin(), canvas.pixels().end());
  };
  EXPECT_NE(written("3"), written("8"));
  EXPECT_EQ(written("  "), written(""));
}

TEST(ContactSheet, ShrunkPicture_KeepsItsMean) {
  std::vector<glm::vec3> pixels;
  for (int y = 0; y < 27; ++y)
    for (int x = 0; x < 48; ++x) pixels.emplace_back(glm::vec3(x, y, (x * y) % 27) / 48.0f);
  const auto mean = [](const std::vector<glm::vec3>& some) {
    glm::vec3 sum(0.0f);
    for (const glm::vec3& pixel : some) sum += pixel;
    return sum / static_cast<float>(some.size());
  };
  const std::vector<glm::vec3> small = shrink(pixels, 48, 27, 32);
  ASSERT_EQ(small.size(), 32u * 18u);
  EXPECT_LT(glm::distance(mean(small), mean(pixels)), 1e-5f);
}

}  // namespace
}  // namespace prelight::benchmarks
