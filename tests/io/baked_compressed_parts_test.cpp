#include <gtest/gtest.h>

#include <cmath>

#include "compress/compressed_parts.h"
#include "io/baked_file.h"
#include "io/misfit.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

/// Two nodes with a triangle each, and an animation.
GltfDocument playedTriangles() {
  GltfDocument document = test::triangleDocument();
  document.json["nodes"].push_back({{"name", "other"}, {"mesh", 0}});
  document.json["scenes"][0]["nodes"] = {1, 0};
  document.json["animations"] = Json::array({Json::object()});
  return document;
}

/// Smooth numbers between -2 and 2 that depend on `first`.
std::vector<float> waves(std::size_t count, double first) {
  std::vector<float> values;
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(static_cast<float>(std::sin(first + 0.7 * double(i)) + std::cos(0.31 * double(i))));
  return values;
}

ChartTransfer::Map mapOf(const CompiledScene& scene, std::size_t primitive, int width, int height) {
  ChartTransfer::Map map{primitive, width, height, {}, {}};
  map.coords.assign(scene.primitives[primitive].vertexCount, {0.5f, 0.25f});
  map.coefficients = waves(map.texels() * 12, double(primitive));
  return map;
}

/// A bake with keys, texels and a volume in three channels, of order 2.
Bake bakeOf(const CompiledScene& scene) {
  Bake bake;
  bake.animation = AnimatedTransfer{0, {0.0, 0.5, 1.0}, {}};
  for (const double first : {1.0, 2.0, 3.0})
    bake.animation->keys.push_back({2, 3, 1, waves(12 * scene.vertexCount(), first)});
  bake.chartTransfer = ChartTransfer{2, 3, 1, {mapOf(scene, 0, 3, 2), mapOf(scene, 1, 2, 4)}};
  VolumeTransfer volume;
  volume.grid = {{2, 3, 4}, {0, 0, 0}, {2, 3, 4}};
  volume.order = 2;
  volume.channels = 3;
  volume.bounces = 1;
  volume.coefficients = waves(24 * 12, 4.0);
  volume.direct = waves(24 * 4, 5.0);
  volume.air.assign(24, 1);
  volume.sentOrder = 2;
  volume.sent = waves(24 * 3 * 4 * 4, 6.0);
  bake.volume = std::move(volume);
  return bake;
}

std::vector<std::vector<float>> partsOf(const Bake& bake) {
  std::vector<std::vector<float>> parts;
  for (const HarmonicTransfer& key : bake.animation->keys) parts.push_back(key.coefficients);
  for (const ChartTransfer::Map& map : bake.chartTransfer->maps) parts.push_back(map.coefficients);
  parts.push_back(bake.volume->coefficients);
  parts.push_back(bake.volume->direct);
  parts.push_back(bake.volume->sent);
  return parts;
}

class CompressedPart : public testing::TestWithParam<const char*> {};

TEST_P(CompressedPart, WriteRead_GivesWhatTheBakeHolds) {
  GltfDocument document = playedTriangles();
  const CompiledScene scene = test::compileDocument(document);
  Bake bake = bakeOf(scene);
  const std::vector<double> surface(scene.vertexCount(), 1.0);
  const auto compressed = compressParts(parseCompression(GetParam()), surface, bake);
  EXPECT_EQ(compressed.size(), 5u);
  embedBake(document, scene, bake);
  const std::optional<Bake> read = readBake(document, scene);
  ASSERT_TRUE(read && read->animation && read->chartTransfer && read->volume);
  EXPECT_EQ(partsOf(*read), partsOf(bake));
  EXPECT_EQ(read->chartTransfer->maps[1].primitive, 1u);
  // A file written again from the loaded bake is the same.
  GltfDocument again = playedTriangles();
  embedBake(again, scene, *read);
  EXPECT_EQ(again.json["nodes"], document.json["nodes"]);
  EXPECT_EQ(again.bin, document.bin);
  embedBake(again, scene, Bake{});
  EXPECT_EQ(again.json["accessors"], playedTriangles().json["accessors"]);
}

INSTANTIATE_TEST_SUITE_P(Methods, CompressedPart,
                         testing::Values("half", "band8", "rgbe", "pca:2", "cpca:2:1:byte", "vq:3"),
                         [](const auto& instance) {
                           std::string name = instance.param;
                           std::erase(name, ':');
                           return name;
                         });

TEST(CompressPart, Halves_AreNearestAndHalfAsLarge) {
  const CompiledScene scene = test::compileDocument(playedTriangles());
  const Bake full = bakeOf(scene);
  Bake bake = full;
  const auto done = compressParts(parseCompression("half"), std::vector(scene.vertexCount(), 1.0), bake);
  for (const PartCompression& part : done) {
    EXPECT_EQ(2 * part.bytes, part.floatBytes) << part.part;
    EXPECT_GT(part.error, 0.0);
  }
  const auto before = partsOf(full), after = partsOf(bake);
  for (std::size_t p = 0; p < before.size(); ++p)
    for (std::size_t i = 0; i < before[p].size(); ++i)
      // Half of the last place of a half-precision number, plus that of the least one.
      EXPECT_NEAR(after[p][i], before[p][i],
                  std::abs(before[p][i]) * std::ldexp(1.0, -11) + std::ldexp(1.0, -25));
}

TEST(CompressPart, MethodThatWouldTakeMore_LeavesThePartAlone) {
  const CompiledScene scene = test::compileDocument(playedTriangles());
  Bake bake;
  bake.volume = bakeOf(scene).volume;
  const std::vector<float> sent = bake.volume->sent;
  const auto done = compressParts(parseCompression("cpca:24:8:float"), {}, bake);
  ASSERT_EQ(done.size(), 3u);
  EXPECT_EQ(done[2].bytes, done[2].floatBytes);
  EXPECT_EQ(done[2].error, 0.0);
  EXPECT_FALSE(bake.compressedParts.volumeSent);
  EXPECT_EQ(bake.volume->sent, sent);
}

using test::Misfit;

class MisfitParts : public testing::TestWithParam<Misfit> {};

TEST_P(MisfitParts, Read_ThrowsNamingThePlace) {
  const GltfDocument document = playedTriangles();
  const CompiledScene scene = test::compileDocument(document);
  Bake bake = bakeOf(scene);
  compressParts(parseCompression("cpca:2:1"), std::vector(scene.vertexCount(), 1.0), bake);
  test::expectRefused(document, bake, scene, GetParam());
}

#define ENTRY "/nodes/0/extensions/PRELIGHT_transfer/primitives/0"
#define ROOT "/extensions/PRELIGHT_transfer"
const Misfit partMisfits[] = {
    {"TexelsShared", ROOT "/texelsCompressed", "3", "texelsCompressed"},
    {"TexelsOrder", ROOT "/texelsCompressed/order", "3", "texelsCompressed/means"},
    {"TexelsWidth", ENTRY "/texels/width", "5", "texels/compressed/clusters: expected"},
    {"TexelsMethod", ROOT "/texelsCompressed/method", "\"zip\"",
     "texelsCompressed/method: expected one of half"},
    {"KeysShared", ROOT "/animation/shCompressed", "[]", "animation/shCompressed"},
    {"KeysMissing", ENTRY "/keys/1", "{}", "keys/1"},
    {"KeysWeights", ENTRY "/keys/2/shCompressed/weights", "999", "shCompressed/weights"},
    {"VolumeChannels", ROOT "/volume/coefficientsCompressed/channels", "1", "coefficientsCompressed/means"},
    {"VolumeBytes", ROOT "/volume/sentCompressed/channels", "99", "sentCompressed/channels"},
    {"VolumeClusters", ROOT "/volume/directCompressed/clusterCount", "1", "directCompressed"},
    {"VolumeMissing", ROOT "/volume/coefficientsCompressed", "null", "volume"},
};
#undef ENTRY
#undef ROOT

INSTANTIATE_TEST_SUITE_P(Table, MisfitParts, testing::ValuesIn(partMisfits),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace prelight
