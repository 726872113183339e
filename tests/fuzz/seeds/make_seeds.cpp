// Writes the seeds of all targets into a folder, TARGET/FILE, and the scene that is baked for `baked`
// (tests/fuzz/make_corpus).
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "fuzz/seeds/seeds.h"
#include "support/gltf_files.h"

namespace prelight::fuzz {

Seed glbOf(const GltfDocument& document) {
  const test::TemporaryFolder folder;
  writeGlb(folder / "seed.glb", document);
  return bytesOf(test::readBytes(folder / "seed.glb"));
}

Seed bytesOf(const std::string& text) { return {text.begin(), text.end()}; }

}  // namespace prelight::fuzz

int main(int count, char** arguments) {
  using namespace prelight::fuzz;
  if (count != 2) {
    std::fputs("usage: prelight_fuzz_seeds FOLDER\n", stderr);
    return 2;
  }
  Seeds seeds;
  addSceneSeeds(seeds);
  addStreamSeeds(seeds);
  addPictureSeeds(seeds);
  addTextSeeds(seeds);
  addStateSeeds(seeds);
  addPartSeeds(seeds);
  seeds["room.glb"] = glbOf(roomToBake());
  for (const auto& [name, bytes] : seeds) {
    const std::filesystem::path path = std::filesystem::path(arguments[1]) / name;
    std::filesystem::create_directories(path.parent_path());
    prelight::test::writeBytes(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
  return 0;
}
