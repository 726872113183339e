#pragma once

#include <nanobind/nanobind.h>

namespace prelight::python {

/// Makes the library's errors Python's: those of prelight/errors.py.
void bindErrors(nanobind::module_& module);

}  // namespace prelight::python
