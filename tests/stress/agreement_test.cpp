// Both trees against all triangles in double precision, for scenes of every scale and place, ordinary and
// extreme.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "gpu/tracer.h"
#include "scene/builtin/builtin.h"
#include "stress/closed_meshes.h"
#include "stress/hit_bounds.h"
#include "stress/rays.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using device::Hit;
using device::Ray;

struct Answers {
  std::vector<Hit> closest, any;
};

class AgreementTest : public ::testing::Test {
 protected:
  static Answers trace(const CompiledScene& scene, const std::vector<Ray>& rays, BvhLayout layout) {
    Tracer tracer(scene, test::sharedDevice(), layout);
    return {tracer.traceClosest(rays), tracer.traceAny(rays)};
  }

  static bool isMetEdgeOn(const CompiledScene& scene, const Ray& ray, const Hit& hit) {
    return hit.triangle != PRELIGHT_NO_TRIANGLE && test::crossingOf(scene, hit.triangle, ray).degenerate;
  }

  // Expects that both trees agree with all triangles and with each other. Returns the number of hits.
  static std::size_t expectAgreement(const std::string& name, const CompiledScene& scene,
                                     const std::vector<Ray>& rays) {
    const Answers wide = trace(scene, rays, BvhLayout::Wide), narrow = trace(scene, rays, BvhLayout::Narrow);
    std::size_t hits = 0, different = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      hits += wide.closest[i].triangle != PRELIGHT_NO_TRIANGLE;
      const bool same = wide.closest[i].triangle == narrow.closest[i].triangle &&
                        wide.any[i].triangle == narrow.any[i].triangle;
      different += !same && !isMetEdgeOn(scene, rays[i], wide.closest[i]) &&
                   !isMetEdgeOn(scene, rays[i], narrow.closest[i]);
      EXPECT_EQ(test::disagreement(scene, rays[i], wide.closest[i], wide.any[i]), "")
          << name << ", wide, ray " << i;
      EXPECT_EQ(test::disagreement(scene, rays[i], narrow.closest[i], narrow.any[i]), "")
          << name << ", narrow, ray " << i;
    }
    // Both trees use the same triangle test, so both must hit the same triangles. Triangles that are met
    // edge-on or have no area are exempt: rounding decides where the hit is, and thus which tree's box is hit
    // before it.
    EXPECT_EQ(different, 0u) << name;
    return hits;
  }

  static std::vector<Ray> raysThrough(const CompiledScene& scene, std::size_t count, std::uint64_t seed) {
    test::Counter random(seed);
    std::vector<Ray> rays;
    const auto somewhere = [&] {
      const glm::vec3 share(random.uniform(), random.uniform(), random.uniform());
      return glm::mix(scene.boundsMin, scene.boundsMax, 1.4f * share - 0.2f);
    };
    glm::vec3 from(0);
    for (std::size_t i = 0; i < count; ++i) {
      // The second half of the rays comes in bundles of 16 from one point.
      if (i < count / 2 || i % 16 == 0) from = somewhere();
      rays.push_back(test::makeRay(from, glm::normalize(somewhere() - from)));
    }
    return rays;
  }
};

TEST_F(AgreementTest, Soup_ScaledAndFarFromZero) {
  const CompiledScene soup = test::randomSoup(600, 0.3f, 31);
  struct Move {
    float scale, offset;
  };
  for (const Move m :
       {Move{1, 0}, {1e-6f, 0}, {1e6f, 0}, {1, 1e3f}, {1, 1e6f}, {1e3f, 1e6f}, {1e-6f, 1}, {1e-3f, 1e3f}}) {
    const CompiledScene scene =
        test::moved(soup, glm::vec3(m.scale), glm::vec3(m.offset, -m.offset, m.offset));
    const auto hits =
        expectAgreement("scale " + std::to_string(m.scale) + ", offset " + std::to_string(m.offset), scene,
                        raysThrough(scene, 2000, 32));
    if (m.offset <= 1e5f * m.scale) {
      EXPECT_GT(hits, 500u) << m.scale << ' ' << m.offset;
    }
  }
}

// compileScene turns a moved scene into the same scene, except for rounding to float around its centre.
TEST_F(AgreementTest, BuiltinScenes_LoadedAtAnyScaleAndPlace) {
  for (const auto& builtin : builtinScenes())
    for (const double scale : {1e-6, 1.0, 1e6})
      for (const double offset : {0.0, 1e6}) {
        const auto transform =
            glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(offset)), glm::dvec3(scale));
        Warnings warnings;
        const CompiledScene scene = compileScene(test::builtinScene(builtin.name, transform), warnings);
        EXPECT_EQ(scene.droppedTriangles, 0u) << builtin.name << ' ' << scale << ' ' << offset;
        expectAgreement(builtin.name, scene, raysThrough(scene, 60, 33));
      }
}

/// Numbers of any size: mostly ordinary, sometimes 0, a power of ten, or a repeated one.
class NastyNumbers {
 public:
  explicit NastyNumbers(std::uint64_t seed, float decades) : random_(seed), decades_(decades) {}

  float next() {
    switch (random_.below(8)) {
      case 0:
        return random_.below(2) == 0 ? 0.0f : -0.0f;
      case 1:
        return last_;
      case 2:
        return last_ = std::nextafter(last_, 1e9f);
      case 3:
        return last_ = static_cast<float>(random_.below(5)) - 2.0f;
      case 4:
        return last_ = random_.between(-1, 1) * std::pow(10.0f, random_.between(-decades_, decades_));
      default:
        return last_ = random_.between(-1, 1);
    }
  }
  glm::vec3 vector() {
    const float x = next(), y = next();
    return {x, y, next()};
  }
  test::Counter& random() { return random_; }

 private:
  test::Counter random_;
  float decades_;
  float last_ = 0.5f;
};

TEST_F(AgreementTest, RandomNastyScenesAndRays) {
  std::size_t hits = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    NastyNumbers numbers(seed + 100, static_cast<float>(seed % 4) * 2 + 1);
    const auto vertexCount = 3 + numbers.random().below(60);
    const auto triangleCount = 1 + numbers.random().below(120);
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    for (std::uint64_t i = 0; i < vertexCount; ++i) positions.push_back(numbers.vector());
    for (std::uint64_t i = 0; i < triangleCount; ++i) {
      const auto vertex = [&] { return static_cast<std::uint32_t>(numbers.random().below(vertexCount)); };
      triangles.emplace_back(vertex(), vertex(), vertex());
    }
    const CompiledScene scene = test::sceneOf(positions, triangles);
    std::vector<Ray> rays;
    while (rays.size() < 200) {
      const bool fromVertex = numbers.random().below(3) == 0;
      const glm::vec3 from = fromVertex ? positions[numbers.random().below(vertexCount)] : numbers.vector();
      const bool atVertex = numbers.random().below(3) == 0;
      const glm::vec3 direction =
          atVertex ? positions[numbers.random().below(vertexCount)] - from : numbers.vector();
      if (direction == glm::vec3(0)) continue;
      const float tMax = numbers.random().below(4) == 0 ? std::abs(numbers.next()) : 1e30f;
      const auto source = numbers.random().below(4) == 0
                              ? static_cast<std::uint32_t>(numbers.random().below(triangleCount))
                              : PRELIGHT_NO_TRIANGLE;
      rays.push_back(test::makeRay(from, direction, tMax, source));
    }
    hits += expectAgreement("seed " + std::to_string(seed), scene, rays);
  }
  EXPECT_GT(hits, 5000u);
}

}  // namespace
}  // namespace prelight
