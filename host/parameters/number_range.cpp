#include <fmt/format.h>

#include <cmath>

#include "prelight/error.h"
#include "prelight/parameters.h"

namespace prelight {

bool NumberRange::contains(double value) const {
  if (!(value >= least && value <= most)) return false;
  int exponent = 0;
  switch (kind) {
    case NumberKind::Real:
      return true;
    case NumberKind::Whole:
    case NumberKind::Bytes:
      return value == std::floor(value);
    case NumberKind::PowerOfTwo:
      return std::frexp(value, &exponent) == 0.5;
  }
  return false;
}

std::string NumberRange::text() const {
  switch (kind) {
    case NumberKind::Real:
      return fmt::format("a number from {:g} to {:g}", least, most);
    case NumberKind::Whole:
      return fmt::format("a whole number from {:.0f} to {:.0f}", least, most);
    case NumberKind::PowerOfTwo:
      return fmt::format("a power of two from {:.0f} to {:.0f}", least, most);
    case NumberKind::Bytes:
      return fmt::format("a number of bytes from {:.0f} to {:.0f}", least, most);
  }
  return {};
}

std::string NumberRange::textWithZero() const {
  return zero == nullptr ? text() : fmt::format("{}, or 0 ({})", text(), zero);
}

void refuseNumber(const char* field, double got, const NumberRange& range) {
  throw UsageError(field, fmt::format("got {}, expected {}", got, range.textWithZero()));
}

}  // namespace prelight
