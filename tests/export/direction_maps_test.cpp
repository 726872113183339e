#include "export/texel_codes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "charts/make_light_map_layout.h"
#include "export/map_picture.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"

namespace prelight {
namespace {

/// A map of a built-in scene with uniform light: irradiance 1, and radiance in SH of order 2.
struct Lit {
  CompiledScene scene;
  LightMap map;
};

Lit litBy(const char* name, const std::array<float, 4>& radiance) {
  Warnings warnings;
  const Scene source = loadScene(makeBuiltinScene(name), warnings);
  Lit lit{compileScene(source, warnings), {}};
  LightMapLayoutRequest request;
  request.texels = 2048;
  lit.map.layout = makeLightMapLayout(source, lit.scene, request);
  lit.map.coefficients = 5;
  lit.map.values.assign(15 * lit.map.layout.texelCount(), 0.0f);
  for (const LightMapTexel& texel : lit.map.layout.texels)
    for (std::size_t c = 0; c < 3; ++c) {
      float* values = &lit.map.values[(3 * texel.texel + c) * 5];
      values[0] = 1.0f;
      std::copy(radiance.begin(), radiance.end(), values + 1);
    }
  return lit;
}

TEST(DirectionMaps, OneFarLamp_IsItsWholeDirection) {
  // Y_1 = 0.488603 (y, z, x) for the direction (0.6, 0.8, 0), and Y_0 = 0.282095.
  const Lit lit = litBy("cornell", {0.28209479f, 0.39088201f, 0.0f, 0.29316151f});
  const Image image = directionImage(lit.scene, lit.map);
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    ASSERT_NEAR(image.rgba[i], 255.0 * 0.8, 1.0);
    ASSERT_NEAR(image.rgba[i + 1], 255.0 * 0.9, 1.0);
    ASSERT_NEAR(image.rgba[i + 2], 255.0 * 0.5, 1.0);
  }
}

TEST(DirectionMaps, LightFromAllSides_HasNone) {
  const Lit lit = litBy("cornell", {1.0f, 0.0f, 0.0f, 0.0f});
  for (const std::uint8_t value : directionImage(lit.scene, lit.map).rgba) ASSERT_NEAR(value, 127.5, 0.6);
}

/// Half the size: each texel is the mean of four, as in mipmaps made by graphics cards.
Picture halved(const Picture& fine) {
  Picture coarse{std::max(fine.width / 2, 1), std::max(fine.height / 2, 1), {}};
  for (int y = 0; y < coarse.height; ++y)
    for (int x = 0; x < coarse.width; ++x) {
      glm::vec3 sum(0.0f);
      for (int k = 0; k < 4; ++k)
        sum += fine.pixels[static_cast<std::size_t>(std::min(2 * y + k / 2, fine.height - 1) * fine.width +
                                                    std::min(2 * x + k % 2, fine.width - 1))];
      coarse.pixels.push_back(0.25f * sum);
    }
  return coarse;
}

class PaddedMaps : public ::testing::TestWithParam<const char*> {};

/// An evenly lit scene stays even in every mipmap: texels beside a chart do not darken its border.
TEST_P(PaddedMaps, Mipmaps_DoNotDarkenBordersOfCharts) {
  const Lit lit = litBy(GetParam(), {1.0f, 0.0f, 0.0f, 0.0f});
  std::vector<Picture> pictures = radianceMaps(lit.map);
  pictures.erase(pictures.begin() + 1, pictures.end());
  pictures.push_back(irradiancePicture(lit.map));
  const std::vector<bool> met = metTexels(lit.map.layout);
  EXPECT_NE(std::find(met.begin(), met.end(), false), met.end()) << "else nothing was filled";
  for (Picture level : pictures)
    for (; level.width * level.height > 1; level = halved(level))
      for (const glm::vec3& pixel : level.pixels) ASSERT_NEAR(pixel.y, 1.0f, 1e-5f);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PaddedMaps, ::testing::Values("cornell", "rooms", "shapes"));

}  // namespace
}  // namespace prelight
