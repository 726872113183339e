// Pictures through a lens and by an open shutter, against closed forms.
#include "integrators/lens.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "integrators/exposure.h"
#include "prelight/error.h"
#include "scene/pose.h"
#include "support/devices.h"
#include "support/shot.h"

namespace prelight::test {
namespace {

using reference::Film;
using reference::Lens;

constexpr float radiance = 100.0f;
constexpr int size = 64;  // pixels of an edge of the pictures

/// How a picture's light lies about the middle of the picture, in pixels.
struct Spread {
  double total = 0.0;              ///< sum over pixels
  double along = 0.0;              ///< variance in x
  double across = 0.0;             ///< variance in y
  double middle = 0.0, far = 0.0;  ///< means in x and y of the light
};

Spread spreadOf(const Film& film) {
  const Picture picture = film.picture();
  Spread spread;
  const auto add = [&](const std::function<void(double, double, double)>& take) {
    for (int row = 0; row < picture.height; ++row)
      for (int column = 0; column < picture.width; ++column)
        take(column + 0.5, row + 0.5,
             picture.pixels[static_cast<std::size_t>(row * picture.width + column)].y);
  };
  add([&](double x, double y, double light) {
    spread.total += light;
    spread.middle += x * light;
    spread.far += y * light;
  });
  spread.middle /= spread.total;
  spread.far /= spread.total;
  add([&](double x, double y, double light) {
    spread.along += (x - spread.middle) * (x - spread.middle) * light / spread.total;
    spread.across += (y - spread.far) * (y - spread.far) * light / spread.total;
  });
  return spread;
}

/// A bright square of 10 cm, 2 m before a camera that sees 64 pixels per metre at a distance of 1 m.
Shot brightSquare(std::uint64_t samples) {
  Shot shot = shotOf(ground(1, 0.05f), cameraAt({0, 2, 0}, {0, 0, 0}, 2.0 * std::atan(0.5)), size, samples);
  shot.scene.materials[0] = emitter(glm::vec3(radiance));
  shot.request.depth = 1;
  return shot;
}

constexpr double squarePixels = 3.2;  // edge of the square in the picture
/// Variance of the light of a square of this edge about the corner of four pixels, in squared pixels: whole
/// pixels next to the corner and 0.6 of those beyond.
constexpr double sharpVariance = (0.5 * 0.5 + 0.6 * 1.5 * 1.5) / 1.6;
/// Variance of a square that is blurred over many pixels.
constexpr double blurredVariance = (squarePixels * squarePixels + 1.0) / 12.0;

TEST(Lens, SquareOutOfFocus_FillsItsCircleOfConfusionWithTheSameLight) {
  Shot shot = brightSquare(1024);
  shot.request.lens = {0.8, 0.0, 4.0};
  const Film film = shot.render();
  // A lens of radius R that is focused at f spreads a point at z over R |1/z - 1/f| in slopes.
  constexpr double radius = 64.0 * 0.4 * (1.0 / 2.0 - 1.0 / 4.0);
  const Spread spread = spreadOf(film);
  EXPECT_NEAR(spread.total, radiance * squarePixels * squarePixels, 0.02 * spread.total);
  EXPECT_NEAR(spread.along, radius * radius / 4.0 + blurredVariance, 0.02 * spread.along);
  EXPECT_NEAR(spread.across, radius * radius / 4.0 + blurredVariance, 0.02 * spread.across);
  const Picture picture = film.picture();
  double inner = 0.0;
  int pixels = 0;
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const double away = std::hypot(column + 0.5 - size / 2, row + 0.5 - size / 2);
      const float light = picture.pixels[static_cast<std::size_t>(row * size + column)].y;
      if (away > radius + 3.0) {
        EXPECT_EQ(light, 0.0f) << column << ", " << row;
      }
      if (away > radius - 3.0) continue;
      inner += light;
      ++pixels;
    }
  const double even = radiance * squarePixels * squarePixels / (3.14159265358979 * radius * radius);
  EXPECT_NEAR(inner / pixels, even, 0.02 * even);
}

TEST(Lens, PlaneInFocus_IsSharp) {
  Shot shot = brightSquare(1024);
  shot.request.lens = {0.8, 0.0, 2.0};
  const Spread spread = spreadOf(shot.render());
  EXPECT_NEAR(spread.along, sharpVariance, 0.02);
  EXPECT_NEAR(spread.total, radiance * squarePixels * squarePixels, 0.02 * spread.total);
}

TEST(Lens, OrthographicCamera_SpreadsByTheDistanceFromTheFocus) {
  Shot shot = brightSquare(1024);
  shot.camera = orthographicCamera({0, 2, 0}, {0, 0, 0}, 0.5);
  shot.request.lens = {0.2, 0.0, 4.0};
  const double radius = 64.0 * 0.1 * std::abs(1.0 - 2.0 / 4.0), edge = 64.0 * 0.1;
  EXPECT_NEAR(spreadOf(shot.render()).along, radius * radius / 4.0 + (edge * edge + 1.0) / 12.0, 0.1);
}

TEST(Lens, FocusAndApertureLeftOut_AreThoseOfTheMiddleAndTheFNumber) {
  Shot shot = brightSquare(1);
  const Lens focused = reference::focused({0.0, 2.0, std::nullopt}, shot.camera, shot.scene);
  EXPECT_NEAR(*focused.focus, 2.0, 1e-6);
  EXPECT_NEAR(focused.aperture, 0.024 / 2.0, 1e-12) << "12 mm / tan(half the field of view), over 2";
  const Camera below = cameraAt({0, -3, 0}, {0, 0, 0}, 1.0);
  EXPECT_EQ(reference::depthInMiddle(below, shot.scene), std::nullopt) << "backs are not shown";
  shot.scene.materials[0].doubleSided = true;
  EXPECT_NEAR(reference::depthInMiddle(below, shot.scene).value(), 3.0, 1e-6);
  EXPECT_EQ(
      *reference::focused({0.1, 0.0, std::nullopt}, cameraAt({0, 2, 0}, {0, 4, 0}, 1.0), shot.scene).focus,
      reference::infiniteFocus);
  EXPECT_THROW(
      reference::focused({0.0, 2.0, std::nullopt}, orthographicCamera({0, 2, 0}, {0, 0, 0}, 1.0), shot.scene),
      UsageError);
}

TEST(MomentOfPass, FirstPasses_DivideTheTimeEvenlyAndSeedsShiftThem) {
  for (const std::size_t passes : {2u, 8u, 64u}) {
    std::vector<double> moments;
    for (std::size_t pass = 0; pass < passes; ++pass) moments.push_back(reference::momentOfPass(pass, 7));
    std::sort(moments.begin(), moments.end());
    EXPECT_GE(moments.front(), 0.0);
    EXPECT_LT(moments.back(), 1.0);
    for (std::size_t i = 1; i < passes; ++i)
      EXPECT_NEAR(moments[i] - moments[i - 1], 1.0 / double(passes), 1e-12);
  }
  EXPECT_NE(reference::momentOfPass(0, 0), reference::momentOfPass(0, 1));
}

constexpr double speed = 0.5;       // m/s
constexpr double edge = 0.05;       // m
constexpr double perMetre = 64.0;   // pixels
constexpr double exposedFor = 0.8;  // s

/// A bright square below an orthographic camera, one of which moves along x.
class MovingSquare {
 public:
  explicit MovingSquare(bool cameraMoves) {
    Material bright;
    bright.baseColor = {0, 0, 0, 1};
    bright.metallic = bright.specular = 0.0f;
    bright.emission = glm::vec3(radiance);
    scene_.materials.push_back(bright);
    const auto half = static_cast<float>(0.5 * edge);
    Primitive square;
    square.positions = {{-half, 0, half}, {half, 0, half}, {half, 0, -half}, {-half, 0, -half}};
    square.triangles = {{0, 1, 2}, {0, 2, 3}};
    square.material = 0;
    scene_.meshes.push_back({"square", {square}});
    scene_.nodes.resize(2);
    MeshNode node;
    node.transforms = {glm::dmat4(1.0)};
    scene_.meshNodes.push_back(node);
    Camera camera = orthographicCamera({0, 2, 0}, {0, 0, 0}, 0.5);
    camera.sceneNode = 1;
    scene_.nodes[1].hasMatrix = false;
    scene_.nodes[1].rotation = glm::dquat(glm::dmat3(camera.world));
    scene_.nodes[1].translation = {0, 2, 0};
    scene_.cameras.push_back(camera);
    const double way = 2.0 * speed, y = cameraMoves ? 2.0 : 0.0;
    Animation animation{"slide", {}, {{cameraMoves ? std::size_t{1} : 0u, AnimatedPath::Translation, 0}}};
    animation.samplers.push_back(
        {Interpolation::Linear, {0, 2}, {glm::vec4(-0.25 * way, y, 0, 0), glm::vec4(0.75 * way, y, 0, 0)}});
    scene_.animations.push_back(animation);
    setPose(scene_, 0, 0.2);
  }

  Film expose(double shutter, std::uint64_t samples) {
    Warnings warnings;
    Shot shot = shotOf(compileScene(scene_, warnings), scene_.cameras[0], size, samples);
    shot.request.depth = 1;
    shot.request.shutter = shutter;
    reference::ReferenceInputs inputs = shot.inputs();
    reference::Exposure exposure(scene_, inputs, {false, 0}, shot.request);
    inputs.ofPass = [&](std::uint64_t pass) -> const reference::ReferenceInputs& {
      return exposure.ofPass(pass);
    };
    Film film(size, size);
    Progress progress;
    reference::ReferenceReport report;
    reference::renderReference(inputs, shot.request, sharedDevice(), progress, film, report);
    return film;
  }

 private:
  Scene scene_;
};

TEST(Exposure, MovingSquare_LeavesAStreakOfItsWayAndItsLight) {
  for (const bool cameraMoves : {false, true}) {
    MovingSquare square(cameraMoves);
    const Spread still = spreadOf(square.expose(0.0, 256)), moved = spreadOf(square.expose(exposedFor, 1024));
    constexpr double way = perMetre * speed * exposedFor, wide = perMetre * edge;
    EXPECT_NEAR(moved.total, radiance * wide * wide, 0.01 * moved.total);
    EXPECT_NEAR(moved.along, (way * way + wide * wide + 1.0) / 12.0, 0.02 * moved.along);
    EXPECT_NEAR(moved.across, sharpVariance, 0.02);
    EXPECT_NEAR(moved.middle - still.middle, (cameraMoves ? -0.5 : 0.5) * way, 0.02 * way);
  }
}

TEST(Exposure, ShutterAndGuides_ExcludeEachOther) {
  Shot shot = brightSquare(1);
  shot.request.guides = true;
  reference::ReferenceInputs inputs = shot.inputs();
  inputs.ofPass = [&](std::uint64_t) -> const reference::ReferenceInputs& { return inputs; };
  Film film(size, size);
  Progress progress;
  reference::ReferenceReport report;
  EXPECT_THROW(reference::renderReference(inputs, shot.request, sharedDevice(), progress, film, report),
               UsageError);
}

}  // namespace
}  // namespace prelight::test
