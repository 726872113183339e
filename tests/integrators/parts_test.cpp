// The parts that add up to a picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "integrators/global_illumination_renderer.h"
#include "integrators/reference.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/devices.h"
#include "support/materials.h"
#include "support/scenes.h"
#include "support/shot.h"

namespace prelight::test {
namespace {

using Parts = std::vector<PartPicture>;

glm::dvec3 meanOfPart(const Parts& parts, PicturePart part) {
  glm::dvec3 sum(0.0);
  for (const PartPicture& p : parts)
    if (p.part == part)
      for (const glm::vec3& pixel : p.pixels) sum += glm::dvec3(pixel) / double(p.pixels.size());
  return sum;
}

void expectSum(const Picture& picture, const Parts& parts) {
  ASSERT_EQ(parts.size(), tracedParts);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    glm::dvec3 sum(0.0);
    for (const PartPicture& part : parts) sum += glm::dvec3(part.pixels[i]);
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(sum[c], picture.pixels[i][c], 1e-5 * picture.pixels[i][c] + 1e-6) << i << " " << c;
  }
}

struct BuiltinPicture {
  Scene source;
  CompiledScene compiled;

  explicit BuiltinPicture(const char* name) {
    Warnings warnings;
    source = loadScene(makeBuiltinScene(name), warnings);
    compiled = compileScene(source, warnings);
  }

  Picture full(bool parts, GlobalIlluminationPictureReport& report) const {
    GlobalIlluminationPictureRequest request;
    request.width = request.height = 24;
    request.samples = 4;
    request.causticPhotons = 20000;
    request.indirect.photons = 5000;
    request.parts = parts;
    const LitScene lit{compiled, source.images, source.lights};
    Progress progress;
    return renderGlobalIllumination(source, lit, source.cameras.at(0), request, sharedDevice(), progress,
                                    report);
  }
};

TEST(PictureParts, Full_AddUpToThePicture_WhichIsTheSameWithoutThem) {
  const BuiltinPicture scene("caustics");
  GlobalIlluminationPictureReport report, plain;
  const Picture picture = scene.full(true, report), without = scene.full(false, plain);
  EXPECT_EQ(picture.pixels, without.pixels);
  EXPECT_TRUE(plain.parts.empty());
  expectSum(picture, report.parts);
  for (const PicturePart part :
       {PicturePart::Direct, PicturePart::Indirect, PicturePart::Caustic, PicturePart::Reflected})
    EXPECT_GT(meanOfPart(report.parts, part).g, 1e-3) << nameOf(part);
}

/// A room with a crate, lit by a lamp, seen from within.
Shot litRoom(int depth) {
  CompiledScene scene = box(1, glm::vec3(-2.0f), glm::vec3(2.0f), true);
  append(scene, box(1, {-0.5f, -2.0f, -0.5f}, {0.5f, -0.8f, 0.5f}, false));
  scene.triangleFlat.assign(scene.triangles.size(), 1);
  Shot shot = shotOf(std::move(scene), cameraAt({1.6, 0.5, 1.7}, {-0.5, -0.7, -0.5}, 1.2), 12, 64);
  shot.camera.zNear = 1e-3;
  for (CompiledMaterial& material : shot.scene.materials) material = lambert(0.6f);
  Light lamp;
  lamp.intensity = glm::vec3(8.0f);
  lamp.position = {1.2, 1.4, -0.6};
  shot.lights = {lamp};
  shot.request.depth = depth;
  shot.request.parts = true;
  return shot;
}

TEST(PictureParts, PathsInARoom_AreDirectAndIndirectLight) {
  const reference::Film film = litRoom(8).render(), direct = litRoom(2).render();
  const Parts parts = film.partPictures();
  expectSum(film.picture(), parts);
  EXPECT_EQ(meanOfPart(parts, PicturePart::Emitted).g, 0.0) << "a point is not seen";
  EXPECT_EQ(meanOfPart(parts, PicturePart::Caustic).g, 0.0);
  EXPECT_EQ(meanOfPart(parts, PicturePart::Reflected).g, 0.0);
  const MeanAndError expected = meanOf(direct);
  EXPECT_NEAR(meanOfPart(parts, PicturePart::Direct).g, expected.mean,
              1e-3 * expected.mean + 4.0 * expected.error);
  EXPECT_GT(meanOfPart(parts, PicturePart::Indirect).g, 0.1 * expected.mean);
}

/// Light of virtual lights counts as indirect.
TEST(PictureParts, VirtualLights_AreIndirectLight) {
  Shot shot = litRoom(8);
  shot.request.integrator = reference::Integrator::Instant;
  shot.request.samples = 4;
  shot.request.lightPaths = 16;
  const reference::Film film = shot.render();
  const Parts parts = film.partPictures();
  expectSum(film.picture(), parts);
  EXPECT_GT(meanOfPart(parts, PicturePart::Indirect).g, 0.1 * meanOfPart(parts, PicturePart::Direct).g);
  EXPECT_EQ(meanOfPart(parts, PicturePart::Reflected).g, 0.0);
}

/// Glowing walls are seen directly, in a mirror, and on a white floor, as emitted, reflected and direct
/// light.
TEST(PictureParts, GlowOnAMirrorAndOnAFloor_IsReflectedAndDirect) {
  for (const bool mirrors : {true, false}) {
    CompiledScene scene = ground(1, 2.0f);
    scene.materials[0] = mirrors ? metal(0.9f, 0.0f) : lambert(0.5f);
    CompiledScene wall = sceneOf({{-2, 0, -2}, {2, 0, -2}, {2, 3, -2}, {-2, 3, -2}}, {{0, 1, 2}, {0, 2, 3}});
    wall.materials[0] = emitter(glm::vec3(1.5f));
    append(scene, wall);
    scene.triangleFlat.assign(scene.triangles.size(), 1);
    Shot shot = shotOf(std::move(scene), cameraAt({0.0, 1.0, 1.5}, {0.0, 0.3, -1.0}, 1.0), 12, 32);
    shot.request.parts = true;
    const reference::Film film = shot.render();
    const Parts parts = film.partPictures();
    expectSum(film.picture(), parts);
    EXPECT_GT(meanOfPart(parts, PicturePart::Emitted).g, 0.1);
    EXPECT_EQ(meanOfPart(parts, PicturePart::Reflected).g > 0.1, mirrors);
    EXPECT_EQ(meanOfPart(parts, PicturePart::Direct).g > 0.05, !mirrors);
    EXPECT_EQ(meanOfPart(parts, PicturePart::Caustic).g, 0.0);
  }
}

/// Form factor of an upright rectangle at a point in front of the middle of its foot, from its half width,
/// its height and its distance.
double uprightFormFactor(double halfWidth, double height, double distance) {
  const double far = std::hypot(height, distance);
  return (std::atan(halfWidth / distance) - distance / far * std::atan(halfWidth / far)) / std::numbers::pi;
}

/// A glowing wall lights a floor through a mirror: only paths from the floor find this light.
TEST(PictureParts, GlowOffAMirrorOnAFloor_IsACaustic) {
  CompiledScene scene = ground(1, 2.0f);
  scene.materials[0] = lambert(0.5f);
  CompiledScene mirror = sceneOf({{-2, 0, -2}, {2, 0, -2}, {2, 3, -2}, {-2, 3, -2}}, {{0, 1, 2}, {0, 2, 3}});
  mirror.materials[0] = metal(0.9f, 0.0f);
  CompiledScene lamp = sceneOf({{-2, 0, 2}, {2, 0, 2}, {2, 3, 2}, {-2, 3, 2}}, {{0, 2, 1}, {0, 3, 2}});
  lamp.materials[0] = emitter(glm::vec3(1.5f));
  append(scene, mirror);
  append(scene, lamp);
  scene.triangleFlat.assign(scene.triangles.size(), 1);
  Shot shot = shotOf(std::move(scene), cameraAt({0.0, 1.5, 0.2}, {0.0, 0.0, 0.0}, 0.05), 8, 8192);
  shot.request.parts = true;
  const reference::Film film = shot.render();
  const Parts parts = film.partPictures();
  expectSum(film.picture(), parts);
  const double direct = 0.5 * 1.5 * uprightFormFactor(2.0, 3.0, 2.0),
               mirrored = 0.9 * 0.5 * 1.5 * uprightFormFactor(2.0, 3.0, 6.0);
  EXPECT_NEAR(meanOfPart(parts, PicturePart::Direct).g, direct, 0.01 * direct);
  EXPECT_NEAR(meanOfPart(parts, PicturePart::Caustic).g, mirrored, 0.04 * mirrored);
}

}  // namespace
}  // namespace prelight::test
