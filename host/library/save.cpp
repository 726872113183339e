#include <optional>

#include "base/atomic_file.h"
#include "io/baked_file.h"
#include "io/finite_results.h"
#include "prelight/load.h"
#include "projectors/light_map/light_map_file.h"
#include "scene/gltf/glb_output.h"

namespace prelight {

void save(const std::filesystem::path& path, const LoadedScene& scene, const Bake& bake) {
  if (path.extension() != ".glb")
    throw UsageError(path.string(),
                     "a baked scene is written as .glb, got '" + path.extension().string() + "'");
  GltfDocument document = *scene.document;
  embedBake(document, scene.compiled, bake);
  OutputFiles files;
  // The picture comes before the file that names it.
  if (bake.lightMap) {
    const std::filesystem::path picture = lightMapPath(path);
    requireFiniteLightMap(picture, *bake.lightMap);
    addLightMap(files, picture, *bake.lightMap);
    embedLightMap(document, scene.compiled, bake.lightMap->layout, picture.filename().string());
  }
  addGlb(files, path, document);
  files.commit();
}

}  // namespace prelight
