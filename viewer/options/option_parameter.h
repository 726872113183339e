#pragma once

#include <algorithm>
#include <cmath>
#include <span>

namespace prelight::viewer {

/// A number of a structure of options, as the command line and the window offer it.
template <typename Options>
struct OptionParameter {
  const char* option;            ///< of render and view
  const char* label;             ///< in the window
  double least, most;            ///< what is taken at all
  double usualLeast, usualMost;  ///< what is of use: the slider's ends
  const char* help;
  double (*get)(const Options&);
  void (*set)(Options&, double);
  bool isWhole = false;
};

/// The options with every number in its range; NaN becomes the default.
template <typename Options>
Options withinRanges(Options options, std::span<const OptionParameter<Options>> parameters) {
  const Options defaults;
  for (const OptionParameter<Options>& parameter : parameters) {
    const double value = parameter.get(options);
    parameter.set(options, std::isnan(value) ? parameter.get(defaults)
                                             : std::clamp(value, parameter.least, parameter.most));
  }
  return options;
}

}  // namespace prelight::viewer
