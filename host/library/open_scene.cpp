#include "library/open_scene.h"

#include <fmt/format.h>

#include "scene/gltf/loader.h"

namespace prelight {

OpenedScene openScene(const std::function<GltfDocument(Warnings&)>& read, Warnings& warnings, Steps& steps) {
  OpenedScene opened;
  steps.run("load", [&] {
    opened.document = read(warnings);
    steps.progress().check();
    opened.scene = loadScene(opened.document, warnings);
  });
  opened.path = opened.document.path;
  steps.run("compile", [&] { opened.compiled = compileScene(opened.scene, warnings); });
  return opened;
}

void requireTriangles(const std::filesystem::path& path, const CompiledScene& scene, const char* use) {
  if (scene.triangleCount() > 0) return;
  const std::string dropped =
      scene.droppedTriangles == 0 ? "" : fmt::format(", only {} of zero area", scene.droppedTriangles);
  throw InputError(path.string(),
                   fmt::format("the scene has no triangles{}; there is nothing {}", dropped, use),
                   "export meshes along with it");
}

}  // namespace prelight
