#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>
#include <utility>

#include "basis/cube_map.h"
#include "io/baked_file.h"
#include "scene/builtin/builtin.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

std::vector<float> someNumbers(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<float> numbers;
  for (std::size_t i = 0; i < count; ++i)
    numbers.push_back(std::uniform_real_distribution<float>(-1, 1)(random));
  return numbers;
}

/// Wavelet rows of 0 to 4 coefficients.
HaarTransfer someWavelets(std::size_t vertices) {
  HaarTransfer haar{4, 3, 2, {0}, {}, {}};
  for (std::size_t row = 0; row < 3 * vertices; ++row) {
    for (std::size_t i = 0; i < row % 5; ++i) {
      haar.indices.push_back(static_cast<std::uint32_t>(20 * i + row % 16));
      haar.values.push_back(0.5f * static_cast<float>(row) - static_cast<float>(i));
    }
    haar.offsets.push_back(static_cast<std::uint32_t>(haar.indices.size()));
  }
  return haar;
}

Bake everyTechnique(std::size_t vertices) {
  Bake bake;
  bake.ch = HarmonicTransfer{3, 3, 2, someNumbers(vertices * 27, 1), true};
  bake.haar = someWavelets(vertices);
  bake.glossy = GlossyTransfer{2, 1, 0, someNumbers(vertices * 16, 2)};
  bake.lightGroups = LightGroupTransfer{
      {{"lamps", {3, 2, 1}}, {"sky \"light\"", {0, 0, 0.5f}}}, 3, 1, someNumbers(vertices * 6, 3)};
  return bake;
}

/// The bake after a round trip through a file.
Bake copyOf(GltfDocument document, const CompiledScene& scene, const Bake& bake) {
  const test::TemporaryFolder folder;
  embedBake(document, scene, bake);
  writeGlb(folder / "baked.glb", document);
  Warnings warnings;
  const std::optional<Bake> copy = readBake(readGltf(folder / "baked.glb", warnings), scene);
  EXPECT_TRUE(warnings.empty());
  return copy.value_or(Bake{});
}

TEST(BakedTechniques, WriteRead_GivesEveryOneBack) {
  const GltfDocument document = makeBuiltinScene("cornell");
  const CompiledScene scene = test::compileDocument(document);
  const Bake bake = everyTechnique(scene.vertexCount()), copy = copyOf(document, scene, bake);
  ASSERT_TRUE(copy.ch && copy.haar && copy.glossy && copy.lightGroups);
  EXPECT_FALSE(copy.sh);
  EXPECT_EQ(copy.ch->coefficients, bake.ch->coefficients);
  EXPECT_TRUE(copy.ch->naive);
  EXPECT_EQ(copy.haar->faceSize, 4);
  EXPECT_EQ(copy.haar->offsets, bake.haar->offsets);
  EXPECT_EQ(copy.haar->indices, bake.haar->indices);
  EXPECT_EQ(copy.haar->values, bake.haar->values);
  EXPECT_EQ(copy.glossy->matrices, bake.glossy->matrices);
  EXPECT_EQ(copy.lightGroups->coefficients, bake.lightGroups->coefficients);
  ASSERT_EQ(copy.lightGroups->groups.size(), 2u);
  EXPECT_EQ(copy.lightGroups->groups[1].name, "sky \"light\"");
  EXPECT_EQ(copy.lightGroups->groups[1].color, glm::vec3(0, 0, 0.5f));
}

/// One row per vertex, with the first and the last coefficients of its face size.
Bake longRows(int faceSize, std::uint32_t vertices) {
  const auto last = static_cast<std::uint32_t>(cubeTexelCount(faceSize)) - 1;
  Bake bake;
  bake.haar = HaarTransfer{faceSize, 1, 0, {0}, {}, {}};
  for (std::uint32_t v = 0; v < vertices; ++v) {
    bake.haar->indices.insert(bake.haar->indices.end(), {v, last / 2, last - v});
    bake.haar->values.insert(bake.haar->values.end(), {1.0f, -2.0f, 0.5f});
    bake.haar->offsets.push_back(static_cast<std::uint32_t>(bake.haar->indices.size()));
  }
  return bake;
}

Json& haarOf(GltfDocument& document) {
  return document.json["nodes"][0]["extensions"]["PRELIGHT_transfer"]["primitives"][0]["haar"];
}

struct IndexWidth {
  int faceSize;
  int componentType;
};

class WaveletIndices : public testing::TestWithParam<IndexWidth> {};

TEST_P(WaveletIndices, WriteRead_TakeTheBitsTheyNeed) {
  GltfDocument document = test::triangleDocument();
  const CompiledScene scene = test::compileDocument(document);
  const Bake bake = longRows(GetParam().faceSize, 3);
  EXPECT_EQ(copyOf(document, scene, bake).haar->indices, bake.haar->indices);
  embedBake(document, scene, bake);
  EXPECT_EQ(document.json["accessors"][haarOf(document)["indices"].get<std::size_t>()]["componentType"],
            GetParam().componentType);
}

INSTANTIATE_TEST_SUITE_P(Table, WaveletIndices,
                         testing::Values(IndexWidth{32, 5123}, IndexWidth{64, 5123}, IndexWidth{128, 5125}),
                         [](const auto& instance) {
                           return "FaceSize" + std::to_string(instance.param.faceSize);
                         });

// Files of the first versions use 32 bits for every face size.
TEST(BakedTechniques, WaveletIndicesLongerThanTheyNeed_AreRead) {
  GltfDocument document = test::triangleDocument();
  const CompiledScene scene = test::compileDocument(document);
  const Bake bake = longRows(32, 3);
  embedBake(document, scene, bake);
  haarOf(document)["indices"] =
      appendAccessor(document, std::as_bytes(std::span(bake.haar->indices)), "SCALAR", 5125, 9);
  EXPECT_EQ(readBake(document, scene)->haar->indices, bake.haar->indices);
}

TEST(BakedTechniques, WaveletIndicesOfOtherTypes_AreRefused) {
  GltfDocument document = test::triangleDocument();
  const CompiledScene scene = test::compileDocument(document);
  embedBake(document, scene, longRows(32, 3));
  haarOf(document)["indices"] = haarOf(document)["values"];
  const std::string message = test::inputErrorOf([&] { readBake(document, scene); });
  EXPECT_NE(message.find("haar/indices: expected an accessor of type SCALAR"), std::string::npos) << message;
}

TEST(BakedTechniques, WaveletsOfNothing_AreReadBackEmpty) {
  const GltfDocument document = test::triangleDocument();
  const CompiledScene scene = test::compileDocument(document);
  Bake bake;
  bake.haar = HaarTransfer{2, 1, 0, {0, 0, 0, 0}, {}, {}};
  const Bake copy = copyOf(document, scene, bake);
  ASSERT_TRUE(copy.haar);
  EXPECT_EQ(copy.haar->offsets, bake.haar->offsets);
  EXPECT_TRUE(copy.haar->indices.empty());
}

TEST(BakedTechniques, Compressed_IsReadBackAsItWas) {
  const GltfDocument document = makeBuiltinScene("shapes");
  const CompiledScene scene = test::compileDocument(document);
  const HarmonicTransfer sh{3, 3, 1, someNumbers(scene.vertexCount() * 27, 5), false};
  for (const char* method :
       {"half", "band8", "rgbe", "pca:4", "pca:3:byte", "vq:8", "cpca:4:2:float", "cpca:4:2:byte"}) {
    Bake bake;
    bake.compressedSh = compress(sh, parseCompression(method));
    const Bake copy = copyOf(document, scene, bake);
    ASSERT_TRUE(copy.compressedSh) << method;
    EXPECT_FALSE(copy.sh);
    EXPECT_EQ(decompress(*copy.compressedSh).coefficients, decompress(*bake.compressedSh).coefficients)
        << method;
  }
}

TEST(BakedTechniques, BakingAgain_LeavesNothingOfThem) {
  GltfDocument document = makeBuiltinScene("shapes");
  const CompiledScene scene = test::compileDocument(document);
  const Json accessors = document.json["accessors"];
  Bake bake = everyTechnique(scene.vertexCount());
  const HarmonicTransfer sh{2, 1, 0, someNumbers(scene.vertexCount() * 4, 6), false};
  bake.compressedSh = compress(sh, parseCompression("cpca:3:2:byte"));
  embedBake(document, scene, bake);
  embedBake(document, scene, Bake{});
  EXPECT_TRUE(document.json["accessors"] == accessors);
}

struct Damage {
  const char* name;
  std::function<void(Bake&)> change;
  const char* expected;
};

// The writer refuses non-finite numbers: these markers stand for them until the file is written.
constexpr float nanMarker = 0.7654321f, infinityMarker = 0.8765432f;

bool holds(const Bake& bake, float marker) {
  return bake.haar->values[0] == marker || bake.ch->coefficients[4] == marker;
}

class DamagedTechnique : public testing::TestWithParam<Damage> {};

TEST_P(DamagedTechnique, Read_NamesThePlace) {
  GltfDocument document = test::triangleDocument();
  const CompiledScene scene = test::compileDocument(document);
  Bake bake = everyTechnique(scene.vertexCount());
  GetParam().change(bake);
  embedBake(document, scene, bake);
  for (const auto& [marker, value] : {std::pair{nanMarker, std::numeric_limits<float>::quiet_NaN()},
                                      std::pair{infinityMarker, std::numeric_limits<float>::infinity()}})
    if (holds(bake, marker)) test::replaceFloats(document, marker, value);
  const std::string message = test::inputErrorOf([&] { readBake(document, scene); });
  EXPECT_NE(message.find(GetParam().expected), std::string::npos) << message;
}

const Damage damages[] = {
    {"FaceSize", [](Bake& b) { b.haar->faceSize = 3; }, "haar/faceSize: expected a power of two"},
    {"IndexTooLarge", [](Bake& b) { b.haar->indices.back() = 96; }, "haar/indices: index"},
    {"IndexTwice", [](Bake& b) { b.haar->indices[2] = b.haar->indices[1]; }, "expected ascending indices"},
    {"OffsetsFall", [](Bake& b) { b.haar->offsets[2] = 100000; },
     "haar/offsets: expected offsets that ascend"},
    {"WaveletNan", [](Bake& b) { b.haar->values[0] = nanMarker; }, "haar/values: value 0"},
    {"GlossyOrder", [](Bake& b) { b.glossy->order = 0; }, "glossy/order: expected 1.."},
    {"GroupColour", [](Bake& b) { b.lightGroups->groups[0].color.x = -1.0f; }, "lightGroups/0/color"},
    {"ChInfinite", [](Bake& b) { b.ch->coefficients[4] = infinityMarker; }, "ch/coefficients: value 4"},
};

INSTANTIATE_TEST_SUITE_P(Table, DamagedTechnique, testing::ValuesIn(damages),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace prelight
