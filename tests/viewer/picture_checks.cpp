#include "viewer/picture_checks.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace prelight::test {

double largest(const Picture& picture) {
  float most = 0.0f;
  for (const glm::vec3& pixel : picture.pixels) most = std::max({most, pixel.r, pixel.g, pixel.b});
  return most;
}

double largestDifference(const Picture& a, const Picture& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const glm::vec3 d = glm::abs(a.pixels[i] - b.pixels[i]);
    most = std::max({most, double(d.r), double(d.g), double(d.b)});
  }
  return most;
}

void expectColor(const glm::vec3& got, const glm::dvec3& expected, double tolerance) {
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(got[c], expected[c], tolerance * std::max(1e-3, expected[c])) << "channel " << c;
  }
}

}  // namespace prelight::test
