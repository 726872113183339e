#include "gi/update/coarse_light.h"

#include <gtest/gtest.h>

#include "gi/update/live_light.h"
#include "gi/update/live_scenes.h"
#include "support/devices.h"

namespace prelight::test {
namespace {

TEST(Followed, EqualCoarseLight_LeavesTheExactValue) {
  const glm::vec3 exact(0.1f, 0.7f, 0.0f), coarse(0.3f, 0.2f, 0.9f);
  EXPECT_EQ(followed(exact, coarse, coarse), exact);
}

TEST(Followed, GrowingLight_IsAdded_AndShrinkingLight_IsScaled) {
  const glm::vec3 value = followed(glm::vec3(2.0f), {1.0f, 4.0f, 4.0f}, {1.5f, 1.0f, 0.0f});
  EXPECT_FLOAT_EQ(value.x, 2.5f);
  EXPECT_FLOAT_EQ(value.y, 0.5f);
  EXPECT_FLOAT_EQ(value.z, 0.0f);
}

std::vector<glm::vec3> indirectOf(const LiveLight& live) {
  const std::span<const glm::vec3> values = live.indirect();
  return {values.begin(), values.end()};
}

/// Options of frames that have no time for anything but the coarse light.
LiveLightOptions hastyOptions() {
  LiveLightOptions options;
  options.coarser = 4;
  options.photons = 16000;
  options.texels = 2000;
  options.gather.rays = 64;
  options.gather.texelsPerFrame = 0;
  options.frameSeconds = 1e-6;
  return options;
}

LiveLight makeLive(const LoadedScene& loaded) {
  Progress progress;
  return LiveLight(loaded.scene, loaded.compiled, nullptr, 0.0, hastyOptions(), {}, sharedDevice(), progress);
}

TEST(CoarseLight, FramesWithoutAClock_AreAlikeInEveryRun) {
  const LoadedScene loaded("cornell");
  LiveLight first = makeLive(loaded), second = makeLive(loaded);
  Progress progress;
  for (int f = 1; f <= 12; ++f) {
    for (LiveLight* live : {&first, &second}) {
      if (f <= 4) live->moveNode(loaded.node("Short box"), shifted(0.05 * f, 0.0, 0.0));
      live->advance(progress);
    }
    EXPECT_EQ(indirectOf(first), indirectOf(second)) << f;
  }
}

}  // namespace
}  // namespace prelight::test
