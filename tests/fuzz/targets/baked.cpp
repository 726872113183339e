// The extension PRELIGHT_transfer: every technique that a baked file may carry, and its removal.
#include "fuzz/glb_mutator.h"
#include "fuzz/scratch_file.h"
#include "fuzz/sound.h"
#include "fuzz/target.h"
#include "io/baked_file.h"
#include "io/baked_strip.h"
#include "io/scene_fingerprint.h"
#include "library/open_scene.h"
#include "prelight/load.h"
#include "prelight/picture.h"
#include "techniques/registry/registry.h"

namespace prelight::fuzz {

namespace {

constexpr const char* mapName =
    "radiosity.lightmap.exr";  ///< as the corpus calls it (tests/fuzz/make_corpus)

/// Writes a light map with every kind of layer if the input names one.
void writeMapFor(Bytes input, const ScratchFolder& folder) {
  const std::string_view text(reinterpret_cast<const char*>(input.data()), input.size());
  if (text.find(mapName) == std::string_view::npos) return;
  const Picture picture{2, 2, std::vector<glm::vec3>(4, {0.5f, 0.25f, 1.0f})};
  const std::vector<float> numbers(4, 1.0f);
  writePicture(folder / mapName, picture,
               std::vector<PictureChannel>{
                   {"walls.right", numbers}, {"walls.below", numbers}, {"walls.inside", numbers}});
}

void readBaked(Bytes input) {
  const ScratchFolder folder;
  writeMapFor(input, folder);
  const LoadedScene loaded =
      loadDocument([&](Warnings& warnings) { return parseGltf(input, folder / "scene.glb", warnings); }, {});
  GltfDocument stripped = *loaded.document;
  stripBake(stripped);
  const std::optional<Bake> bake = readBake(*loaded.document, loaded.compiled);
  require(!bake || readRecordedChoice(*loaded.document).baked, "a file with a bake says so");
  if (!bake) return;
  requireSound(*bake);
  checkBake(*bake, loaded.compiled);
  quantizedBytes(*loaded.document);
  summariesOf(*bake, loaded.compiled.vertexCount());
  changedSinceBake({*loaded.document, loaded.scene, loaded.compiled, *bake});
}

}  // namespace

Target baked() { return {"baked", readBaked, mutateGlb}; }

}  // namespace prelight::fuzz
