#include "python/errors.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>

#include <exception>

#include "prelight/error.h"
#include "python/option_rows.h"

namespace prelight::python {

namespace nb = nanobind;

namespace {

/// Raises the exception in Python, where the classes and the Python names of fields are known.
void raise(const Error& error) {
  const nb::object made =
      nb::module_::import_("prelight.errors")
          .attr("of_library")(static_cast<int>(error.code()), error.where(), error.problem(), error.fix());
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(made.ptr())), made.ptr());
}

}  // namespace

void bindErrors(nb::module_& module) {
  module.def("_argument_of", &argumentOfField);
  nb::register_exception_translator([](const std::exception_ptr& thrown, void* /*payload*/) {
    try {
      std::rethrow_exception(thrown);
    } catch (const Error& error) {
      raise(error);
    }
  });
}

}  // namespace prelight::python
