#pragma once

#include <nanobind/nanobind.h>

#include "prelight/parameters.h"

namespace prelight::python {

/// Gives a class of options the ranges of its numbers, {field: allowed values as text}, for messages about
/// values of other types (prelight/arguments.py).
template <typename Options>
void addRanges(nanobind::handle optionsClass) {
  nanobind::dict ranges;
  for (const Parameter<Options>& parameter : parametersOf<Options>())
    ranges[parameter.field] = parameter.range.textWithZero();
  optionsClass.attr("_ranges") = ranges;
}

}  // namespace prelight::python
