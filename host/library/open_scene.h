#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "library/steps.h"
#include "prelight/compiled_scene.h"
#include "prelight/error.h"
#include "prelight/load.h"
#include "prelight/picture.h"
#include "prelight/scene.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// A file with the scene that it holds.
struct OpenedScene {
  std::filesystem::path path;  ///< for messages
  GltfDocument document;
  Scene scene;
  CompiledScene compiled;
  std::shared_ptr<const Environment> sky;  ///< the file's own; nullptr: none
};

/// Takes a file through the steps that everything begins with: read, load, pose, compile. What `options`
/// leave open is as the file was baked. Warnings are appended.
OpenedScene openScene(const std::function<GltfDocument(Warnings&)>& read, const LoadOptions& options,
                      Warnings& warnings, Steps& steps);

/// The same for who is not told of the steps.
LoadedScene loadDocument(const std::function<GltfDocument(Warnings&)>& read, const LoadOptions& options);

/// Throws InputError for a scene without triangles; `use` says what there is nothing for ("to bake").
void requireTriangles(const std::filesystem::path& path, const CompiledScene& scene, const char* use);

}  // namespace prelight
