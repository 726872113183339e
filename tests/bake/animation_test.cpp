#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "bake/animated_bake.h"
#include "bake/baker.h"
#include "bake/key_choice.h"
#include "bake/make_plan.h"
#include "basis/sh.h"
#include "compress/compression_error.h"
#include "compress/small_floats.h"
#include "prelight/error.h"
#include "scene/builtin/builtin.h"
#include "scene/deform.h"
#include "scene/gltf/load/loader.h"
#include "scene/pose.h"
#include "support/bent_bar.h"
#include "support/devices.h"
#include "techniques/near_lamps/posed_shells.h"
#include "techniques/sh/animated_transfer.h"
#include "techniques/sh/vertex_turns.h"

namespace prelight {
namespace {

/// Chooses keys of a curve of numbers; the difference is the distance of the curve from a chord.
struct Curve {
  std::function<double(double)> value;
  std::map<double, int> bakes = {};

  ChosenKeys<double> choose(double error, int most = 1024, std::vector<double> moments = {}) {
    const KeyOperations<double> operations{
        [&](double t) {
          ++bakes[t];
          return value(t);
        },
        [](double first, double a, double last, double b, double t, double baked) {
          const double blend = (t - first) / (last - first);
          return std::abs(baked - ((1.0 - blend) * a + blend * b));
        }};
    KeyRequest request;
    request.error = error;
    request.mostKeys = most;
    request.moments = std::move(moments);
    return chooseKeys(0.0, 8.0, request, operations);
  }
};

TEST(ChooseKeys, StraightMotion_NeedsOnlyTheEnds) {
  Curve line{[](double t) { return 3.0 * t; }};
  const ChosenKeys<double> chosen = line.choose(1e-9);
  EXPECT_EQ(chosen.times, (std::vector<double>{0.0, 8.0}));
  EXPECT_LE(chosen.error, 1e-9);
}

TEST(ChooseKeys, ErrorInOneInterval_GetsItsKeysThere) {
  // The curve is at rest but for a bump between 5 s and 6 s, which neither the middle nor a quarter of the 8
  // s shows.
  Curve bump{[](double t) { return t > 5.0 && t < 6.0 ? std::sin((t - 5.0) * 3.14159265358979) : 0.0; }};
  const ChosenKeys<double> chosen = bump.choose(0.02, 1024, {1.0, 5.5});
  const auto inside =
      std::count_if(chosen.times.begin(), chosen.times.end(), [](double t) { return t >= 5.0 && t <= 6.0; });
  const double within = static_cast<double>(inside) / 1.0;
  const double elsewhere = (static_cast<double>(chosen.times.size()) - within) / 7.0;
  EXPECT_GT(within, 3.0 * elsewhere) << "keys a second";
  EXPECT_LE(chosen.error, 0.02);
}

TEST(ChooseKeys, ThereAndBack_IsNotTakenForRest) {
  // The wave is zero at both ends and in the middle.
  Curve wave{[](double t) { return std::sin(t * 3.14159265358979 / 4.0); }};
  EXPECT_GE(wave.choose(0.1).times.size(), 5u);
}

TEST(ChooseKeys, KeysGivenBack_AreTheBakesAndNoneIsMadeTwice) {
  Curve curve{[](double t) { return t * t; }};
  const ChosenKeys<double> chosen = curve.choose(0.1);
  for (std::size_t k = 0; k < chosen.times.size(); ++k)
    EXPECT_EQ(chosen.keys[k], chosen.times[k] * chosen.times[k]);
  for (const auto& [time, count] : curve.bakes) EXPECT_EQ(count, 1) << time;
  // Over a stretch h the chord of t^2 lies at most h^2 / 4 above the curve, in the middle.
  for (std::size_t k = 1; k < chosen.times.size(); ++k) {
    const double h = chosen.times[k] - chosen.times[k - 1];
    EXPECT_LE(0.25 * h * h, 0.1);
  }
}

TEST(ChooseKeys, MostKeys_StopTheCuttingAndTellTheErrorLeft) {
  Curve curve{[](double t) { return t * t; }};
  const ChosenKeys<double> chosen = curve.choose(1e-6, 3);
  EXPECT_EQ(chosen.times, (std::vector<double>{0.0, 4.0, 8.0}));
  EXPECT_DOUBLE_EQ(chosen.error, 4.0);
}

TEST(EvenTimes, Ends_AreExact) {
  EXPECT_EQ(evenTimes(0.5, 2.5, 3), (std::vector<double>{0.5, 1.5, 2.5}));
  EXPECT_EQ(evenTimes(0.0, 0.7, 8).back(), 0.7);
  EXPECT_EQ(evenTimes(1.0, 1.0, 5), (std::vector<double>{1.0}));
  EXPECT_EQ(evenTimes(1.0, 2.0, 1), (std::vector<double>{1.0}));
}

TEST(RotationOf, RotationTimesStretch_GivesTheRotation) {
  const glm::dmat4 rotation = glm::rotate(glm::dmat4(1.0), 1.1, glm::dvec3(0.6, 0.0, 0.8));
  glm::dmat4 stretch(1.0);
  stretch[0] = {2.0, 0.3, 0.1, 0.0};  // Symmetric and positive definite.
  stretch[1] = {0.3, 1.0, 0.2, 0.0};
  stretch[2] = {0.1, 0.2, 5.0, 0.0};
  const glm::dmat3 got = rotationOf(rotation * stretch);
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) EXPECT_NEAR(got[c][r], rotation[c][r], 1e-12);
  EXPECT_EQ(rotationOf(glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, 0.0, 1.0))), glm::dmat3(1.0));
  EXPECT_EQ(rotationOf(glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, -1.0, 1.0))), glm::dmat3(1.0));
}

class AnimatedScene : public ::testing::Test {
 protected:
  AnimatedScene() {
    Warnings warnings;
    scene = loadScene(makeBuiltinScene("swing"), warnings);
    compiled = compileScene(scene, warnings);
  }

  CompiledScene compiledAt(double seconds) const {
    Warnings warnings;
    return compileScene(sceneAt(scene, 0, seconds), warnings);
  }

  /// Transfer of every vertex when nothing surrounds it.
  static Bake openBakeOf(const CompiledScene& posed, int order) {
    Bake bake;
    bake.sh = openTransferOf(posed, order);
    return bake;
  }

  static HarmonicTransfer openTransferOf(const CompiledScene& posed, int order) {
    HarmonicTransfer transfer{order, 1, 0, {}};
    std::vector<double> row(static_cast<std::size_t>(order * order));
    for (const glm::vec3& normal : posed.normals) {
      sh::openTransfer(glm::normalize(glm::dvec3(normal)), order, row);
      transfer.coefficients.insert(transfer.coefficients.end(), row.begin(), row.end());
    }
    return transfer;
  }

  AnimatedTransfer openKeys(const std::vector<double>& times) const {
    AnimatedTransfer animated{0, times, {}};
    for (const double time : times) animated.keys.push_back(openTransferOf(compiledAt(time), 4));
    return animated;
  }

  Scene scene;
  CompiledScene compiled;
};

TEST_F(AnimatedScene, TransferAtKeys_IsExactlyTheirs) {
  const AnimatedTransfer animated = openKeys({0.0, 1.3, 4.0});
  for (const KeyMix mix : {KeyMix::Linear, KeyMix::Turned})
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(transferAt(animated, scene, compiled, animated.times[k], mix).coefficients,
                animated.keys[k].coefficients);
  EXPECT_EQ(transferAt(animated, scene, compiled, 9.0).coefficients, animated.keys[2].coefficients);
}

TEST_F(AnimatedScene, LinearMix_IsTheWeightedMean) {
  const AnimatedTransfer animated = openKeys({0.0, 1.0});
  const HarmonicTransfer mixed = transferAt(animated, scene, compiled, 0.25, KeyMix::Linear);
  for (std::size_t i = 0; i < mixed.coefficients.size(); ++i)
    ASSERT_NEAR(mixed.coefficients[i],
                0.75 * animated.keys[0].coefficients[i] + 0.25 * animated.keys[1].coefficients[i], 1e-6);
}

TEST_F(AnimatedScene, TurnedMixOfOpenSurfaces_IsExact) {
  // The closed form of each vertex depends on its normal alone. Rotating the keys reproduces it exactly;
  // blending them alone does not.
  const AnimatedTransfer animated = openKeys({0.0, 1.0});
  const CompiledScene there = compiledAt(0.4);
  const HarmonicTransfer exact = openTransferOf(there, 4);
  const auto error = [&](KeyMix mix) {
    return compressionError(exact, transferAt(animated, scene, compiled, 0.4, mix), surfaceOfVertices(there))
        .vectorRms;
  };
  EXPECT_LT(error(KeyMix::Turned), 1e-6);
  EXPECT_GT(error(KeyMix::Linear), 0.01);
}

/// Each vertex of a bar that bends by a quarter turn has a lobe about its normal. The lobe turns with the
/// vertex, and by half the angle where both joints have half the weight. Half way, both keys give the same
/// lobe.
TEST(SkinnedTransfer, VerticesTurnByTheirOwnJoints) {
  Warnings warnings;
  const Scene scene = loadScene(test::bentBar(), warnings);
  const CompiledScene compiled = compileScene(scene, warnings);
  const auto keyAt = [](double quarter) {
    HarmonicTransfer transfer;
    transfer.order = 2;
    transfer.channels = 1;
    for (const glm::vec3& p : test::barPositions()) {
      const double angle = quarter * 1.57079632679489662 * double(p.y) / 2.0;
      transfer.coefficients.insert(transfer.coefficients.end(), {0.5f, static_cast<float>(std::sin(angle)),
                                                                 0.0f, static_cast<float>(std::cos(angle))});
    }
    return transfer;
  };
  const AnimatedTransfer animated{0, {0.0, 1.0}, {keyAt(0.0), keyAt(1.0)}};
  const HarmonicTransfer half = transferAt(animated, scene, compiled, 0.5);
  const HarmonicTransfer expected = keyAt(0.5);
  for (std::size_t i = 0; i < expected.coefficients.size(); ++i)
    EXPECT_NEAR(half.coefficients[i], expected.coefficients[i], 1e-6) << i;
}

/// Shells are mixed as transfer is: those of what turns turn along.
TEST_F(AnimatedScene, NearLamps_BetweenKeysAreMixedLikeTransfer) {
  AnimatedTransfer animated{0, {0.0, 1.0}, {}};
  for (const double time : animated.times) {
    HarmonicTransfer key = openTransferOf(compiledAt(time), 3);
    NearLampTransfer shells{3, 1, 0.1, 10.0, {}};
    for (float& value : key.coefficients) {
      shells.halves.push_back(toHalf(value));
      value = fromHalf(shells.halves.back());
    }
    animated.keys.push_back(key);
    animated.nearLamps.push_back(shells);
  }
  const NearLampTransfer half = *nearLampsAt(animated, scene, compiled, 0.5);
  const HarmonicTransfer expected = transferAt(animated, scene, compiled, 0.5);
  for (std::size_t i = 0; i < expected.coefficients.size(); ++i)
    EXPECT_NEAR(fromHalf(half.halves[i]), expected.coefficients[i], 1e-3) << i;
}

TEST_F(AnimatedScene, Bake_AgreesWithBakesOfThePoses) {
  const Device& device = test::sharedDevice();
  BakeRequest request;
  request.sh.order = 2;
  request.effort.rays = 4;
  request.bounces = 1;
  request.ch.order = 3;
  request.nearLamps.shells = 3;
  const auto bakeOf = [&](const Scene& posed) {
    Warnings warnings;
    Progress progress;
    BakeReport report;
    const CompiledScene flat = compileScene(posed, warnings);
    return bakeScene(flat, request, makePlan(posed, flat, request), device, progress, report);
  };
  KeyRequest keys;
  keys.count = 3;
  Progress progress;
  AnimationReport report;
  const Bake rest = bakeOf(scene);
  const AnimatedTransfer animated =
      bakeAnimation(scene, compiled, 0, request, keys, rest, device, progress, report);
  EXPECT_EQ(animated.times, (std::vector<double>{0.0, 2.0, 4.0}));
  EXPECT_EQ(animated.keys[0].coefficients, rest.sh->coefficients) << "the animation begins at rest";
  request.nearLamps.farthest = rest.nearLamps->farthest;
  const Bake later = bakeOf(sceneAt(scene, 0, 2.0));
  EXPECT_EQ(animated.keys[1].coefficients, later.sh->coefficients);
  ASSERT_EQ(animated.nearLamps.size(), 3u);
  EXPECT_EQ(animated.nearLamps[0].halves, rest.nearLamps->halves);
  EXPECT_EQ(animated.nearLamps[1].halves, later.nearLamps->halves);
  EXPECT_EQ(animated.nearLamps[1].farthest, rest.nearLamps->farthest);
  EXPECT_EQ(animated.nearLamps[1].order, 3) << "that of CH, which poses do not bake";
  EXPECT_EQ(nearLampsAt(animated, scene, compiled, 2.0)->halves, later.nearLamps->halves);
  EXPECT_EQ(report.bakes, 2u);
  EXPECT_EQ(report.reused, 1u);
}

TEST_F(AnimatedScene, AnimationThatMovesNoMesh_HasOneKeyAndNoBake) {
  scene.animations[0].channels.clear();
  Progress progress;
  AnimationReport report;
  BakeRequest request;
  request.sh.order = 2;
  const AnimatedTransfer animated = bakeAnimation(scene, compiled, 0, request, {}, openBakeOf(compiled, 2),
                                                  test::sharedDevice(), progress, report);
  EXPECT_EQ(animated.keys.size(), 1u);
  EXPECT_EQ(report.bakes, 0u);
  ASSERT_EQ(report.notes.size(), 1u);
  request.sh.order = 0;
  EXPECT_THROW(bakeAnimation(scene, compiled, 0, request, {}, {}, test::sharedDevice(), progress, report),
               UsageError);
}

TEST_F(AnimatedScene, Interruption_StopsBeforeTheNextPose) {
  struct Stopped : Progress {
    bool stopRequested() const override { return true; }
  } stopped;
  AnimationReport report;
  BakeRequest request;
  request.sh.order = 2;
  EXPECT_THROW(bakeAnimation(scene, compiled, 0, request, {}, openBakeOf(compiled, 2), test::sharedDevice(),
                             stopped, report),
               Interrupted);
}

}  // namespace
}  // namespace prelight
