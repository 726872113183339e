#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "prelight/options.h"

namespace prelight::test {

/// Options with one number out of range, with that number's row and value.
template <typename Options>
struct BadNumber {
  const Option<Options>* row;
  double value;
  Options options;
};

/// For every number of a structure, values that are too small, too large, negative, infinite and NaN, as far
/// as its type can hold them.
template <typename Options>
std::vector<BadNumber<Options>> badNumbersOf(const Options& sound) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<BadNumber<Options>> bad;
  for (const Option<Options>& row : optionsOf<Options>()) {
    if (row.kind != OptionKind::Number) continue;
    const bool real = row.range.kind == NumberKind::Real;
    std::vector<double> values = {row.range.least - 1.0, row.range.most + 1.0, -1.0 - row.range.most};
    if (real)
      values.insert(values.end(), {0.5 * row.range.least, 2.0 * row.range.most, infinity, -infinity,
                                   std::numeric_limits<double>::quiet_NaN()});
    if (row.range.kind == NumberKind::PowerOfTwo) values.push_back(3.0);
    for (const double value : values) {
      if (row.range.allows(value)) continue;
      BadNumber<Options> one{&row, value, sound};
      // Converting to a type without such a value is the caller's fault, and undefined.
      if (!real && (value < 0.0 || value > 4e9)) continue;
      row.set(one.options, value);
      if (std::isnan(value) || row.get(one.options) == value) bad.push_back(one);
    }
  }
  return bad;
}

}  // namespace prelight::test
