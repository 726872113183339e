#include "charts/light_map_bake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "charts/direct_light.h"
#include "charts/layout_places.h"
#include "charts/light_map_lookup.h"
#include "receivers/sampling.h"
#include "support/devices.h"
#include "support/scenes.h"
#include "techniques/light_map/light_map_parts.h"

namespace prelight {
namespace {

using test::layoutOf;
using test::positionOf;

LightMap bake(const CompiledScene& scene, double texelSize, std::uint32_t rays = 64, std::uint64_t seed = 0) {
  Tracer tracer(scene, test::sharedDevice());
  test::DirectLight direct(scene, tracer, rays, seed);
  LightMapBake made(scene, tracer, layoutOf(scene, texelSize), 1);
  LightMapPart* parts[] = {&direct};
  Progress progress;
  made.run(parts, progress);
  LightMapReport report;
  return made.finish(usualCreaseAngle, report);
}

Light pointLight(const glm::dvec3& position, const glm::vec3& intensity) {
  Light light;
  light.position = position;
  light.intensity = intensity;
  return light;
}

TEST(LightMapBake, PointLight_FollowsTheInverseSquare) {
  CompiledScene scene = test::ground(4, 1.0f);
  scene.lights = {pointLight({0.2, 1.0, -0.3}, {3.0f, 2.0f, 0.0f})};
  // Light changes too little between texels for any of them to be refined.
  const LightMap map = bake(scene, 0.01);
  for (const LightMapTexel& texel : map.layout.texels) {
    const glm::dvec3 way = glm::dvec3(0.2, 1.0, -0.3) - positionOf(scene, texel);
    const double expected = way.y / std::pow(glm::length(way), 3.0);
    const float* values = &map.values[3 * std::size_t{texel.texel}];
    ASSERT_NEAR(values[0], 3.0 * expected, 1e-4);
    ASSERT_NEAR(values[1], 2.0 * expected, 1e-4);
    ASSERT_EQ(values[2], 0.0f);
  }
}

/// A ground, a sun above it, and a board of half side 0.2 m that is turned about the vertical axis.
CompiledScene boardOverGround(double angle) {
  CompiledScene scene = test::ground(4, 1.0f);
  CompiledScene board = test::box(1, {-0.2f, 0.4f, -0.2f}, {0.2f, 0.5f, 0.2f}, false);
  for (glm::vec3& p : board.positions)
    p = {std::cos(angle) * p.x - std::sin(angle) * p.z, p.y, std::sin(angle) * p.x + std::cos(angle) * p.z};
  test::append(scene, board);
  Light sun;
  sun.type = LightType::Directional;
  sun.direction = {0.0, -1.0, 0.0};
  sun.intensity = glm::vec3(5.0f);
  scene.lights = {sun};
  return scene;
}

/// Distance of a point from the board's shadow in metres; negative inside.
double outsideShadow(const glm::dvec3& p, double angle) {
  const double x = std::cos(angle) * p.x + std::sin(angle) * p.z,
               z = std::cos(angle) * p.z - std::sin(angle) * p.x;
  return std::max(std::abs(x), std::abs(z)) - 0.2;
}

/// Share of a square of the ground that lies outside the shadow, by a fine grid.
double litShare(const glm::dvec3& middle, double side, double angle) {
  constexpr int fine = 64;
  int lit = 0;
  for (int i = 0; i < fine; ++i)
    for (int k = 0; k < fine; ++k) {
      const glm::dvec3 p = middle + side * glm::dvec3((i + 0.5) / fine - 0.5, 0.0, (k + 0.5) / fine - 0.5);
      if (outsideShadow(p, angle) > 0.0) ++lit;
    }
  return double(lit) / (fine * fine);
}

TEST(LightMapBake, Shadow_CoversTexelsByTheirShare) {
  for (const double angle : {0.0, 0.4}) {
    const LightMap map = bake(boardOverGround(angle), 0.05);
    int partly = 0;
    for (const LightMapTexel& texel : map.layout.texels) {
      if (texel.face >= 32) continue;  // Skips the board.
      const glm::dvec3 p = positionOf(boardOverGround(angle), texel);
      const double share = litShare(p, 0.05 * TexelCells::side, angle),
                   found = map.values[3 * std::size_t{texel.texel}] / 5.0;
      if (share == 0.0 || share == 1.0) {
        ASSERT_NEAR(found, share, 1e-5) << p.x << " " << p.z;
        continue;
      }
      ++partly;
      ASSERT_NEAR(found, share, 0.13) << p.x << " " << p.z;  // An error of two of the sixteen places.
    }
    EXPECT_GT(partly, 28);
  }
}

/// Rms error of look-ups within a texel of a shadow's edge, at places that are no texel centres, relative to
/// the light outside the shadow. If a texel were lit or black as its centre is, the error would be sqrt(1/12)
/// = 0.289 for an edge along rows and more for other edges; for means over cells it is 0.251.
TEST(LightMapBake, EdgeOfAShadow_IsSmooth) {
  const double angle = 0.4;
  const CompiledScene scene = boardOverGround(angle);
  const LightMap map = bake(scene, 0.05);
  double squares = 0.0, count = 0.0;
  for (std::uint32_t face = 0; face < 32; ++face)
    for (std::uint32_t i = 0; i < 4096; ++i) {
      const glm::dvec2 b = sampling::uniformTriangle(sampling::sobol(i, face));
      const LightMapTexel place{0, face, static_cast<float>(b.x), static_cast<float>(b.y)};
      const double outside = outsideShadow(positionOf(scene, place), angle);
      if (std::abs(outside) > 0.05) continue;  // Keeps a texel on each side of the edge.
      const double shown = lightMapIrradiance(map, face, b.x, b.y).x / 5.0, truth = outside > 0.0 ? 1.0 : 0.0;
      squares += (shown - truth) * (shown - truth);
      count += 1.0;
    }
  ASSERT_GT(count, 1000.0);
  EXPECT_LT(std::sqrt(squares / count), 0.255);
}

/// A square of side 2 a at height h above a point below its centre gives E = L F pi, with the form factor F =
/// 4 / (2 pi) [...] of two perpendicular pairs of corners (Howell C-2, a corner's rectangle four times).
TEST(LightMapBake, Emitter_FollowsTheFormFactor) {
  constexpr double a = 0.5, h = 1.0;
  CompiledScene scene = test::ground(4, 1.0f);
  CompiledScene lamp = test::ground(1, static_cast<float>(a), static_cast<float>(h));
  for (glm::uvec3& t : lamp.triangles) std::swap(t.y, t.z);
  test::append(scene, lamp);
  scene.materials.push_back(scene.materials[0]);
  const auto emissive = static_cast<std::uint32_t>(scene.materials.size() - 1);
  scene.materials[emissive].emission = glm::vec3(10.0f);
  for (std::size_t t = scene.triangleMaterials.size() - 2; t < scene.triangleMaterials.size(); ++t)
    scene.triangleMaterials[t] = emissive;
  const LightMap map = bake(scene, 0.1, 1024);
  const double x = a / h, root = std::sqrt(1.0 + x * x);
  const double factor = 4.0 / (2.0 * std::numbers::pi) * 2.0 * (x / root * std::atan(x / root));
  // The mean is taken over the four texels around the centre.
  double sum = 0.0, count = 0.0;
  for (const LightMapTexel& texel : map.layout.texels) {
    const glm::dvec3 p = positionOf(scene, texel);
    if (texel.face >= 32 || std::hypot(p.x, p.z) > 0.11) continue;
    sum += map.values[3 * std::size_t{texel.texel}];
    ++count;
  }
  ASSERT_GE(count, 1.0);
  EXPECT_NEAR(sum / count / (10.0 * std::numbers::pi * factor), 1.0, 0.02);
}

/// An even sky over a plane gives E = pi L in the open, and none under a roof that covers everything.
TEST(LightMapBake, EvenSky_GivesPiTimesItsRadiance) {
  CompiledScene scene = test::ground(2, 1.0f);
  scene.materials[0].doubleSided = true;
  const Environment sky = constantEnvironment({0.5f, 1.0f, 2.0f});
  Tracer tracer(scene, test::sharedDevice());
  SkyLightPart part(scene, tracer, sky, 0.0, 256, 0);
  LightMapBake made(scene, tracer, layoutOf(scene, 0.2), 1);
  LightMapPart* parts[] = {&part};
  Progress progress;
  made.run(parts, progress);
  LightMapReport report;
  const LightMap map = made.finish(usualCreaseAngle, report);
  for (const LightMapTexel& texel : map.layout.texels) {
    const float* values = &map.values[3 * std::size_t{texel.texel}];
    ASSERT_NEAR(values[0], 0.5 * std::numbers::pi, 0.02);
    ASSERT_NEAR(values[1], 1.0 * std::numbers::pi, 0.04);
    ASSERT_NEAR(values[2], 2.0 * std::numbers::pi, 0.08);
  }
}

TEST(LightMapBake, BackOfATwoSidedSurface_HasItsOwnLight) {
  CompiledScene scene = test::ground(2, 1.0f);
  scene.materials[0].doubleSided = true;
  scene.lights = {pointLight({0.0, -1.0, 0.0}, glm::vec3(1.0f))};
  const LightMap map = bake(scene, 0.1);
  double front = 0.0, back = 0.0;
  for (const LightMapTexel& texel : map.layout.texels)
    (texel.face < scene.triangleCount() ? front : back) += map.values[3 * std::size_t{texel.texel}];
  EXPECT_EQ(front, 0.0);
  EXPECT_GT(back, 10.0);
}

/// Texels under a box that stands on the ground see the box's inside; they must not darken the texels around
/// it.
TEST(LightMapBake, TexelsInsideObjects_TakeAfterTheirNeighbours) {
  CompiledScene scene = test::ground(4, 1.0f);
  test::append(scene, test::box(1, {-0.32f, -0.1f, -0.32f}, {0.32f, 0.5f, 0.32f}, false));
  scene.lights = {pointLight({0.0, 50.0, 0.0}, glm::vec3(2500.0f))};
  const LightMap map = bake(scene, 0.1);
  for (const LightMapTexel& texel : map.layout.texels) {
    if (texel.face >= 32) continue;
    ASSERT_NEAR(map.values[3 * std::size_t{texel.texel}], 1.0, 0.02);
  }
}

TEST(LightMapBake, TexelsInsideObjects_TakeAfterWhatAFilterLeft) {
  CompiledScene scene = test::ground(4, 1.0f);
  test::append(scene, test::box(1, {-0.32f, -0.1f, -0.32f}, {0.32f, 0.5f, 0.32f}, false));
  scene.lights = {pointLight({0.0, 50.0, 0.0}, glm::vec3(2500.0f))};
  Tracer tracer(scene, test::sharedDevice());
  test::DirectLight direct(scene, tracer, 64, 0);
  LightMapBake made(scene, tracer, layoutOf(scene, 0.1), 1);
  LightMapPart* parts[] = {&direct};
  Progress progress;
  made.run(parts, progress);
  LightMapReport report;
  const LightMap map = made.finish(usualCreaseAngle, report, [&](LightMap& filtered) {
    for (const LightMapTexel& texel : filtered.layout.texels) {
      const glm::dvec3 place = positionOf(scene, texel);
      const bool under = std::max(std::abs(place.x), std::abs(place.z)) < 0.31;
      filtered.values[3 * std::size_t{texel.texel}] = under ? 100.0f : 4.0f;
    }
  });
  ASSERT_GT(report.hidden, 20u);
  for (const LightMapTexel& texel : map.layout.texels) {
    if (texel.face >= 32) continue;
    ASSERT_EQ(map.values[3 * std::size_t{texel.texel}], 4.0f);
  }
}

/// Under a sky without lamps, texels under the box are dark and do not darken the texels around it.
TEST(LightMapBake, TexelsInsideObjects_TakeAfterTheirNeighboursUnderASky) {
  CompiledScene scene = test::ground(4, 1.0f);
  test::append(scene, test::box(1, {-0.32f, -0.1f, -0.32f}, {0.32f, 0.001f, 0.32f}, false));
  const Environment sky = constantEnvironment(glm::vec3(1.0f));
  Tracer tracer(scene, test::sharedDevice());
  InsidePart inside(scene, tracer, 0);
  SkyLightPart light(scene, tracer, sky, 0.0, 256, 0);
  LightMapBake made(scene, tracer, layoutOf(scene, 0.1), 1);
  LightMapPart* parts[] = {&inside, &light};
  Progress progress;
  made.run(parts, progress);
  LightMapReport report;
  const LightMap map = made.finish(usualCreaseAngle, report);
  EXPECT_GT(report.hidden, 20u);
  for (const LightMapTexel& texel : map.layout.texels) {
    if (texel.face >= 32) continue;
    ASSERT_NEAR(map.values[3 * std::size_t{texel.texel}], std::numbers::pi, 0.1);
  }
}

TEST(LightMapBake, SameSeed_GivesTheSame_AnotherSeedAnother) {
  CompiledScene scene = test::ground(2, 1.0f);
  CompiledScene lamp = test::ground(1, 0.5f, 1.0f);
  for (glm::uvec3& t : lamp.triangles) std::swap(t.y, t.z);
  test::append(scene, lamp);
  scene.materials.back().emission = scene.materials.back().emission = glm::vec3(1.0f);
  test::append(scene, test::box(1, {-0.2f, 0.4f, -0.2f}, {0.2f, 0.5f, 0.2f}, false));
  const std::vector<float> first = bake(scene, 0.1, 64, 0).values;
  EXPECT_EQ(first, bake(scene, 0.1, 64, 0).values);
  EXPECT_NE(first, bake(scene, 0.1, 64, 1).values);
}

/// A part that casts rays before it is asked for texels, as photons do.
class EarlyPart final : public LightMapPart {
 public:
  void add(std::span<const LightMapTexel> texels, int, std::span<float>, std::span<std::uint8_t>) override {
    rays_ += texels.size();
  }
  std::uint64_t rays() const override { return rays_; }

 private:
  std::uint64_t rays_ = 1000;
};

TEST(LightMapBake, RaysBeforeTheRun_AreNotCounted) {
  const CompiledScene scene = test::ground(1, 1.0f);
  Tracer tracer(scene, test::sharedDevice());
  EarlyPart part;
  LightMapPart* parts[] = {&part};
  LightMapBake made(scene, tracer, layoutOf(scene, 0.1), 1);
  Progress progress;
  made.run(parts, progress);
  LightMapReport report;
  const LightMap map = made.finish(usualCreaseAngle, report);
  EXPECT_EQ(report.rays, map.layout.texels.size());
  EXPECT_EQ(made.rays(), report.rays);
}

class StopAfter : public Progress {
 public:
  explicit StopAfter(int polls) : left_(polls) {}
  bool stopRequested() const override { return left_-- <= 0; }

 private:
  mutable int left_;
};

/// Result of a bake that is stopped when it asks for the `polls`-th time whether to stop, saved, loaded and
/// continued.
LightMap bakeInterrupted(const CompiledScene& scene, double texelSize, int polls, bool& interrupted) {
  Tracer tracer(scene, test::sharedDevice());
  test::DirectLight direct(scene, tracer, 16, 0);
  LightMapPart* parts[] = {&direct};
  const LightMapLayout layout = layoutOf(scene, texelSize);
  LightMapBake first(scene, tracer, layout, 1);
  StopAfter stop(polls);
  interrupted = false;
  try {
    first.run(parts, stop);
  } catch (const Interrupted&) {
    interrupted = true;
  }
  StateWriter state;
  first.save(state);
  const std::vector<std::byte> payload(state.payload().begin(), state.payload().end());
  StateReader reader("state", payload);
  LightMapBake second(scene, tracer, layout, 1);
  second.load(reader);
  Progress progress;
  second.run(parts, progress);
  LightMapReport report;
  return second.finish(usualCreaseAngle, report);
}

TEST(LightMapBake, Interrupted_GoesOnToTheSame) {
  const CompiledScene scene = boardOverGround(0.4);
  const std::vector<float> expected = bake(scene, 0.01, 16).values;
  bool interrupted = true;
  int polls = 0;
  for (; interrupted; ++polls)  // Stops in every block of texels, and in every block of refined ones.
    EXPECT_EQ(bakeInterrupted(scene, 0.01, polls, interrupted).values, expected) << polls;
  EXPECT_GT(polls, 11);
}

}  // namespace
}  // namespace prelight
