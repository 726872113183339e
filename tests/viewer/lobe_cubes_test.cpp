// Cube maps through lobes, against sums of GGX microfacets over all texels in double precision.
#include "viewer/cubes/lobe_cubes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "basis/cube_map.h"
#include "basis/sky_lobes.h"
#include "viewer/cubes/cube_faces.h"
#include "viewer/gl/egl_context.h"

namespace prelight {
namespace {

using viewer::LobeCubes;

constexpr int lobeSide = 32;
constexpr float beyondAll = 1e30f;

/// Radiance and distance that a cube map sees.
using Seen = std::function<glm::vec4(const glm::dvec3&)>;

/// Direction through a point (u, v) of -1..1 on a face, by OpenGL 4.1's table 3.19.
glm::dvec3 texelDirection(std::size_t face, double u, double v) {
  switch (face) {
    case 0:
      return glm::normalize(glm::dvec3(1, -v, -u));
    case 1:
      return glm::normalize(glm::dvec3(-1, -v, u));
    case 2:
      return glm::normalize(glm::dvec3(u, 1, v));
    case 3:
      return glm::normalize(glm::dvec3(u, -1, -v));
    case 4:
      return glm::normalize(glm::dvec3(u, -v, 1));
    default:
      return glm::normalize(glm::dvec3(-u, -v, -1));
  }
}

/// Calls use(direction, solid angle) for the texels of a cube of `texels` a side.
template <typename Use>
void forLobeTexels(int texels, const Use& use) {
  for (std::size_t face = 0; face < 6; ++face)
    for (int y = 0; y < texels; ++y)
      for (int x = 0; x < texels; ++x) {
        const double u = (2.0 * x + 1.0) / texels - 1.0, v = (2.0 * y + 1.0) / texels - 1.0;
        use(texelDirection(face, u, v), 4.0 / (texels * texels) / std::pow(1.0 + u * u + v * v, 1.5));
      }
}

/// Mean over the lobe: weights are D(h) cos (Walter et al. 2007, Eq. 33) of half vectors h with the axis.
glm::dvec4 expectedLobeMean(const Seen& seen, const glm::dvec3& axis, double alpha) {
  glm::dvec4 sum(0.0);
  double weights = 0.0;
  forLobeTexels(160, [&](const glm::dvec3& w, double solidAngle) {
    const double cosine = glm::dot(axis, w);
    if (cosine <= 0.0) return;
    const double half2 = 0.5 * (1.0 + cosine), narrowing = half2 * (alpha * alpha - 1.0) + 1.0;
    const double weight = solidAngle * cosine * alpha * alpha / (narrowing * narrowing);
    const glm::vec4 found = seen(w);
    weights += weight;
    if (found.w < 1e15f) sum += weight * glm::dvec4(glm::dvec3(found), 1.0);
  });
  return sum / weights;
}

/// The second of two cubes, filtered.
class FilteredCube {
 public:
  explicit FilteredCube(const Seen& seen) : lobes_(lobeSide, 2) {
    const viewer::gl::Framebuffer drawn(2 * lobeSide, 2 * lobeSide);
    for (std::size_t face = 0; face < 6; ++face) {
      std::vector<glm::vec4> texels;
      for (int y = 0; y < 2 * lobeSide; ++y)
        for (int x = 0; x < 2 * lobeSide; ++x)
          texels.push_back(
              seen(texelDirection(face, (x + 0.5) / lobeSide - 1.0, (y + 0.5) / lobeSide - 1.0)));
      glBindTexture(GL_TEXTURE_2D, drawn.color().name());
      glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 2 * lobeSide, 2 * lobeSide, GL_RGBA, GL_FLOAT, texels.data());
      lobes_.takeFace(drawn, face);
    }
    lobes_.filter(1);
  }

  /// Texels of a level, [face][row][column].
  std::vector<glm::vec4> level(int level, bool wider) const {
    const int texels = lobeSide >> level;
    std::vector<glm::vec4> all(static_cast<std::size_t>(4 * 6 * texels * texels));
    glBindTexture(GL_TEXTURE_CUBE_MAP_ARRAY, lobes_.lobes().name());
    glGetTexImage(GL_TEXTURE_CUBE_MAP_ARRAY, level, GL_RGBA, GL_FLOAT, all.data());
    const std::ptrdiff_t cube = 6 * texels * texels;
    const auto first = all.begin() + (wider ? 3 : 2) * cube;
    return {first, first + cube};
  }

  double alpha(int level, bool wider) const { return alphaOfSpread(lobes_.spread(level, wider)); }

 private:
  viewer::gl::EglContext context_;
  LobeCubes lobes_;
};

TEST(LobeCubes, Spreads_AreHalvedFromThatOfTheWidestLobe) {
  const viewer::gl::EglContext context;
  const LobeCubes lobes(64, 1);
  ASSERT_EQ(lobes.levels(), 4);
  double expected = lobeSpread(1.0);
  for (int level = 3; level >= 0; --level)
    for (const bool wider : {true, false}) {
      EXPECT_NEAR(lobes.spread(level, wider), expected, 1e-3 * expected) << level;
      expected *= 0.5;
    }
}

TEST(LobeCubes, SurfacesAllAround_FillEachLobe) {
  const FilteredCube cube([](const glm::dvec3&) { return glm::vec4(0.5f, 2.0f, 7.0f, 3.0f); });
  for (const int level : {0, 2})
    for (const glm::vec4& texel : cube.level(level, false))
      ASSERT_LT(glm::length(texel - glm::vec4(0.5f, 2.0f, 7.0f, 1.0f)), 1e-4f);
}

/// Where the sky begins, what is seen falls from 3.3 at most to nothing, within a texel that is a third of
/// the narrowest lobe.
TEST(LobeCubes, RadianceBelowASky_IsItsMeanOverTheLobe) {
  const Seen seen = [](const glm::dvec3& w) {
    const glm::vec3 radiance(1.0 + 0.5 * std::sin(3.0 * w.x), std::exp(w.z), 1.0 + w.y * w.x);
    return glm::vec4(radiance, w.y > 0.25 ? beyondAll : 2.0f);
  };
  const FilteredCube cube(seen);
  for (const int level : {0, 1, 2})
    for (const bool wider : {false, true}) {
      const std::vector<glm::vec4> found = cube.level(level, wider);
      const int stride = level == 0 ? 211 : level == 1 ? 53 : 13;
      int number = 0;
      forLobeTexels(lobeSide >> level, [&](const glm::dvec3& w, double) {
        if (number++ % stride != 0) return;
        const glm::dvec4 expected = expectedLobeMean(seen, w, cube.alpha(level, wider));
        const glm::dvec4 difference = glm::dvec4(found[static_cast<std::size_t>(number - 1)]) - expected;
        EXPECT_LT(glm::length(difference), 0.04 * 3.3) << level << " " << wider << " " << number;
      });
    }
}

}  // namespace
}  // namespace prelight
