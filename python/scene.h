#pragma once

#include <nanobind/nanobind.h>

#include <memory>

#include "prelight/load.h"

namespace prelight::python {

/// A scene for Python. Arrays that look into it keep it alive.
struct PythonScene {
  std::shared_ptr<const LoadedScene> loaded;

  const CompiledScene& compiled() const { return loaded->compiled; }
};

/// A sky for Python.
struct PythonSky {
  std::shared_ptr<const Environment> environment;
};

/// Binds scenes from files, built-in scenes and scenes from arrays.
void bindScenes(nanobind::module_& module);

/// Binds the parts of scenes: materials, lights and cameras.
void bindSceneParts(nanobind::module_& module);

}  // namespace prelight::python
