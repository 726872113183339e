#pragma once

#include <nanobind/nanobind.h>

#include <memory>

#include "prelight/load.h"

namespace prelight::python {

/// A scene as Python holds it. Arrays that look into it keep it.
struct PythonScene {
  std::shared_ptr<const LoadedScene> loaded;

  const CompiledScene& compiled() const { return loaded->compiled; }
};

/// A sky as Python holds it.
struct PythonSky {
  std::shared_ptr<const Environment> environment;
};

/// Scenes of files, built-in ones, and those of arrays.
void bindScenes(nanobind::module_& module);

/// What scenes of arrays are made of, and what scenes have: materials, lights, cameras.
void bindSceneParts(nanobind::module_& module);

}  // namespace prelight::python
