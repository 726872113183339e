#include "gi/update/live_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/colour.h"
#include "gi/indirect_light.h"
#include "gi/update/live_scenes.h"
#include "support/devices.h"

namespace prelight::test {
namespace {

LiveLightOptions smallOptions() {
  LiveLightOptions options;
  options.photons = 6000;
  options.texels = 600;
  options.gather.rays = 64;
  options.gather.texelsPerFrame = 50;
  options.causticPhotons = 2000;
  return options;
}

LiveLight makeLive(const LoadedScene& loaded, const LiveLightOptions& options) {
  Progress progress;
  return LiveLight(loaded.scene, loaded.compiled, nullptr, 0.0, options, {}, sharedDevice(), progress);
}

/// Root mean squared difference over the mean of the expected values.
double difference(std::span<const glm::vec3> got, std::span<const glm::vec3> expected) {
  double squares = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    squares += std::pow(luminance(glm::dvec3(got[i]) - glm::dvec3(expected[i])), 2.0);
    sum += luminance(glm::dvec3(expected[i]));
  }
  const auto count = static_cast<double>(got.size());
  return std::sqrt(squares / count) / (sum / count);
}

std::vector<glm::vec3> copyOf(std::span<const glm::vec3> values) { return {values.begin(), values.end()}; }

int settle(LiveLight& live) {
  Progress progress;
  int frames = 0;
  while (!live.settled() && frames < 1000) {
    live.advance(progress);
    ++frames;
  }
  return frames;
}

/// Indirect light of the scene in its current state, gathered with the same rays and seeds but without any
/// kept results.
std::vector<glm::vec3> gatheredAnew(const LiveLight& live, const std::vector<Image>& images,
                                    const LiveLightOptions& options) {
  const CompiledScene& compiled = live.scene().compiled();
  const LitScene lit{compiled, images, compiled.lights};
  TransportScene transport(lit, sharedDevice());
  const DensitySurface surface = makeDensitySurface(
      compiled, splitByPrimitive(makeSurfaceRegions(compiled, usualCreaseAngle), compiled));
  IndirectRequest request;
  request.photons = options.photons;
  request.nearestPhotons = options.nearestPhotons;
  request.rays = options.gather.rays;
  request.seed = options.seed;
  request.directByPhotons = true;
  Progress progress;
  const SurfacePatches patches(compiled, transport.tracer(), live.layout(), surface);
  IndirectLight light(lit, transport, patches, surface, request, sharedDevice(),
                      sendPhotons(compiled, transport, indirectPhotons(transport, request), progress));
  return light.gather(live.layout().texels, progress);
}

struct Move {
  std::string scene, node;
  RigidMotion motion;
};

void PrintTo(const Move& move, std::ostream* out) { *out << move.scene << ", " << move.node; }

/// Expects that advancing frame by frame until nothing waits gives nearly the light of a full recomputation,
/// much nearer than the light before the change. Returns the settled light; `live` is recomputed afterwards.
std::vector<glm::vec3> expectSettlesToAllAgain(LiveLight& live, std::span<const glm::vec3> before) {
  Progress progress;
  live.advance(progress);
  settle(live);
  const std::vector<glm::vec3> settled = copyOf(live.indirect());
  live.recompute(progress);
  const double moved = difference(before, live.indirect());
  EXPECT_GT(moved, 0.03);
  EXPECT_LT(difference(settled, live.indirect()), std::min(0.02, 0.3 * moved));
  return settled;
}

class LiveLightMove : public ::testing::TestWithParam<Move> {};

TEST_P(LiveLightMove, SettledLight_IsWhatComputingAllAgainYields) {
  const Move& m = GetParam();
  const LoadedScene loaded(m.scene);
  LiveLight live = makeLive(loaded, smallOptions());
  const std::vector<glm::vec3> before = copyOf(live.indirect());
  live.moveNode(loaded.node(m.node), m.motion);
  const std::vector<glm::vec3> settled = expectSettlesToAllAgain(live, before);
  EXPECT_LT(difference(settled, gatheredAnew(live, loaded.scene.images, smallOptions())),
            std::min(0.02, 0.3 * difference(before, live.indirect())));
}

INSTANTIATE_TEST_SUITE_P(Scenes, LiveLightMove,
                         ::testing::Values(Move{"cornell", "Tall box", shifted(0.25, 0.0, 0.2)},
                                           Move{"rooms", "Left crate", shifted(0.6, 0.0, 0.3)},
                                           Move{"shapes", "Box", shifted(0.3, 0.4, 0.0)},
                                           Move{"caustics", "Mirror box", shifted(0.2, 0.0, 0.1)}),
                         [](const auto& test) { return test.param.scene; });

// A texel needs twice the rays of one receiver, and therefore two receivers.
TEST(LiveLight, MoreRaysThanAReceiverTakes_AreAllGathered) {
  const LoadedScene loaded("cornell");
  LiveLightOptions options = smallOptions();
  options.texels = 200;
  options.gather.rays = 2 * GatherRequest::mostRaysPerReceiver;
  LiveLight live = makeLive(loaded, options);
  EXPECT_LT(difference(live.indirect(), gatheredAnew(live, loaded.scene.images, options)), 0.02);
}

TEST(LiveLight, TurnedObject_SettlesToComputingAllAgain) {
  const LoadedScene loaded("cornell");
  LiveLight live = makeLive(loaded, smallOptions());
  const std::vector<glm::vec3> before = copyOf(live.indirect());
  // Turns the box upside down about an axis through its middle: every face then looks the other way.
  const glm::dmat3 turn(glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, -1));
  const glm::dvec3 middle(-0.34, 0.6, -0.3);
  live.moveNode(loaded.node("Tall box"), {turn, middle - turn * middle});
  expectSettlesToAllAgain(live, before);
}

TEST(LiveLight, LampSwitchedOffAndOn_TakesItsLightAlong) {
  const LoadedScene loaded("rooms");
  LiveLight live = makeLive(loaded, smallOptions());
  const std::vector<glm::vec3> before = copyOf(live.indirect());
  Progress progress;
  const Light lit = loaded.compiled.lights.at(0);
  Light dark = lit;
  dark.intensity = glm::vec3(0.0f);
  live.setLight(0, dark);
  live.advance(progress);
  settle(live);
  EXPECT_TRUE(live.indirect().empty());
  EXPECT_FALSE(live.plan()[0].runs);
  live.setLight(0, lit);
  live.advance(progress);
  settle(live);
  EXPECT_EQ(copyOf(live.indirect()), before);
}

TEST(LiveLight, OneOfTwoLampsSwitchedOff_LeavesTheLightOfTheOther) {
  LoadedScene loaded = LoadedScene("rooms");
  Light second = loaded.compiled.lights.at(0);
  second.position.z += 0.5;
  loaded.compiled.lights.push_back(second);
  LiveLight live = makeLive(loaded, smallOptions());
  Progress progress;
  Light dark = loaded.compiled.lights[0];
  dark.intensity = glm::vec3(0.0f);
  live.setLight(0, dark);
  live.advance(progress);
  settle(live);
  const std::vector<glm::vec3> settled = copyOf(live.indirect());
  live.recompute(progress);
  EXPECT_LT(difference(settled, live.indirect()), 0.02);
}

TEST(LiveLight, NothingChanges_CostsNothing) {
  const LoadedScene loaded("cornell");
  LiveLight live = makeLive(loaded, smallOptions());
  EXPECT_TRUE(live.settled());
  Progress progress;
  const LiveFrame frame = live.advance(progress);
  EXPECT_EQ(frame.rays(), 0u);
  EXPECT_EQ(frame.estimates, 0u);
  EXPECT_FALSE(frame.shownChanged);
}

TEST(LiveLight, Frames_KeepToTheirBudgets) {
  const LoadedScene loaded("cornell");
  LiveLightOptions options = smallOptions();
  options.coarser = 0;
  options.photonsPerFrame = 300;
  options.estimatesPerFrame = 100;
  options.gather.texelsPerFrame = 10;
  LiveLight live = makeLive(loaded, options);
  Progress progress;
  for (int f = 1; f < 10; ++f) {
    live.moveNode(loaded.node("Short box"), shifted(0.02 * f, 0.0, 0.0));
    const LiveFrame frame = live.advance(progress);
    EXPECT_LE(frame.photons.traced, 300u);
    EXPECT_LE(frame.estimates, 100u);
    EXPECT_EQ(frame.gather.texels, 10u);
  }
}

TEST(LiveLight, GatheredTexel_IsBlendedInOverItsFrames) {
  const LoadedScene loaded("cornell");
  LiveLightOptions options = smallOptions();
  options.coarser = 0;
  options.gather.texelsPerFrame = 0;
  options.gather.blendFrames = 4;
  LiveLight live = makeLive(loaded, options);
  Progress progress;
  const std::vector<glm::vec3> before = copyOf(live.indirect());
  live.moveNode(loaded.node("Tall box"), shifted(0.3, 0.0, 0.2));
  std::vector<std::vector<glm::vec3>> shown;
  for (int f = 0; f < 30; ++f) {
    live.advance(progress);
    shown.push_back(copyOf(live.indirect()));
  }
  EXPECT_TRUE(live.settled());
  double whole = difference(before, shown.back());
  const std::vector<glm::vec3>* last = &before;
  for (const std::vector<glm::vec3>& frame : shown) {
    EXPECT_LT(difference(frame, *last), 0.5 * whole);
    last = &frame;
  }
}

/// Two rooms without a passage between them, with a lamp in each.
LoadedScene sealedRooms() {
  LoadedScene loaded("rooms-sealed");
  Light other = loaded.compiled.lights.at(0);
  other.position.x = -other.position.x;
  loaded.compiled.lights.push_back(other);
  return loaded;
}

TEST(LiveLight, ChangeInOneOfTwoSealedRooms_CostsNothingInTheOther) {
  const LoadedScene loaded = sealedRooms();
  LiveLight live = makeLive(loaded, smallOptions());
  const std::vector<glm::vec3> before = copyOf(live.indirect());
  Progress progress;
  live.moveNode(loaded.node("Left crate"), shifted(0.2, 0.3, 0.1));
  std::uint64_t texels = 0, traced = 0;
  for (int f = 0; f < 200 && (f == 0 || !live.settled()); ++f) {
    const LiveFrame frame = live.advance(progress);
    texels += frame.gather.texels;
    traced += frame.photons.traced;
  }
  // The wall is at x = 0. Nothing beyond it changed: every texel there keeps its bits.
  const CompiledScene& scene = live.scene().compiled();
  std::size_t beyond = 0, changed = 0, here = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const LightMapTexel& place = live.layout().texels[i];
    const std::uint32_t t =
        place.face >= scene.triangleCount() ? place.face - scene.triangleCount() : place.face;
    const double x = (scene.positions[scene.triangles[t].x].x + scene.positions[scene.triangles[t].y].x +
                      scene.positions[scene.triangles[t].z].x) /
                         3.0 +
                     scene.origin.x;
    if (x > 0.01) {
      ++beyond;
      EXPECT_EQ(live.indirect()[i], before[i]) << i;
    } else {
      ++here;
      changed += live.indirect()[i] != before[i] ? 1 : 0;
    }
  }
  EXPECT_GT(beyond, 100u);
  EXPECT_GT(changed, here / 2);
  EXPECT_LE(texels, 4 * here);
  EXPECT_LT(traced, live.photons()->pathCount() / 2);
}

TEST(LiveLight, SceneWithoutCasters_SendsNoCausticPhotons) {
  const LoadedScene loaded("cornell");
  const LiveLight live = makeLive(loaded, smallOptions());
  EXPECT_EQ(live.causticPhotons(), nullptr);
  EXPECT_TRUE(live.caustics().empty());
  EXPECT_FALSE(live.plan()[1].runs);
  EXPECT_NE(live.plan()[1].reason, "");
}

TEST(LiveLight, DarkScene_HasNothingToDo) {
  LoadedScene loaded("rooms");
  loaded.compiled.lights.clear();
  LiveLight live = makeLive(loaded, smallOptions());
  EXPECT_FALSE(live.plan()[0].runs);
  EXPECT_TRUE(live.indirect().empty());
  live.moveNode(loaded.node("Left crate"), shifted(0.1, 0.0, 0.0));
  Progress progress;
  EXPECT_EQ(live.advance(progress).rays(), 0u);
}

TEST(LiveLight, EyeThatComesNearAThinnedLamp_SettlesToComputingAllAgain) {
  const LoadedScene loaded("rooms");
  LiveLightOptions options = smallOptions();
  options.thinBeyond = 1.0;
  options.eye = loaded.compiled.lights.at(0).position + glm::dvec3(30.0, 0.0, 0.0);
  LiveLight live = makeLive(loaded, options);
  EXPECT_LT(live.photons()->pathCount(), 500u);
  live.setEye(loaded.compiled.lights.at(0).position);
  EXPECT_FALSE(live.settled());
  settle(live);
  EXPECT_EQ(live.photons()->pathCount(), 6000u);
  const std::vector<glm::vec3> settled = copyOf(live.indirect());
  Progress progress;
  live.recompute(progress);
  EXPECT_LT(difference(settled, live.indirect()), 0.02);
}

}  // namespace
}  // namespace prelight::test
