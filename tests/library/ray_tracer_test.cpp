#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "prelight/prelight.h"
#include "support/devices.h"

namespace prelight {
namespace {

using ::testing::HasSubstr;

/// Rays from the middle of the room, more than are sent to the device at a time.
struct ManyRays {
  std::vector<glm::vec3> origins, directions;

  explicit ManyRays(std::size_t count) {
    std::mt19937 random(7);
    std::normal_distribution<float> normal;
    for (std::size_t i = 0; i < count; ++i) {
      origins.push_back(glm::vec3(0.1f, 1.0f, 0.2f) +
                        0.1f * glm::vec3(normal(random), normal(random), normal(random)));
      directions.emplace_back(normal(random), normal(random), 3.0f * normal(random));
    }
  }

  RayArrays arrays() const { return {origins, directions, {}}; }
};

class CornellRays : public ::testing::Test {
 protected:
  LoadedScene scene_ = loadBuiltin("cornell");
  RayTracer tracer_{scene_, {.device = &test::sharedDevice()}};

  std::string complaint(const RayArrays& rays, std::size_t room) {
    std::vector<ArrayHit> hits(room);
    try {
      tracer_.closest(rays, hits);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  }
};

/// trace() takes doubles and one ray at a time. Both use the same hierarchy, so that hits differ only by the
/// rounding of rays.
TEST_F(CornellRays, HitsInArrays_AreThoseOfTrace) {
  const ManyRays rays(150'000);
  std::vector<ArrayHit> hits(rays.origins.size());
  tracer_.closest(rays.arrays(), hits);
  std::vector<Ray> single;
  for (std::size_t i = 0; i < hits.size(); ++i)
    single.push_back({glm::dvec3(rays.origins[i]), glm::dvec3(rays.directions[i])});
  const auto expected = trace(scene_, single, {.device = &test::sharedDevice()});
  std::size_t differ = 0, found = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const bool both = expected[i].has_value() && hits[i].triangle >= 0;
    found += both ? 1 : 0;
    if (expected[i].has_value() != (hits[i].triangle >= 0))
      ++differ;
    else if (both && std::abs(expected[i]->distance - double(hits[i].distance)) > 1e-4)
      ++differ;
  }
  EXPECT_GT(found, hits.size() / 2);
  EXPECT_LT(found, hits.size()) << "the room is open at the front";
  EXPECT_LE(differ, hits.size() / 10'000) << "rays through edges alone may differ";
}

TEST_F(CornellRays, BlockedRays_AreThoseThatHit) {
  const ManyRays rays(5'000);
  std::vector<ArrayHit> hits(rays.origins.size());
  std::vector<std::uint8_t> blocked(hits.size());
  tracer_.closest(rays.arrays(), hits);
  tracer_.blocked(rays.arrays(), blocked);
  for (std::size_t i = 0; i < hits.size(); ++i)
    ASSERT_EQ(blocked[i] != 0, hits[i].triangle >= 0) << "ray " << i;
}

TEST_F(CornellRays, FarthestDistance_IsInMetresWhateverTheDirectionsLength) {
  const std::vector<glm::vec3> origins(2, glm::vec3(0.0f, 1.5f, 0.0f)),
      directions(2, glm::vec3(0.0f, 10.0f, 0.0f));
  const std::vector<float> farthest{0.4f, 0.6f};  // The ceiling is 0.5 m, the lamp 0.49 m away.
  std::vector<ArrayHit> hits(2);
  tracer_.closest({origins, directions, farthest}, hits);
  EXPECT_EQ(hits[0].triangle, ArrayHit::none);
  EXPECT_EQ(hits[0].distance, std::numeric_limits<float>::infinity());
  EXPECT_NEAR(hits[1].distance, 0.49f, 1e-5f);
}

TEST_F(CornellRays, BadRays_AreNamed) {
  ManyRays rays(3);
  std::vector<float> farthest(2, 1.0f);
  EXPECT_THAT(complaint({rays.origins, std::span(rays.directions).first(2), {}}, 3),
              HasSubstr("RayArrays::directions: got 2"));
  EXPECT_THAT(complaint({rays.origins, rays.directions, farthest}, 3),
              HasSubstr("RayArrays::farthest: got 2"));
  EXPECT_THAT(complaint(rays.arrays(), 2), HasSubstr("got room for 2"));
  rays.directions[1] = glm::vec3(0.0f);
  EXPECT_THAT(complaint(rays.arrays(), 3), HasSubstr("Ray 1"));
  rays.directions[1] = glm::vec3(1.0f);
  rays.origins[2].x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(complaint(rays.arrays(), 3), HasSubstr("Ray 2"));
}

TEST(RayTracerOfNothing, NoRay_Hits) {
  const std::string text = R"({"asset": {"version": "2.0"}})";
  const LoadedScene empty = load(std::as_bytes(std::span(text)));
  RayTracer tracer(empty, {.device = &test::sharedDevice()});
  const ManyRays rays(2);
  std::vector<ArrayHit> hits(2, ArrayHit{1.0f, 5, {}});
  tracer.closest(rays.arrays(), hits);
  EXPECT_EQ(hits[0].triangle, ArrayHit::none);
}

}  // namespace
}  // namespace prelight
