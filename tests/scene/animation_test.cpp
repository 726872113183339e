#include "prelight/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace prelight {
namespace {

using std::numbers::pi;

void expectNear(const glm::dvec4& got, const glm::dvec4& expected, double tolerance) {
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(got[i], expected[i], tolerance) << "component " << i;
}

glm::vec4 aboutZ(double degrees) {
  return {0.0, 0.0, std::sin(degrees * pi / 360.0), std::cos(degrees * pi / 360.0)};
}

TEST(AnimationSampler, Linear_MixesBetweenKeysAndHoldsTheEnds) {
  const AnimationSampler sampler{
      Interpolation::Linear, {1, 2, 4}, {{0, 0, 0, 0}, {2, 4, 6, 0}, {4, 4, 4, 0}}};
  const auto at = [&](double t) { return sampleAt(sampler, AnimatedPath::Translation, t); };
  EXPECT_EQ(at(0.0), glm::dvec4(0, 0, 0, 0));
  EXPECT_EQ(at(1.0), glm::dvec4(0, 0, 0, 0));
  EXPECT_EQ(at(1.25), glm::dvec4(0.5, 1, 1.5, 0));
  EXPECT_EQ(at(2.0), glm::dvec4(2, 4, 6, 0));
  EXPECT_EQ(at(3.5), glm::dvec4(3.5, 4, 4.5, 0));
  EXPECT_EQ(at(9.0), glm::dvec4(4, 4, 4, 0));
}

TEST(AnimationSampler, Step_KeepsTheEarlierKeyUntilTheNext) {
  const AnimationSampler sampler{Interpolation::Step, {1, 2}, {{1, 1, 1, 0}, {5, 5, 5, 0}}};
  EXPECT_EQ(sampleAt(sampler, AnimatedPath::Scale, 1.999).x, 1.0);
  EXPECT_EQ(sampleAt(sampler, AnimatedPath::Scale, 2.0).x, 5.0);
}

TEST(AnimationSampler, LinearRotation_TurnsEvenly) {
  const AnimationSampler sampler{Interpolation::Linear, {0, 1}, {aboutZ(0), aboutZ(120)}};
  // A normalised linear mix of the quaternions would be at 27.8 degrees after a quarter of the way.
  expectNear(sampleAt(sampler, AnimatedPath::Rotation, 0.25), glm::dvec4(aboutZ(30)), 1e-7);
  expectNear(sampleAt(sampler, AnimatedPath::Rotation, 0.75), glm::dvec4(aboutZ(90)), 1e-7);
}

TEST(AnimationSampler, LinearRotation_GoesTheShortWayRound) {
  const AnimationSampler sampler{Interpolation::Linear, {0, 1}, {aboutZ(10), -aboutZ(50)}};
  const glm::dvec4 middle = sampleAt(sampler, AnimatedPath::Rotation, 0.5);
  EXPECT_NEAR(std::abs(glm::dot(middle, glm::dvec4(aboutZ(30)))), 1.0, 1e-7);
}

TEST(AnimationSampler, LinearRotation_OfEqualAndOfZeroKeys_StaysFinite) {
  const AnimationSampler equal{Interpolation::Linear, {0, 1}, {aboutZ(20), aboutZ(20)}};
  expectNear(sampleAt(equal, AnimatedPath::Rotation, 0.3), glm::dvec4(aboutZ(20)), 1e-7);
  const AnimationSampler zero{Interpolation::Linear, {0, 1}, {glm::vec4(0), glm::vec4(0)}};
  EXPECT_EQ(sampleAt(zero, AnimatedPath::Rotation, 0.3), glm::dvec4(0, 0, 0, 1));
}

// By hand, glTF 2.0 appendix C.5: keys at 1 s and 3 s, so td = 2 and t = 1/4 at 1.5 s.
//   h00 = 2/64 - 3/16 + 1 = 27/32     h10 = 1/64 - 2/16 + 1/4 = 9/64
//   h01 = -2/64 + 3/16 = 5/32         h11 = 1/64 - 1/16 = -3/64
// x: p0 = 1, m0 = 3, p1 = 5, m1 = -7:  27/32 + 2 * 9/64 * 3 + 25/32 + 2 * (-3/64) * (-7) = 100/32 = 3.125
// y: p0 = 0, m0 = 0, p1 = 8, m1 = 0:   40/32 = 1.25
// z: p0 = 2, m0 = 1, p1 = 2, m1 = 1:   54/32 + 9/32 + 10/32 - 3/32 = 70/32 = 2.1875
TEST(AnimationSampler, CubicSpline_AgreesWithHandComputedValues) {
  const AnimationSampler sampler{Interpolation::CubicSpline,
                                 {1, 3},
                                 {{99, 99, 99, 0},
                                  {1, 0, 2, 0},
                                  {3, 0, 1, 0},  // In, value, out.
                                  {-7, 0, 1, 0},
                                  {5, 8, 2, 0},
                                  {99, 99, 99, 0}}};  // In, value, out.
  expectNear(sampleAt(sampler, AnimatedPath::Translation, 1.5), {3.125, 1.25, 2.1875, 0.0}, 1e-12);
  EXPECT_EQ(sampleAt(sampler, AnimatedPath::Translation, 0.5), glm::dvec4(1, 0, 2, 0));
  EXPECT_EQ(sampleAt(sampler, AnimatedPath::Translation, 3.0), glm::dvec4(5, 8, 2, 0));
}

TEST(AnimationSampler, CubicSplineOfRotations_IsNormalised) {
  const glm::vec4 none(0.0f);
  const AnimationSampler sampler{
      Interpolation::CubicSpline, {0, 1}, {none, aboutZ(0), none, none, aboutZ(90), none}};
  const glm::dvec4 middle = sampleAt(sampler, AnimatedPath::Rotation, 0.5);
  EXPECT_NEAR(glm::length(middle), 1.0, 1e-14);
  expectNear(middle, glm::dvec4(aboutZ(45)), 1e-7);
}

TEST(Animation, StartAndEnd_SpanAllChannels) {
  Animation animation;
  animation.samplers = {{Interpolation::Step, {2, 3}, {{}, {}}}, {Interpolation::Step, {0.5f, 1}, {{}, {}}}};
  EXPECT_EQ(animation.startTime(), 0.0);
  EXPECT_EQ(animation.endTime(), 0.0);
  animation.channels = {{0, AnimatedPath::Scale, 0}, {0, AnimatedPath::Translation, 1}};
  EXPECT_EQ(animation.startTime(), 0.5);
  EXPECT_EQ(animation.endTime(), 3.0);
}

}  // namespace
}  // namespace prelight
