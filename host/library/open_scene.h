#pragma once

#include <filesystem>
#include <functional>

#include "prelight/compiled_scene.h"
#include "prelight/error.h"
#include "prelight/load.h"
#include "prelight/picture.h"
#include "prelight/progress.h"
#include "prelight/scene.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// The steps of a call, which derived classes may time. A call may be interrupted between steps.
class Steps {
 public:
  /// The progress must outlive the object.
  explicit Steps(Progress& progress) : progress_(progress) {}
  virtual ~Steps() = default;
  Steps(const Steps&) = delete;
  Steps& operator=(const Steps&) = delete;

  /// Runs a step. Throws what the work throws, and Interrupted.
  void run(const char* name, const std::function<void()>& work) {
    measure(name, work);
    progress_.check();
  }

  Progress& progress() { return progress_; }

 private:
  virtual void measure(const char* /*name*/, const std::function<void()>& work) { work(); }

  Progress& progress_;
};

/// Reads, loads, poses and compiles a scene. Choices that `options` leave open are those of the file's bake.
LoadedScene openScene(const std::function<GltfDocument(Warnings&)>& read, const LoadOptions& options,
                      Steps& steps);

/// Returns the document of a scene of openScene() for changes. It is copied first if other scenes share it.
GltfDocument& ownDocument(LoadedScene& scene);

/// Opens a scene without reporting the steps.
LoadedScene loadDocument(const std::function<GltfDocument(Warnings&)>& read, const LoadOptions& options);

/// Throws InputError for a scene without triangles; `use` says what it is needed for, such as "to bake".
void requireTriangles(const std::filesystem::path& path, const CompiledScene& scene, const char* use);

}  // namespace prelight
