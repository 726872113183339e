#include "scene/compile/texture_means.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/colour.h"

// Means of the part of a texture that triangles show, compared with fine sampling by look-ups of the test's
// own.
namespace prelight {
namespace {

Image noise(int width, int height, std::uint32_t seed) {
  std::mt19937 random(seed);
  Image image{"noise", width, height, {}};
  for (int i = 0; i < width * height * 4; ++i)
    image.rgba.push_back(static_cast<std::uint8_t>(random() & 255u));
  return image;
}

int wrap(int i, int size, WrapMode mode) {
  if (mode == WrapMode::ClampToEdge) return std::clamp(i, 0, size - 1);
  const int period = mode == WrapMode::MirroredRepeat ? 2 * size : size;
  const int at = ((i % period) + period) % period;
  return at < size ? at : period - 1 - at;
}

glm::dvec3 shown(const Image& image, const TextureRef& use, const glm::dvec2& uv) {
  const auto texel = [&](int x, int y) {
    const std::uint8_t* rgba =
        &image.rgba[4 * static_cast<std::size_t>(wrap(y, image.height, use.wrapT) * image.width +
                                                 wrap(x, image.width, use.wrapS))];
    return glm::dvec3(linearOfSrgb(rgba[0] / 255.0), linearOfSrgb(rgba[1] / 255.0),
                      linearOfSrgb(rgba[2] / 255.0));
  };
  const bool nearest = use.filter == TextureFilter::Nearest;
  const double x = uv.x * image.width - (nearest ? 0.0 : 0.5),
               y = uv.y * image.height - (nearest ? 0.0 : 0.5);
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  if (nearest) return texel(i, j);
  return glm::mix(glm::mix(texel(i, j), texel(i + 1, j), x - i),
                  glm::mix(texel(i, j + 1), texel(i + 1, j + 1), x - i), y - j);
}

/// Mean over the centres of n^2 equal parts. `most` becomes the greatest luminance.
glm::dvec3 sampledMean(const Image& image, const TextureRef& use, const ImageCorners& c, int n,
                       double& most) {
  glm::dvec3 sum(0.0);
  most = 0.0;
  for (int row = 0; row < n; ++row)
    for (int k = 0; k < 2 * (n - row) - 1; ++k) {
      const double third = k % 2 == 0 ? 1.0 / 3.0 : 2.0 / 3.0;
      const double u = (k / 2 + third) / n, v = (row + third) / n;
      const glm::dvec3 color = shown(image, use, c[0] + u * (c[1] - c[0]) + v * (c[2] - c[0]));
      sum += color;
      most = std::max(most, glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722)));
    }
  return sum / double(n * n);
}

TextureRef useOf(WrapMode s, WrapMode t, TextureFilter filter = TextureFilter::Linear) {
  TextureRef use;
  use.image = 0;
  use.wrapS = s;
  use.wrapT = t;
  use.filter = filter;
  return use;
}

constexpr std::array modes{WrapMode::Repeat, WrapMode::ClampToEdge, WrapMode::MirroredRepeat};

TEST(TextureMeans, TrianglesAnywhere_AreThoseOfFineSampling) {
  const Image image = noise(7, 5, 1);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-1.5, 2.5), size(0.05, 1.0);
  for (const WrapMode s : modes)
    for (const WrapMode t : modes)
      for (const TextureFilter filter : {TextureFilter::Linear, TextureFilter::Nearest}) {
        const TextureRef use = useOf(s, t, filter);
        TextureMeans means(image, use);
        for (int i = 0; i < 4; ++i) {
          const glm::dvec2 a(place(random), place(random));
          const ImageCorners corners = {a, a + glm::dvec2(size(random), 0.2),
                                        a + glm::dvec2(-0.1, size(random))};
          double most = 0.0;
          const glm::dvec3 expected = sampledMean(image, use, corners, 300, most);
          const glm::dvec3 found = means.mean(corners);
          const double tolerance =
              // Edges between texels cause an error of sampling.
              filter == TextureFilter::Linear ? 1e-4 : 4e-3;
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(found[c], expected[c], tolerance) << int(s) << int(t) << int(filter);
          EXPECT_GE(means.mostLuminance(corners), most - 1e-5);
        }
      }
}

TEST(TextureMeans, TurnedRound_AreTheSame) {
  const Image image = noise(16, 16, 3);
  TextureMeans means(image, useOf(WrapMode::Repeat, WrapMode::Repeat));
  const ImageCorners corners = {glm::dvec2(0.1, 0.2), {0.9, 0.3}, {0.4, 0.8}};
  const glm::dvec3 one = means.mean(corners), other = means.mean({corners[0], corners[2], corners[1]});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(one[c], other[c], 1e-12);
}

TEST(TextureMeans, WithinATexel_AreExact) {
  const Image image = noise(64, 64, 4);
  const TextureRef use = useOf(WrapMode::Repeat, WrapMode::Repeat);
  TextureMeans means(image, use);
  const ImageCorners corners = {glm::dvec2(0.50011, 0.50013), {0.50017, 0.50014}, {0.50012, 0.50019}};
  double most = 0.0;
  const glm::dvec3 expected = sampledMean(image, use, corners, 64, most);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(means.mean(corners)[c], expected[c], 2e-5);
  EXPECT_NEAR(means.mostLuminance(corners), most, 1e-3);
}

TEST(TextureMeans, ThousandsOfRepeats_AreTheWholeImage) {
  const Image image = noise(64, 32, 5);
  glm::dvec3 whole(0.0);
  for (std::size_t i = 0; i < image.rgba.size(); i += 4)
    whole += glm::dvec3(linearOfSrgb(image.rgba[i] / 255.0), linearOfSrgb(image.rgba[i + 1] / 255.0),
                        linearOfSrgb(image.rgba[i + 2] / 255.0)) /
             double(image.width * image.height);
  for (const WrapMode mode : {WrapMode::Repeat, WrapMode::MirroredRepeat})
    for (const double repeats : {1000.0, 1e6, 1e9}) {
      TextureMeans means(image, useOf(mode, mode));
      const glm::dvec3 found = means.mean({glm::dvec2(0.0), {repeats, 0.1}, {0.3, repeats}});
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], whole[c], 1e-3) << repeats;
    }
}

TEST(TextureMeans, FarBeyondAClampedEdge_AreThatOfTheEdge) {
  Image image{"white but for its edge", 64, 64, std::vector<std::uint8_t>(4 * 64 * 64, 255)};
  for (int i = 0; i < 64; ++i)
    for (const int at : {i, 63 * 64 + i, i * 64, i * 64 + 63})
      for (int c = 0; c < 3; ++c) image.rgba[static_cast<std::size_t>(4 * at + c)] = 0;
  TextureMeans means(image, useOf(WrapMode::ClampToEdge, WrapMode::ClampToEdge));
  const glm::dvec3 found = means.mean({glm::dvec2(-1e5, -1e5), {3e5, -1e5}, {-1e5, 3e5}});
  EXPECT_NEAR(found.x, 1.0 * 62.0 * 62.0 / (64.0 * 64.0) / 8e10, 2e-13);
  EXPECT_EQ(means.mean({glm::dvec2(1.5, 0.1), {2.5, 0.1}, {1.5, 0.9}}), glm::dvec3(0.0));
}

TEST(TextureMeans, WithoutAreaInTheImage_AreThoseAlongTheLine) {
  Image image{"ramp", 2, 1, {0, 0, 0, 255, 255, 255, 255, 255}};
  TextureMeans means(image, useOf(WrapMode::ClampToEdge, WrapMode::ClampToEdge));
  EXPECT_EQ(means.mean({glm::dvec2(0.9), glm::dvec2(0.9), glm::dvec2(0.9)}).x, 1.0);
  // u runs from 1/4 to 3/4, the extent of the ramp, between corners 0 and 1. The mean is the weight of corner
  // 1 plus half of that of corner 2.
  EXPECT_NEAR(means.mean({glm::dvec2(0.25, 0.5), {0.75, 0.5}, {0.5, 0.5}}).x, 0.5, 1e-3);
}

TEST(TextureMeans, OfALargeImage_TakeABoundedTime) {
  const Image image = noise(2048, 2048, 6);
  TextureMeans means(image, useOf(WrapMode::Repeat, WrapMode::Repeat));
  const glm::dvec3 all = means.mean({glm::dvec2(0.0), {1.0, 0.0}, {0.0, 1.0}});
  const glm::dvec3 rough = means.mean({glm::dvec2(0.0), {1.0, 0.0}, {0.0, 1.0}}, 100.0);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(all[c], rough[c], 2e-3);
}

}  // namespace
}  // namespace prelight
