// A damaged file with compressed parts gives a scene or an InputError, nothing else.
#include <gtest/gtest.h>

#include <random>

#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/compressed_files.h"
#include "support/environment_variable.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

/// How many of `rounds` damaged files still load. Half of the damage hits the JSON, half the data.
int loadedOf(const GltfDocument& document, int rounds, unsigned seed) {
  const test::EnvironmentVariable decodeHere("PRELIGHT_SANDBOX", "0");  // where a crash is seen
  const test::TemporaryFolder folder;
  writeGlb(folder / "good.glb", document);
  const std::string good = test::readBytes(folder / "good.glb");
  const std::size_t data = good.find("BIN");
  std::mt19937 random(seed);
  int loaded = 0;
  for (int i = 0; i < rounds; ++i) {
    std::string bytes = good;
    for (auto flips = 1 + random() % 3; flips > 0; --flips) {
      if (random() % 2 == 0) {
        bytes[data + 4 + random() % (bytes.size() - data - 4)] = static_cast<char>(random());
      } else if (const std::size_t at = good.find_first_of("0123456789", 20 + random() % (data - 20));
                 at < data) {
        bytes[at] = static_cast<char>('0' + random() % 10);
      }
    }
    Warnings warnings;
    try {
      const GltfDocument read = parseGltf(
          std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), "a.glb", warnings);
      compileScene(loadScene(read, warnings), warnings);
      ++loaded;
    } catch (const InputError&) {
    }
  }
  return loaded;
}

TEST(ReadGltf, DamagedDraco_ThrowsInputErrorOrLoads) {
  for (const bool edgebreaker : {false, true}) {
    const int loaded = loadedOf(test::withDraco(makeBuiltinScene("cornell"), {edgebreaker, 11, 8}), 800, 5);
    EXPECT_GT(loaded, 50);
    EXPECT_LT(loaded, 750);
  }
}

TEST(ReadGltf, DamagedMeshopt_ThrowsInputErrorOrLoads) {
  const int loaded = loadedOf(test::withMeshopt(makeBuiltinScene("cornell")), 1500, 6);
  EXPECT_GT(loaded, 50);
  EXPECT_LT(loaded, 1450);
}

/// A view claims a huge number of elements, but each file is a few hundred bytes long. It is refused within
/// the available memory.
TEST(ReadGltf, CompressedBombs_AreRefused) {
  const test::TemporaryFolder folder;
  const std::uint64_t count = std::uint64_t{1} << 40;
  GltfDocument document = test::withMeshopt(test::triangleDocument());
  for (auto& view : document.json["bufferViews"]) {
    view["byteLength"] = count * 12;
    view["extensions"]["EXT_meshopt_compression"]["count"] = count;
    view["extensions"]["EXT_meshopt_compression"]["byteStride"] = 12;
    view["extensions"]["EXT_meshopt_compression"]["mode"] = "ATTRIBUTES";
  }
  document.json["buffers"][1]["byteLength"] = count * 12;
  Warnings warnings;
  EXPECT_THROW((void)test::reload(document, warnings), InputError);
}

/// Ten thousand views of one stream would be a thousand times as large as the file.
TEST(ReadGltf, ManyViewsOfOneStream_AreRefusedTogether) {
  const std::vector<std::uint8_t> zeros(std::size_t{1} << 22);
  GltfDocument document = test::triangleDocument();
  const int accessor = test::appendBytes(document, zeros, "SCALAR", zeros.size() / 4, 5125);
  const auto view = document.json["accessors"][accessor]["bufferView"].get<std::size_t>();
  document.bin.resize(document.bin.size() - zeros.size());
  document.json["extensionsUsed"] = {"EXT_meshopt_compression"};
  test::compressView(document, view, test::meshoptAttributes(zeros.data(), zeros.size() / 256, 256),
                     {{"count", zeros.size() / 256}, {"byteStride", 256}, {"mode", "ATTRIBUTES"}});
  auto& json = document.json;
  for (int i = 0; i < 10000; ++i)
    json["bufferViews"].push_back(nlohmann::ordered_json(json["bufferViews"][view]));
  Warnings warnings;
  (void)test::reload(document, warnings);
  EXPECT_TRUE(test::anyContains(warnings, "for so small a file"));
}

}  // namespace
}  // namespace prelight
