// The layers of drawn pictures.
#include "viewer/frame/picture_layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "viewer/picture_checks.h"
#include "viewer/quad_scene.h"

namespace prelight {
namespace {

using test::QuadScene;
using test::square;
using viewer::Shading;

constexpr int size = 17;

/// A white quad beside a metal one, a glowing one, and one of thin glass in front of the first, under a sky
/// and a lamp.
QuadScene quads() {
  QuadScene scene;
  const auto at = [](double x, double z) {
    glm::dmat4 place(1.0);
    place[3] = glm::dvec4(x, 0.0, z, 1.0);
    return place;
  };
  scene.add(test::lambertian({0.8f, 0.5f, 0.3f}), 0.5f, at(-1.0, 0.0));
  Material metal = test::lambertian(glm::vec3(0.9f));
  metal.metallic = 1.0f;
  metal.roughness = 0.3f;
  scene.add(metal, 0.5f, at(0.0, 0.0));
  Material glow = test::lambertian(glm::vec3(0.5f));
  glow.emission = {0.7f, 0.6f, 0.2f};
  scene.add(glow, 0.5f, at(1.0, 0.0));
  Material pane = test::lambertian(glm::vec3(0.9f));
  pane.transmission = 1.0f;
  scene.add(pane, 0.3f, at(-1.0, 0.4));
  scene.scene.lights = {test::makeLight(LightType::Point, glm::vec3(4.0f), {0.2, 0.5, 1.5})};
  scene.setSky(test::halvedSky());
  scene.lookFrom({0, 0.2, 2.5}, {0, 0, 0});
  scene.compile();
  scene.bakeOpen(3, 1, 0.6f);
  scene.bake.bentNormals.assign(scene.compiled.vertexCount(), glm::vec3(0, 0, 1));
  scene.bake.apertures.assign(scene.compiled.vertexCount(), 0.6f);
  scene.bake.horizons = HorizonTransfer{4, std::vector<float>(4 * scene.compiled.vertexCount(), 0.4f), {}};
  scene.bake.irradiance.emplace(scene.compiled.vertexCount(), glm::vec3(1.2f));
  return scene;
}

struct Layered {
  Picture picture;
  std::vector<PictureChannel> layers;

  const PictureChannel* find(const std::string& name) const {
    const auto found =
        std::find_if(layers.begin(), layers.end(), [&](const auto& l) { return l.name == name; });
    return found == layers.end() ? nullptr : &*found;
  }
  double meanOf(const std::string& name) const {
    const PictureChannel* channel = find(name);
    if (channel == nullptr) return -1.0;
    double sum = 0.0;
    for (const float value : channel->values) sum += value / static_cast<double>(channel->values.size());
    return sum;
  }
};

Layered draw(const QuadScene& scene, const viewer::RenderOptions& options) {
  Warnings notes;
  Layered layered;
  layered.picture = viewer::renderPicture(scene.inputs(), options, notes, nullptr, &layered.layers);
  return layered;
}

void expectSum(const Layered& layered, const std::string& what) {
  for (std::size_t i = 0; i < layered.picture.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      double sum = 0.0;
      for (const PictureChannel& layer : layered.layers)
        if (layer.name.ends_with(std::string(".") + "RGB"[c])) sum += layer.values[i];
      const double expected = layered.picture.pixels[i][c];
      ASSERT_NEAR(sum, expected, 1e-5 * expected + 1e-6) << what << " " << i << " " << c;
    }
}

TEST(PictureLayers, OfEveryShading_AddUpToThePicture) {
  const QuadScene scene = quads();
  for (const Shading shading : {Shading::Phong, Shading::Ao, Shading::Sh, Shading::Cones, Shading::Horizons,
                                Shading::Screen, Shading::Radiosity}) {
    const Layered layered = draw(scene, square(shading, size));
    expectSum(layered, std::string(viewer::shadingName(shading)));
    EXPECT_GT(layered.meanOf("emitted.G"), 0.05) << viewer::shadingName(shading);
    EXPECT_GT(layered.meanOf("reflected.G"), 0.005) << viewer::shadingName(shading);
    EXPECT_EQ(layered.find("baked.G") != nullptr, shading == Shading::Sh || shading == Shading::Radiosity);
    EXPECT_EQ(layered.find("caustic.G"), nullptr) << "no photons were sent";
  }
}

TEST(PictureLayers, ThePicture_IsTheSameWithThem) {
  const QuadScene scene = quads();
  for (const Shading shading : {Shading::Phong, Shading::Sh, Shading::Cones})
    EXPECT_EQ(draw(scene, square(shading, size)).picture.pixels, scene.render(square(shading, size)).pixels);
}

/// Light that creases reflect into themselves counts as indirect.
TEST(PictureLayers, CorrectionOfAo_IsIndirectLight) {
  const QuadScene scene = quads();
  viewer::RenderOptions options = square(Shading::Ao, size);
  const Layered plain = draw(scene, options);
  EXPECT_EQ(plain.find("indirect.R"), nullptr);
  options.aoCorrection = viewer::AoCorrection::Interreflection;
  const Layered corrected = draw(scene, options);
  expectSum(corrected, "corrected");
  EXPECT_GT(corrected.meanOf("indirect.R"), 0.01);
  EXPECT_NEAR(corrected.meanOf("direct.R"), plain.meanOf("direct.R"), 1e-5);
}

TEST(PictureLayers, Accessibility_IsThatOfTheBake_AndOneWhereNothingIs) {
  QuadScene scene = quads();
  scene.lookFrom({0, 0, 2.5}, {0, 0, 0});
  const Layered layered = draw(scene, square(Shading::Ao, size));
  const PictureChannel* ao = layered.find("ao.Y");
  ASSERT_NE(ao, nullptr);
  EXPECT_NEAR(ao->values[size * (size / 2) + size / 2], 0.6f, 1e-5f);
  EXPECT_EQ(ao->values[0], 1.0f);
  EXPECT_EQ(draw(scene, square(Shading::Phong, size)).find("ao.Y"), nullptr);
}

}  // namespace
}  // namespace prelight
