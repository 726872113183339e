// Horizons by sectors of azimuth, compared with closed forms and with rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "basis/sh_evaluate.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "scene/surface/surface_frame.h"
#include "support/run_bake.h"
#include "support/scenes.h"
#include "techniques/horizons/horizon_bands.h"
#include "techniques/lamp_errors.h"

namespace prelight {
namespace {

using std::numbers::pi;
constexpr int sectors = 8;

BakeRequest horizonsOf(int count, std::uint64_t rays) {
  BakeRequest request;
  request.horizons.sectors = count;
  request.effort.rays = rays;
  return request;
}

/// Mean of f(azimuth) over a sector, by midpoints.
template <typename Function>
double sectorMean(int sector, int count, const Function& f) {
  constexpr int steps = 2000;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) sum += f(2.0 * pi * (sector + (i + 0.5) / steps) / count);
  return sum / steps;
}

TEST(Horizons, OfOpenness_LeaveThatOpen) {
  for (const double open : {0.0, 0.1, 0.5, 0.99, 1.0})
    EXPECT_NEAR(std::pow(std::cos(horizonOfOpenness(open)), 2), open, 1e-12);
  EXPECT_EQ(horizonOfOpenness(1.02), 0.0) << "fits overshoot";
  EXPECT_NEAR(horizonOfOpenness(-0.02), 0.5 * pi, 1e-12);
}

/// Sums of rays in a sector that is blocked from the tangent plane up to a horizon.
SectorRays standing(double open) {
  const double closed = 1.0 - open;
  return {open, closed, 0.5 * closed * closed};
}

TEST(ClosedBands, RaysBeyondTheirBounds_KeepTheMean) {
  const std::array<SectorRays, 4> rays = {
      {{1.2, -0.2, 0.0}, standing(0.9), {-0.1, 1.1, 0.55}, standing(0.4)}};
  std::array<float, 4> feet{}, horizons{};
  closedBands(rays, feet, horizons);
  EXPECT_NEAR(accessibilityOf(feet, horizons), 0.6, 1e-6);
  EXPECT_EQ(horizons[0], 0.0f);
  EXPECT_LT(horizons[1], horizons[3]);
  EXPECT_LT(horizons[3], horizons[2]);
}

/// With few rays, only their ratio shows that a sector is completely open or completely closed.
TEST(ClosedBands, SectorsThatAreAllOpenOrAllClosed_AreExactHoweverManyRaysTheyHad) {
  const std::array<SectorRays, 4> rays = {{{0.7, 0.0, 0.0}, {0.0, 1.3, 0.6}, standing(0.5), standing(0.5)}};
  std::array<float, 4> feet{}, horizons{};
  closedBands(rays, feet, horizons);
  EXPECT_EQ(horizons[0], 0.0f);
  EXPECT_NEAR(horizons[1], 0.5 * pi, 1e-6);
  EXPECT_EQ(feet[1], 0.0f);
}

/// An occluder that hangs from the normal down to some height is a band with a foot at that height. One that
/// stands on the plane has no foot.
TEST(ClosedBands, WhatHangs_HasItsFootWhereItBegins) {
  const double open = 0.36, closed = 1.0 - open;  // Squared sines from 0.36 on are closed.
  const std::array<SectorRays, 3> rays = {
      {{open, closed, closed * (open + 0.5 * closed)}, standing(open), standing(open)}};
  std::array<float, 3> feet{}, horizons{};
  closedBands(rays, feet, horizons);
  EXPECT_NEAR(std::sin(feet[0]), 0.6, 1e-3);
  EXPECT_NEAR(horizons[0], 0.5 * pi, 0.02);
  EXPECT_EQ(feet[1], 0.0f);
  EXPECT_NEAR(std::pow(std::cos(horizons[1]), 2), open, 1e-6);
}

TEST(Horizons, BetweenMiddlesOfSectors_AreLinearAllAround) {
  const std::array<float, 4> angles = {0.1f, 0.2f, 0.3f, 0.6f};
  EXPECT_NEAR(horizonTowards(angles, 0.25 * pi), 0.1, 1e-7);
  EXPECT_NEAR(horizonTowards(angles, 0.5 * pi), 0.15, 1e-7);
  EXPECT_NEAR(horizonTowards(angles, 0.0), 0.35, 1e-7) << "between the last and the first";
  EXPECT_NEAR(horizonTowards(angles, -0.25 * pi), 0.6, 1e-7);
  EXPECT_NEAR(horizonTowards(angles, 6.0 * pi + 0.25 * pi), 0.1, 1e-6);
}

TEST(Horizons, DiskAboveStraightEdge_IsItsSegment) {
  constexpr int steps = 1000;
  for (const double height : {-0.12, -0.05, 0.0, 0.03, 0.2}) {
    int above = 0, inside = 0;
    for (int i = 0; i < steps; ++i)
      for (int j = 0; j < steps; ++j) {
        const double x = 0.1 * (2.0 * (i + 0.5) / steps - 1.0), y = 0.1 * (2.0 * (j + 0.5) / steps - 1.0);
        if (x * x + y * y > 0.01) continue;
        ++inside;
        above += y + height > 0.0;
      }
    EXPECT_NEAR(diskAboveHorizon(height, 0.1), double(above) / inside, 2e-3) << height;
  }
}

TEST(SkyAboveHorizons, EvenSky_IsTheMeanOfOneMinusSquaredSines) {
  const std::array<float, 5> angles = {0.0f, 0.4f, 0.8f, 1.2f, 1.5707963f};
  std::array<glm::dvec3, 9> sky{};
  sky[0] = glm::dvec3(2.0, 1.0, 0.5) * std::sqrt(4.0 * pi);
  double open = 0.0;
  for (const float angle : angles) open += (1.0 - std::pow(std::sin(double{angle}), 2)) / 5.0;
  const glm::dvec3 light =
      skyAboveHorizons(sky, glm::dmat3(surfaceFrame(glm::normalize(glm::vec3(1, -2, 0.5f)))), {}, angles);
  EXPECT_NEAR(light.x, 2.0 * open, 1e-7);
  EXPECT_NEAR(light.z, 0.5 * open, 1e-7);
  EXPECT_NEAR(accessibilityOf({}, angles), open, 1e-12);
}

TEST(SkyAboveHorizons, AnySky_IsTheDoubleIntegral) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  constexpr int rings = 300, turns = 700;
  for (int trial = 0; trial < 3; ++trial) {
    std::array<glm::dvec3, 9> sky;
    for (glm::dvec3& value : sky) value = {number(random), number(random), number(random)};
    std::array<float, 7> angles;
    for (float& angle : angles) angle = static_cast<float>(0.75 * (1.0 + number(random)));
    std::array<float, 7> feet{};
    for (std::size_t s = 0; s < feet.size(); ++s)  // Every second sector has a foot.
      feet[s] = s % 2 == 0 ? 0.0f : static_cast<float>(0.5 * (1.0 + number(random))) * angles[s];
    const glm::dmat3 frame(
        surfaceFrame(glm::normalize(glm::vec3(number(random), number(random), number(random)))));
    double sum = 0.0;
    std::array<double, 9> basis;
    for (int t = 0; t < turns; ++t) {
      const double turn = 2.0 * pi * (t + 0.5) / turns;
      const auto sector = static_cast<std::size_t>(turn / (2.0 * pi) * 7.0);
      const double foot = std::sin(double{feet[sector]}), least = std::sin(double{angles[sector]});
      for (const auto& [from, to] : {std::pair(0.0, foot), std::pair(least, 1.0)})
        for (int r = 0; r < rings; ++r) {
          const double up = from + (to - from) * (r + 0.5) / rings, out = std::sqrt(1.0 - up * up);
          sh::evaluate(frame * glm::dvec3(out * std::cos(turn), out * std::sin(turn), up), 3, basis);
          for (std::size_t i = 0; i < 9; ++i)
            sum += sky[i].y * basis[i] * up * (to - from) / rings * 2.0 * pi / turns;
        }
    }
    EXPECT_NEAR(skyAboveHorizons(sky, frame, feet, angles).y, sum / pi, 2e-5);
  }
}

/// Values of one vertex.
std::span<const float> rowOf(const std::vector<float>& values, std::size_t vertex, std::size_t count) {
  return std::span(values).subspan(vertex * count, count);
}

double accessibilityAt(const Bake& bake, std::size_t vertex, std::size_t count) {
  return accessibilityOf(rowOf(bake.horizons->feet, vertex, count),
                         rowOf(bake.horizons->angles, vertex, count));
}

/// A small square that faces +Y, whose vertices see the horizons of the surroundings.
CompiledScene squareAtTheOrigin() { return test::ground(1, 0.001f); }

/// The plane x = `distance` up to `height`, facing the origin.
CompiledScene wall(float distance, float height) {
  constexpr float far = 2000.0f;
  return test::sceneOf(
      {{distance, 0, -far}, {distance, 0, far}, {distance, height, far}, {distance, height, -far}},
      {{0, 1, 2}, {0, 2, 3}});
}

TEST(HorizonBake, BesideAnEndlessWall_IsItsClosedForm) {
  CompiledScene scene = squareAtTheOrigin();
  test::append(scene, wall(1.0f, 1.5f));
  const Bake bake = test::runBake(scene, horizonsOf(sectors, 1 << 16)).bake;
  const glm::dmat3 frame(surfaceFrame({0, 1, 0}));
  double all = 0.0;
  for (int s = 0; s < sectors; ++s) {
    // cos^2 of the elevation of the wall's top, which is atan(height / distance cos(azimuth from the wall)).
    const double open = sectorMean(s, sectors, [&](double turn) {
      const double towards = frame[0].x * std::cos(turn) + frame[1].x * std::sin(turn);
      return towards > 0.0 ? 1.0 / (1.0 + std::pow(1.5 * towards, 2)) : 1.0;
    });
    for (std::size_t v = 0; v < 4; ++v)
      EXPECT_NEAR(std::pow(std::cos(bake.horizons->angles[v * sectors + s]), 2), open, 0.012) << s;
    all += open / sectors;
  }
  EXPECT_NEAR(all, 0.5 * (1.0 + 1.0 / std::sqrt(1.0 + 1.5 * 1.5)), 1e-6) << "its closed form as a strip";
  EXPECT_NEAR(accessibilityAt(bake, 0, sectors), all, 0.004);
}

TEST(HorizonBake, AtThePitsGround_IsOneAngleAllAround) {
  CompiledScene scene = squareAtTheOrigin();
  std::vector<glm::vec3> rim;
  std::vector<glm::uvec3> walls;
  constexpr unsigned sides = 256;
  for (unsigned i = 0; i < sides; ++i) {
    const double turn = 2.0 * pi * i / sides;
    const glm::vec3 foot(std::cos(turn), -0.01f, std::sin(turn));
    rim.insert(rim.end(), {foot, foot + glm::vec3(0, 0.01f + 0.75f, 0)});
    const unsigned a = 2 * i, b = 2 * ((i + 1) % sides);
    walls.insert(walls.end(), {{a, b, b + 1}, {a, b + 1, a + 1}});
  }
  test::append(scene, test::sceneOf(rim, walls));
  const Bake bake = test::runBake(scene, horizonsOf(5, 1 << 14)).bake;
  ASSERT_EQ(bake.horizons->sectors, 5);
  for (std::size_t i = 0; i < 4 * 5; ++i) EXPECT_NEAR(bake.horizons->angles[i], std::atan(0.75), 0.02) << i;
}

TEST(HorizonBake, OpenPlane_HasNoHorizon) {
  const Bake bake = test::runBake(test::ground(2, 1.0f), horizonsOf(sectors, 64)).bake;
  for (const float angle : bake.horizons->angles) EXPECT_EQ(angle, 0.0f);
}

/// Sectors and accessibility come from the same rays. Fully open and fully closed sectors are exact; the mean
/// deviates where the fit of few rays contradicts them.
TEST(HorizonBake, MeanOfSectors_IsTheAccessibility) {
  Warnings warnings;
  const CompiledScene scene = compileScene(loadScene(makeBuiltinScene("shapes"), warnings), warnings);
  BakeRequest request = horizonsOf(sectors, 128);
  request.ao = true;
  const Bake bake = test::runBake(scene, request).bake;
  std::size_t exact = 0;
  double squares = 0.0;
  for (std::size_t v = 0; v < bake.ao.size(); ++v) {
    const double apart = accessibilityAt(bake, v, sectors) - double{bake.ao[v]};
    exact += std::abs(apart) <= 1e-4 ? 1 : 0;
    squares += apart * apart;
  }
  EXPECT_GT(exact, bake.ao.size() * 98 / 100);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(bake.ao.size())), 0.003);
}

TEST(HorizonBake, LampsOverShapes_AreShadowedNearerToRaysThanByCones) {
  Warnings warnings;
  const CompiledScene scene = compileScene(loadScene(makeBuiltinScene("shapes"), warnings), warnings);
  BakeRequest request = horizonsOf(sectors, 256);
  request.ao = request.cones = true;
  const Bake bake = test::runBake(scene, request).bake;
  const double cones = test::errorOfLamps(scene, [&](std::uint32_t v, const glm::dvec3& way, double cosine) {
    return glm::dot(way, glm::dvec3(bake.bentNormals[v])) > bake.apertures[v] ? cosine : 0.0;
  });
  const double horizons =
      test::errorOfLamps(scene, [&](std::uint32_t v, const glm::dvec3& way, double cosine) {
        const glm::dvec3 local = way * glm::dmat3(surfaceFrame(scene.normals[v]));
        const double turn = std::atan2(local.y, local.x), height = std::asin(local.z);
        // Bands with a foot hide light within their own sector; horizons without a foot are interpolated
        // between sectors.
        std::array<float, sectors> standing{};
        for (std::size_t s = 0; s < standing.size(); ++s)
          standing[s] =
              bake.horizons->feet[v * sectors + s] > 0.0f ? 0.0f : bake.horizons->angles[v * sectors + s];
        const std::size_t own =
            v * sectors +
            std::min<std::size_t>(
                static_cast<std::size_t>((turn < 0.0 ? turn + 2.0 * pi : turn) / (2.0 * pi) * sectors),
                sectors - 1);
        const bool hidden = bake.horizons->feet[own] > 0.0f && height > bake.horizons->feet[own] &&
                            height < bake.horizons->angles[own];
        const bool seen = !hidden && height > horizonTowards(standing, turn);
        return seen ? cosine : 0.0;
      });
  RecordProperty("cones", std::to_string(cones));
  RecordProperty("horizons", std::to_string(horizons));
  EXPECT_LT(horizons, 0.9 * cones);
}

/// A roof hides the sky straight above and leaves it open to the sides.
TEST(HorizonBake, UnderARoof_ClosesAboveAndOpensAside) {
  CompiledScene scene = squareAtTheOrigin();
  test::append(scene, test::ground(1, 1.0f, 1.0f));
  const Bake bake = test::runBake(scene, horizonsOf(4, 1 << 14)).bake;
  EXPECT_NEAR(accessibilityAt(bake, 0, 4), 1.0 - 0.5537, 0.01)
      << "the form factor of a square of 2 m at 1 m stays right";
  for (int s = 0; s < 4; ++s) {
    EXPECT_GT(bake.horizons->feet[s], 0.6f) << "rays below this height are free";
    EXPECT_LT(bake.horizons->feet[s], 0.8f) << "of the roof's edge between 35 and 45 degrees";
    EXPECT_GT(bake.horizons->angles[s], 1.4f) << "and those above it are blocked";
  }
}

/// A lamp at a grazing angle would show even little noise in open sectors.
TEST(HorizonBake, FewRaysAReceiver_LeaveOpenSectorsOpen) {
  CompiledScene scene = squareAtTheOrigin();
  test::append(scene, wall(1.0f, 1.5f));
  const glm::dmat3 frame(surfaceFrame({0, 1, 0}));
  constexpr int seeds = 60;
  double sum = 0.0;
  int count = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    BakeRequest request = horizonsOf(sectors, 256);
    request.seed = static_cast<std::uint64_t>(seed);
    const Bake bake = test::runBake(scene, request).bake;
    for (int s = 0; s < sectors; ++s) {
      const double from = 2.0 * pi * s / sectors, to = 2.0 * pi * (s + 1) / sectors;
      const auto towards = [&](double turn) {
        return frame[0].x * std::cos(turn) + frame[1].x * std::sin(turn);
      };
      if (towards(from) > 0.0 || towards(to) > 0.0) continue;
      for (std::size_t v = 0; v < 4; ++v, ++count)
        sum += std::pow(std::cos(bake.horizons->angles[v * sectors + s]), 2);
    }
  }
  EXPECT_EQ(count, 3 * 4 * seeds) << "sectors that look away from the wall";
  EXPECT_EQ(sum / count, 1.0) << "no ray there was blocked";
}

TEST(HorizonBake, Plan_NamesThemWhereTheyAreAskedFor) {
  const CompiledScene scene = test::ground(1, 1.0f);
  EXPECT_TRUE(makePlan(Scene(), scene, horizonsOf(sectors, 16)).runs(Pass::Horizons));
  BakeRequest request;
  request.ao = true;
  EXPECT_FALSE(makePlan(Scene(), scene, request).runs(Pass::Horizons));
}

}  // namespace
}  // namespace prelight
