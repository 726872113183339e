#include "benchmarks/truth/truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "benchmarks/run/measure.h"
#include "benchmarks/truth/picture_error.h"
#include "support/devices.h"
#include "support/gltf_files.h"

namespace prelight::benchmarks {
namespace {

/// `cornell` as its camera sees it, few pixels and few samples.
struct SmallRoom {
  BenchmarkScene scene = loadBuiltinScene("cornell");
  reference::ReferenceInputs inputs{scene.compiled, scene.scene.images, scene.scene.lights,
                                    scene.scene.cameras.front()};
  Progress progress;

  TracedLight light(int least, int most) {
    reference::ReferenceRequest request;
    request.width = 24;
    request.height = 18;
    request.samples = 16;
    request.leastDepth = least;
    request.depth = most;
    return {inputs, request, test::sharedDevice(), progress};
  }
};

double meanOf(const Picture& picture) {
  glm::dvec3 sum(0.0);
  for (const glm::vec3& pixel : picture.pixels) sum += glm::min(glm::dvec3(pixel), glm::dvec3(1.0));
  return (sum.x + sum.y + sum.z) / (3.0 * static_cast<double>(picture.pixels.size()));
}

/// Samples that go where pixels vary have the mean that even ones have.
TEST(Truth, BlocksByWorth_HaveTheMeanOfPathsOfAllLengths) {
  SmallRoom room;
  TracedLight direct = room.light(1, 2), rest = room.light(3, 8);
  const std::array<TracedLight*, 2> parts = {&direct, &rest};
  const Truth truth = traceTruth(parts, {256, 20.0}, [](const Truth&) { return false; });

  reference::ReferenceRequest request;
  request.width = 24;
  request.height = 18;
  request.samples = 512;
  request.depth = 8;
  request.seed = 77;
  reference::Film film(24, 18);
  reference::ReferenceReport report;
  reference::renderReference(room.inputs, request, test::sharedDevice(), room.progress, film, report);
  const Picture even = film.picture();
  EXPECT_NEAR(meanOf(truth.picture), meanOf(even), 0.01 * meanOf(even));
  EXPECT_LT(pictureRmse(truth.picture, even), 4.0 * truth.rmse + 0.02);
  EXPECT_GT(truth.rmse, 0.0);
}

TEST(Truth, LightThatAFolderKeeps_GoesOnAsIfItHadNotStopped) {
  SmallRoom room;
  const test::TemporaryFolder folder;
  TracedLight whole = room.light(3, 4);
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t block = 0; block < whole.blockCount(); ++block) whole.trace(block);
  {
    TracedLight begun = room.light(3, 4);
    for (std::size_t block = 0; block < begun.blockCount(); ++block) begun.trace(block);
    begun.save(folder.path());
  }
  TracedLight resumed = room.light(3, 4);
  resumed.restore(folder.path());
  EXPECT_EQ(resumed.samples(), whole.samples() / 2);
  for (std::size_t block = 0; block < resumed.blockCount(); ++block) resumed.trace(block);
  EXPECT_EQ(resumed.half(0).pixels, whole.half(0).pixels);
  EXPECT_EQ(resumed.half(1).pixels, whole.half(1).pixels);
  EXPECT_NE(resumed.half(0).pixels, resumed.half(1).pixels);

  TracedLight other = room.light(2, 4);
  other.restore(folder.path());
  EXPECT_EQ(other.samples(), 0u);  // of other paths
}

}  // namespace
}  // namespace prelight::benchmarks
