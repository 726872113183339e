#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "encodings/registry/registry.h"
#include "prelight/error.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using Payload = std::vector<std::byte>;

/// Keeps every state that a bake offers, and gives one of them back.
class Keeper : public BakeCheckpoint {
 public:
  explicit Keeper(Payload start = {}) : start_(std::move(start)) {}

  std::optional<StateReader> load() override {
    return start_.empty() ? std::nullopt : std::optional(StateReader("state", start_));
  }
  void save(const std::function<void(StateWriter&)>& write) override {
    StateWriter writer;
    write(writer);
    states.emplace_back(writer.payload().begin(), writer.payload().end());
  }
  double interval() const override { return 0.0; }

  std::vector<Payload> states;

 private:
  Payload start_;
};

CompiledScene groundAndSphere() {
  CompiledScene scene = test::ground(4, 2.0f);
  test::append(scene, test::sphere(6, 0.5f, {0.0f, 0.8f, 0.0f}));
  for (auto& material : scene.materials) {
    material.albedo = glm::vec3(0.7f);
    material.doubleSided = true;
  }
  scene.materials[1].emission = glm::vec3(2.0f);
  return scene;
}

BakeRequest requestOf(int bounces) {
  BakeRequest request;
  request.ao = true;
  request.sh.order = 2;
  request.bounces = bounces;
  request.effort.rays = 512;
  return request;
}

/// What states hold in all their parts.
std::vector<BakeRequest> requests() {
  BakeRequest bounced = requestOf(1);
  bounced.haar.size = 4;
  bounced.glossy.order = 2;
  BakeRequest occluders = requestOf(0);
  occluders.occluders.wanted = true;
  BakeRequest radiosity;
  radiosity.radiosity.wanted = true;
  radiosity.radiosity.patchSize = 0.5;
  radiosity.effort.rays = 64;
  return {bounced, occluders, radiosity};
}

Bake bake(const CompiledScene& scene, const BakeRequest& request, BakeCheckpoint& checkpoint) {
  Progress progress;
  BakeReport report;
  return bakeScene(scene, request, makePlan(Scene(), scene, request), test::sharedDevice(), progress, report,
                   &checkpoint);
}

TEST(BakeState, KeptNowAndThen_ContinuedFromAny_EndsAsIfNeverEnded) {
  const CompiledScene scene = groundAndSphere();
  for (const BakeRequest& request : requests()) {
    Keeper keeper;
    const Bake whole = bake(scene, request, keeper);
    ASSERT_FALSE(keeper.states.empty());
    for (const std::size_t i : {std::size_t{0}, keeper.states.size() / 2, keeper.states.size() - 1}) {
      Keeper from(keeper.states[i]);
      const Bake part = bake(scene, request, from);
      EXPECT_EQ(part.ao, whole.ao);
      EXPECT_EQ(part.sh.has_value(), whole.sh.has_value());
      if (part.sh && whole.sh) {
        EXPECT_EQ(part.sh->coefficients, whole.sh->coefficients);
      }
      if (part.occluders && whole.occluders) {
        EXPECT_EQ(part.occluders->vectors, whole.occluders->vectors);
      }
      EXPECT_EQ(part.irradiance, whole.irradiance);
    }
  }
}

/// Texels in encodings follow from the map's, which the state keeps by direction.
TEST(BakeState, LightMapToBeEncoded_EndsAsIfNeverEnded) {
  CompiledScene scene = groundAndSphere();
  BakeRequest request;
  request.lightMap.wanted = true;
  request.lightMap.texelSize = 0.06;
  request.effort.rays = 16;
  request.encodedLight.encodings = {std::string(encodings().front().name)};
  const Scene source;
  const Plan plan = makePlan(source, scene, request);
  const auto bakeFrom = [&](Keeper& keeper) {
    Progress progress;
    BakeReport report;
    return bakeScene(scene, request, plan, test::sharedDevice(), progress, report, &keeper, nullptr, &source);
  };
  Keeper keeper;
  const Bake whole = bakeFrom(keeper);
  ASSERT_GT(keeper.states.size(), 2u);
  ASSERT_EQ(whole.encodedLight.size(), 1u);
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}, keeper.states.size() - 1}) {
    Keeper from(keeper.states[i]);
    const Bake part = bakeFrom(from);
    EXPECT_EQ(part.lightMap->values, whole.lightMap->values) << i;
    EXPECT_EQ(part.lightMap->encoded.front().values, whole.lightMap->encoded.front().values) << i;
    EXPECT_EQ(part.encodedLight.front().values, whole.encodedLight.front().values) << i;
  }
}

/// Overwrites some bytes with what indices, counts and numbers must not be.
void spoil(Payload& payload, std::mt19937& random) {
  constexpr std::array<std::size_t, 4> lengths = {1, 4, 8, 2048};
  const std::size_t length = std::min(lengths[random() % lengths.size()], payload.size() / 2);
  const std::size_t at = random() % (payload.size() - length) / 4 * 4;
  constexpr std::array<int, 4> fills = {0xff, 0x7f, 0x00, -1};
  const int fill = fills[random() % fills.size()];
  for (std::size_t i = 0; i < length; ++i)
    payload[at + i] = static_cast<std::byte>(fill < 0 ? random() & 0xffu : static_cast<unsigned>(fill));
}

TEST(BakeState, AlteredPayload_IsRefusedOrHarmless) {
  const CompiledScene scene = groundAndSphere();
  std::mt19937 random(17);
  int refused = 0;
  for (const BakeRequest& request : requests()) {
    Keeper keeper;
    (void)bake(scene, request, keeper);
    for (int i = 0; i < 60; ++i) {
      Payload payload = keeper.states[random() % keeper.states.size()];
      spoil(payload, random);
      Keeper from(std::move(payload));
      try {
        const Bake result = bake(scene, request, from);
        std::vector<float> values = result.ao;
        if (result.sh)
          values.insert(values.end(), result.sh->coefficients.begin(), result.sh->coefficients.end());
        for (const float value : values) ASSERT_TRUE(std::isfinite(value));
      } catch (const InputError&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 10);
}

/// A bounce would read far outside of its buffers. Senders lie before the marks of triangles, which end the
/// state.
TEST(BakeState, SendersOutsideTheScene_AreRefused) {
  const CompiledScene scene = groundAndSphere();
  Keeper keeper;
  (void)bake(scene, requestOf(1), keeper);
  Payload payload = keeper.states.back();
  const std::size_t end = payload.size() - scene.triangleCount() - sizeof(std::uint64_t);
  std::fill(payload.begin() + static_cast<std::ptrdiff_t>(end - 800),
            payload.begin() + static_cast<std::ptrdiff_t>(end), std::byte{0x7f});
  Keeper from(std::move(payload));
  EXPECT_THROW((void)bake(scene, requestOf(1), from), InputError);
}

/// Seconds are the first of a state's values.
TEST(BakeState, SecondsThatNoClockHolds_AreRefused) {
  const CompiledScene scene = groundAndSphere();
  Keeper keeper;
  (void)bake(scene, requestOf(0), keeper);
  for (const double seconds : {1e300, -1.0, std::nan(""), 1e10}) {
    Payload payload = keeper.states.back();
    std::memcpy(payload.data(), &seconds, sizeof seconds);
    Keeper from(std::move(payload));
    EXPECT_THROW((void)bake(scene, requestOf(0), from), InputError) << seconds;
  }
}

}  // namespace
}  // namespace prelight
