#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <optional>
#include <string>
#include <string_view>

#include "prelight/options.h"

namespace prelight::python {

/// Returns the name of the argument that sets an option: "haar_error".
std::string argumentOf(const OptionInfo& row);

/// Returns the argument that sets a member which the library's messages name: "haar_error".
std::string argumentOfField(std::string_view field);

/// Returns the number that stands for an object from Python. Throws UsageError for an object of another type
/// and for a value that the option may not have.
double valueOf(const OptionInfo& row, nanobind::handle object);

/// Returns the object from Python that a number stands for; None for nothing.
nanobind::object objectOf(const OptionInfo& row, std::optional<double> value);

/// Returns the arguments of prelight.Option (prelight/options.py).
nanobind::tuple describe(const OptionInfo& row, std::optional<double> usual);

/// Binds the table of `Options` to a class: `_set(name, value)` sets an option and returns whether there is
/// one of this name, and `_options` describes all. `optionsIn` returns the
/// options in an object of the class.
template <typename Options, typename Class, typename OptionsIn>
void bindRows(nanobind::class_<Class>& bound, OptionsIn optionsIn) {
  bound.def(
      "_set",
      [optionsIn](Class& object, const std::string& name, nanobind::object value) {
        for (const Option<Options>& row : optionsOf<Options>()) {
          if (row.kind == OptionKind::Own || argumentOf(row) != name) continue;
          if (!value.is_none() || row.usualValue()) row.set(optionsIn(object), valueOf(row, value));
          return true;
        }
        return false;
      },
      nanobind::arg(), nanobind::arg().none());
  nanobind::list rows;
  for (const Option<Options>& row : optionsOf<Options>()) rows.append(describe(row, row.usualValue()));
  bound.attr("_options") = rows;
}

template <typename Options>
void bindRows(nanobind::class_<Options>& bound) {
  bindRows<Options>(bound, [](Options& options) -> Options& { return options; });
}

}  // namespace prelight::python
