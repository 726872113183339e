#pragma once

#include <nanobind/nanobind.h>

#include <memory>

#include "prelight/bake.h"

namespace prelight::python {

/// A bake for Python. Arrays that look into it keep it alive.
struct PythonBake {
  std::shared_ptr<const Bake> bake;
  BakeReport report;  ///< empty for a bake from a file
};

/// Bind the arrays of a bake.
void bindBakedParts(nanobind::class_<PythonBake>& bake);
void bindFurtherBakedParts(nanobind::class_<PythonBake>& bake);

/// Binds the classes of some parts of a bake.
void bindFurtherParts(nanobind::module_& module);

}  // namespace prelight::python
