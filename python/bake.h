#pragma once

#include <nanobind/nanobind.h>

#include <memory>

#include "prelight/bake.h"

namespace prelight::python {

/// A bake as Python holds it. Arrays that look into it keep it.
struct PythonBake {
  std::shared_ptr<const Bake> bake;
  BakeReport report;  ///< empty for one that a file carries
};

/// The arrays of a bake.
void bindBakedParts(nanobind::class_<PythonBake>& bake);
void bindFurtherBakedParts(nanobind::class_<PythonBake>& bake);

/// The classes of some of its parts.
void bindFurtherParts(nanobind::module_& module);

}  // namespace prelight::python
