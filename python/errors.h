#pragma once

#include <nanobind/nanobind.h>

namespace prelight::python {

/// Translates the library's errors into the classes of prelight/errors.py.
void bindErrors(nanobind::module_& module);

}  // namespace prelight::python
