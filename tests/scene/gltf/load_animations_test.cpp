#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scene/pose.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

/// A triangle whose node moves from x = 0 to x = 2 within 1 s: accessors 3 (times) and 4 (values).
GltfDocument movingTriangle() {
  GltfDocument document = test::triangleDocument();
  test::appendFloats(document, {0, 1}, "SCALAR");
  test::appendFloats(document, {0, 0, 0, 2, 0, 0}, "VEC3");
  document.json["animations"] = Json::parse(R"([{"name": "move",
    "samplers": [{"input": 3, "output": 4}],
    "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}])");
  return document;
}

Scene loaded(const GltfDocument& document) {
  Warnings warnings;
  Scene scene = test::reload(document, warnings);
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  return scene;
}

void expectError(const GltfDocument& document, const std::vector<std::string>& parts) {
  Warnings warnings;
  const std::string error = test::inputErrorOf([&] { test::reload(document, warnings); });
  for (const std::string& part : parts) EXPECT_NE(error.find(part), std::string::npos) << error;
}

TEST(LoadAnimations, Channel_ArrivesAsItIs) {
  const Scene scene = loaded(movingTriangle());
  ASSERT_EQ(scene.animations.size(), 1u);
  const Animation& animation = scene.animations[0];
  EXPECT_EQ(animation.name, "move");
  ASSERT_EQ(animation.channels.size(), 1u);
  EXPECT_EQ(animation.channels[0].path, AnimatedPath::Translation);
  EXPECT_EQ(scene.nodes[animation.channels[0].node].node, 0);
  const AnimationSampler& sampler = animation.samplers[animation.channels[0].sampler];
  EXPECT_EQ(sampler.interpolation, Interpolation::Linear);
  EXPECT_EQ(sampler.times, (std::vector<float>{0, 1}));
  EXPECT_EQ(sampler.values, (std::vector<glm::vec4>{{0, 0, 0, 0}, {2, 0, 0, 0}}));
}

TEST(LoadAnimations, SeveralAnimations_KeepTheirOrder) {
  GltfDocument document = movingTriangle();
  document.json["animations"].push_back(document.json["animations"][0]);
  document.json["animations"][1]["name"] = "again";
  document.json["animations"][1]["samplers"][0]["interpolation"] = "STEP";
  const Scene scene = loaded(document);
  ASSERT_EQ(scene.animations.size(), 2u);
  EXPECT_EQ(scene.animations[1].name, "again");
  EXPECT_EQ(scene.animations[1].samplers[0].interpolation, Interpolation::Step);
}

// Integers are fractions of 1 here, even if a file fails to say so.
TEST(LoadAnimations, NormalisedIntegerRotations_AreScaledToOne) {
  for (const bool flagged : {true, false}) {
    GltfDocument document = movingTriangle();
    // Signed bytes: the identity, then 180 degrees about y. Both -128 and -127 mean -1.
    const int output = test::appendBytes(document, {0, 0, 0, 127, 0, 0x80, 0, 0}, "VEC4", 2, 5120);
    if (flagged) document.json["accessors"][static_cast<std::size_t>(output)]["normalized"] = true;
    document.json["animations"][0]["samplers"][0]["output"] = output;
    document.json["animations"][0]["channels"][0]["target"]["path"] = "rotation";
    const Scene scene = loaded(document);
    EXPECT_EQ(scene.animations[0].samplers[0].values, (std::vector<glm::vec4>{{0, 0, 0, 1}, {0, -1, 0, 0}}))
        << flagged;
  }
}

TEST(LoadAnimations, CubicSpline_NeedsThreeValuesForEachTime) {
  GltfDocument document = movingTriangle();
  document.json["animations"][0]["samplers"][0]["interpolation"] = "CUBICSPLINE";
  expectError(document, {"/animations/0/samplers/0/output", "2 values", "expected 6"});
  document.json["animations"][0]["samplers"][0]["output"] =
      test::appendFloats(document, std::vector<float>(18, 1.0f), "VEC3");
  EXPECT_EQ(loaded(document).animations[0].samplers[0].values.size(), 6u);
}

TEST(LoadAnimations, BadTimes_AreRefusedWithTheirPlace) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const std::vector<float>& times :
       {std::vector<float>{1, 1}, {1, 0.5f}, {0, nan}, {0, std::numeric_limits<float>::infinity()}}) {
    GltfDocument document = movingTriangle();
    document.json["animations"][0]["samplers"][0]["input"] = test::appendFloats(document, times, "SCALAR");
    expectError(document, {"/animations/0/samplers/0/input", "time"});
  }
}

TEST(LoadAnimations, KeysBeforeZero_CountAndTheAnimationStartsAtZero) {
  GltfDocument document = movingTriangle();
  document.json["animations"][0]["samplers"][0]["input"] = test::appendFloats(document, {-1, 1}, "SCALAR");
  Warnings warnings;
  const Scene scene = test::reload(document, warnings);
  EXPECT_TRUE(test::anyContains(warnings, "/animations/0/samplers/0/input: time 0 is -1"));
  const Animation& move = scene.animations.at(0);
  EXPECT_EQ(move.startTime(), 0.0);
  EXPECT_EQ(move.endTime(), 1.0);
  EXPECT_NEAR(sampleAt(move.samplers[0], AnimatedPath::Translation, 0.0).x, 1.0, 1e-12);
}

TEST(LoadAnimations, BadReferencesAndTypes_AreRefusedWithTheirPlace) {
  const auto changed = [](const char* pointer, const Json& value) {
    GltfDocument document = movingTriangle();
    document.json[Json::json_pointer(pointer)] = value;
    return document;
  };
  expectError(changed("/animations/0/samplers/0/input", 99), {"/samplers/0/input", "99"});
  expectError(changed("/animations/0/samplers/0/input", 4), {"/samplers/0/input", "SCALAR", "VEC3"});
  expectError(changed("/animations/0/samplers/0/output", 3), {"/samplers/0/output", "VEC3", "SCALAR"});
  expectError(changed("/animations/0/samplers/0/interpolation", "BEZIER"), {"interpolation", "BEZIER"});
  expectError(changed("/animations/0/channels/0/sampler", 1), {"/channels/0/sampler", "1"});
  expectError(changed("/animations/0/channels/0/target/node", 7), {"/target/node", "7"});
  expectError(changed("/animations/0/channels/0/target/path", 3), {"/target/path"});
  expectError(changed("/animations/0/samplers", 3), {"/animations/0/samplers"});
}

TEST(LoadAnimations, ValuesThatAreNotFinite_AreRefused) {
  GltfDocument document = movingTriangle();
  document.json["animations"][0]["samplers"][0]["output"] =
      test::appendFloats(document, {0, 0, 0, std::numeric_limits<float>::infinity(), 0, 0}, "VEC3");
  expectError(document, {"/samplers/0/output", "number 3", "inf"});
}

TEST(LoadAnimations, OnePropertyTwice_IsRefused) {
  GltfDocument document = movingTriangle();
  auto& channels = document.json["animations"][0]["channels"];
  channels.push_back(channels[0]);
  expectError(document, {"/animations/0/channels/1", "twice"});
}

TEST(LoadAnimations, WeightsAndMatrixNodes_RestWithAWarning) {
  GltfDocument document = movingTriangle();
  document.json["animations"][0]["channels"][0]["target"]["path"] = "weights";
  Warnings warnings;
  EXPECT_TRUE(test::reload(document, warnings).animations[0].channels.empty());
  EXPECT_TRUE(test::anyContains(warnings, "weights"));
  document = movingTriangle();
  document.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  warnings.clear();
  EXPECT_TRUE(test::reload(document, warnings).animations[0].channels.empty());
  EXPECT_TRUE(test::anyContains(warnings, "matrix"));
}

TEST(LoadAnimations, RotationOfLengthZero_IsNamedByItsNumber) {
  GltfDocument document = movingTriangle();
  document.json["animations"][0]["samplers"][0]["output"] =
      test::appendFloats(document, {0, 0, 0, 1, 0, 0, 0, 0}, "VEC4");
  document.json["animations"][0]["channels"][0]["target"]["path"] = "rotation";
  Warnings warnings;
  test::reload(document, warnings);
  EXPECT_TRUE(test::anyContains(warnings, "rotation 1 is of length 0"));
  EXPECT_EQ(warnings.size(), 1u);
}

TEST(LoadAnimations, NodeOutsideTheScene_IsLeftOut) {
  GltfDocument document = movingTriangle();
  document.json["nodes"].push_back({{"mesh", 0}});
  document.json["animations"][0]["channels"][0]["target"]["node"] = 1;
  EXPECT_TRUE(loaded(document).animations[0].channels.empty());
}

}  // namespace
}  // namespace prelight
