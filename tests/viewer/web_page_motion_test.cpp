// Contents of pages for scenes that an animation moves.
#include <gmock/gmock.h>

#include <cstring>

#include "compress/small_floats.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "scene/pose.h"
#include "support/bent_bar.h"
#include "viewer/web/web_page.h"

namespace prelight::viewer {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::HasSubstr;

/// A scene with a bake of ambient occlusion only, whose values do not matter.
struct PagedScene {
  Scene scene;
  CompiledScene compiled;
  Bake bake;
  GltfDocument document;

  explicit PagedScene(Scene moving) : scene(std::move(moving)) {
    Warnings warnings;
    compiled = compileScene(scene, warnings);
    bake.ao.assign(compiled.vertexCount(), 1.0f);
    bake.bentNormals = compiled.normals;
  }

  PageScene page() const {
    const RenderInputs inputs{scene, compiled, &bake};
    return pageScene({inputs, document, "moves", {}});
  }
};

Scene swing() {
  Warnings warnings;
  return loadScene(makeBuiltinScene("swing"), warnings);
}

template <typename T>
std::vector<T> arrayOf(const PageScene& page, const std::string& name) {
  const Json& place = page.description["arrays"][name];
  std::vector<T> values(place["count"].get<std::size_t>());
  std::memcpy(values.data(), page.data.bytes().data() + place["offset"].get<std::size_t>(),
              values.size() * sizeof(T));
  return values;
}

glm::dvec3 movedBy(const float* rows, const glm::vec3& point) {
  glm::dvec3 moved(0.0);
  for (int row = 0; row < 3; ++row)
    moved[row] = double(rows[row]) * point.x + double(rows[3 + row]) * point.y +
                 double(rows[6 + row]) * point.z + double(rows[9 + row]);
  return moved;
}

/// The reference is the scene posed and compiled anew.
TEST(WebPageMotion, Samples_TakeVerticesToWhereTheAnimationHasThem) {
  const PagedScene paged(swing());
  const PageScene page = paged.page();
  const Json& motion = page.description["motion"];
  const auto samples = motion["samples"].get<std::size_t>();
  const std::vector<float> rows = arrayOf<float>(page, "motion");
  const Json& ranges = motion["ranges"];
  ASSERT_EQ(rows.size(), samples * ranges.size() * 12);
  ASSERT_GE(ranges.size(), 3u);  // The box, the ball and the board; the ground stays.
  for (const std::size_t sample : {std::size_t{0}, samples / 3, samples - 1}) {
    const double time =
        motion["end"].get<double>() * static_cast<double>(sample) / static_cast<double>(samples - 1);
    Warnings warnings;
    const CompiledScene posed = compileScene(sceneAt(paged.scene, 0, time), warnings);
    std::vector<glm::dvec3> moved(paged.compiled.positions.begin(), paged.compiled.positions.end());
    for (std::size_t r = 0; r < ranges.size(); ++r) {
      const std::size_t first = ranges[r]["firstVertex"], count = ranges[r]["vertexCount"];
      for (std::size_t v = first; v < first + count; ++v)
        moved[v] = movedBy(&rows[(sample * ranges.size() + r) * 12], paged.compiled.positions[v]);
    }
    for (std::size_t v = 0; v < moved.size(); ++v)
      ASSERT_LT(
          glm::distance(moved[v] + paged.compiled.origin, glm::dvec3(posed.positions[v]) + posed.origin),
          1e-5)
          << "vertex " << v << " at " << time << " s";
  }
}

TEST(WebPageMotion, Keys_AreThoseOfTheBake) {
  PagedScene paged(swing());
  HarmonicTransfer first{2, 1, 0, std::vector<float>(4 * paged.compiled.vertexCount(), 0.25f)}, last = first;
  last.coefficients[5] = -0.5f;
  paged.bake.animation = AnimatedTransfer{0, {0.5, 2.5}, {first, last}};
  const PageScene page = paged.page();
  const Json& keys = page.description["motion"]["keys"];
  EXPECT_EQ(keys["times"], Json({0.5, 2.5}));
  const auto halves = arrayOf<std::uint16_t>(page, keys["arrays"][1].get<std::string>());
  ASSERT_EQ(halves.size(), last.coefficients.size());
  EXPECT_EQ(fromHalf(halves[4]), 0.25f);
  EXPECT_EQ(fromHalf(halves[5]), -0.5f);
  EXPECT_EQ(arrayOf<float>(page, "keyMotion").size(), 2 * 12 * page.description["motion"]["ranges"].size());
  EXPECT_FALSE(keys.contains("nearLamps"));
}

/// Shells of keys follow what moves, so that no note excuses lamps without shadows.
TEST(WebPageMotion, ShellsOfKeys_AreThoseOfTheBake) {
  PagedScene paged(swing());
  const std::size_t vertices = paged.compiled.vertexCount();
  const HarmonicTransfer sh{2, 1, 0, std::vector<float>(4 * vertices, 0.25f)};
  NearLampTransfer first{1, 2, 0.1, 10.0, std::vector<std::uint16_t>(2 * vertices, 0x3c00)}, last = first;
  last.halves[3] = 0x3800;
  paged.bake.sh = sh;
  paged.bake.nearLamps = first;
  paged.bake.animation = AnimatedTransfer{0, {0.5, 2.5}, {sh, sh}, {first, last}};
  const PageScene page = paged.page();
  const Json& motion = page.description["motion"];
  ASSERT_EQ(motion["keys"]["nearLamps"].size(), 2u);
  EXPECT_EQ(arrayOf<std::uint16_t>(page, motion["keys"]["nearLamps"][1].get<std::string>()), last.halves);
  EXPECT_EQ(motion["notes"].dump().find("without shadows"), std::string::npos);
}

TEST(WebPageMotion, LampThatMoves_IsWhereThePoseHasIt) {
  Scene scene = swing();
  const std::size_t ball =
      std::find_if(scene.meshNodes.begin(), scene.meshNodes.end(), [](const MeshNode& node) {
        return node.name == "Ball";
      })->sceneNode;
  Light lamp;
  lamp.sceneNode = ball;
  scene.lights.push_back(lamp);
  const PagedScene paged(std::move(scene));
  const PageScene page = paged.page();
  const auto samples = page.description["motion"]["samples"].get<std::size_t>();
  const std::size_t lamps = page.description["motion"]["lamps"];
  const std::vector<float> rows = arrayOf<float>(page, "lampMotion");
  ASSERT_EQ(rows.size(), samples * lamps * 6);
  const glm::dvec3 last = sceneAt(paged.scene, 0, page.description["motion"]["end"]).lights.back().position;
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(rows[(samples * lamps - 1) * 6 + static_cast<std::size_t>(c)],
                last[c] - paged.compiled.origin[c], 1e-5);
}

TEST(WebPageMotion, SceneWithoutAnimation_HasNone) {
  Warnings warnings;
  const PagedScene paged(loadScene(makeBuiltinScene("shapes"), warnings));
  EXPECT_FALSE(paged.page().description.contains("motion"));
}

/// The bar is bent by a skin alone: nothing moves as a whole.
TEST(WebPageMotion, BentBar_Rests) {
  Warnings warnings;
  const PagedScene paged(loadScene(test::bentBar(), warnings));
  EXPECT_FALSE(paged.page().description.contains("motion"));
}

}  // namespace
}  // namespace prelight::viewer
