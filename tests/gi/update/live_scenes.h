#pragma once

#include <string>

#include "occluders/rigid_motion.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"

namespace prelight::test {

/// A built-in scene, loaded and compiled.
struct LoadedScene {
  explicit LoadedScene(const std::string& name)
      : scene(loadScene(makeBuiltinScene(name), warnings)), compiled(compileScene(scene, warnings)) {}

  int node(const std::string& name) const {
    for (const MeshNode& n : scene.meshNodes)
      if (n.name == name) return n.node;
    return -1;
  }

  Warnings warnings;
  Scene scene;
  CompiledScene compiled;
};

inline RigidMotion shifted(double x, double y, double z) { return {glm::dmat3(1.0), {x, y, z}}; }

}  // namespace prelight::test
