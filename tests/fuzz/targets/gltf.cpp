// glTF and GLB with every extension and decoder, posed at moments of every animation, written and read again.
#include <algorithm>
#include <string>

#include "fuzz/glb_mutator.h"
#include "fuzz/scratch_file.h"
#include "fuzz/sound.h"
#include "fuzz/target.h"
#include "library/open_scene.h"
#include "prelight/compiled_scene.h"
#include "prelight/load.h"
#include "scene/gltf/gltf_document.h"
#include "scene/pose.h"

namespace prelight::fuzz {

namespace {

/// Loads from an empty folder, so that no input reads other files.
LoadedScene loadFrom(Bytes input, const LoadOptions& options) {
  const ScratchFolder folder;
  return loadDocument(
      [&](Warnings& warnings) {
        return parseGltf(input, folder / "scene.glb", warnings, {.tellOddities = true});
      },
      options);
}

/// Compiles the scene in the first, a middle and the last moment of every animation.
void pose(const LoadedScene& loaded) {
  constexpr std::size_t mostAnimations = 4;
  Scene scene = loaded.scene;
  for (std::size_t i = 0; i < std::min(scene.animations.size(), mostAnimations); ++i) {
    const double start = scene.animations[i].startTime(), end = scene.animations[i].endTime();
    for (const double seconds : {start, 0.5 * (start + end), end}) {
      setPose(scene, i, seconds);
      Warnings warnings;
      requireSound(scene, compileScene(scene, warnings));
    }
  }
}

/// Loads the scene in every variant of its materials.
void vary(const LoadedScene& loaded, Bytes input) {
  constexpr std::size_t mostVariants = 3;
  for (std::size_t i = 0; i < std::min(loaded.scene.variants.size(), mostVariants); ++i)
    if (!loaded.scene.variants[i].empty()) {
      const LoadedScene varied = loadFrom(input, {.variant = loaded.scene.variants[i]});
      requireSound(varied.scene, varied.compiled);
    }
}

void readGltfFile(Bytes input) {
  const LoadedScene loaded = loadFrom(input, {});
  requireSound(loaded.scene, loaded.compiled);
  if (loaded.sky) requireSound(*loaded.sky);
  pose(loaded);
  vary(loaded, input);
}

}  // namespace

Target gltf() { return {"gltf", readGltfFile, mutateGlb}; }

}  // namespace prelight::fuzz
