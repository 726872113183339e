#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "prelight/error.h"
#include "prelight/options.h"

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

std::vector<std::string_view> OptionInfo::shadingNames() const {
  std::vector<std::string_view> names;
  for (std::string_view rest = shadings; !rest.empty();) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    names.push_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return names;
}

bool OptionInfo::appliesTo(std::string_view shading) const {
  const std::vector<std::string_view> names = shadingNames();
  return std::find(names.begin(), names.end(), shading) != names.end();
}

std::string OptionInfo::expected() const {
  switch (kind) {
    case OptionKind::Flag:
      return "True or False";
    case OptionKind::Number:
      return range.textWithZero();
    case OptionKind::Choice: {
      std::string names;
      for (const Choice& choice : choices)
        names += (names.empty() ? "one of " : ", ") + std::string(choice.name);
      return names;
    }
    case OptionKind::Own:
      break;
  }
  return "a text";
}

void refuseNumber(const char* field, double got, const NumberRange& range) {
  throw UsageError(field, fmt::format("got {}, expected {}", got, range.textWithZero()));
}

}  // namespace prelight
