#pragma once

#include <concepts>
#include <optional>

#include "prelight/parameters.h"

namespace prelight::parameters {

template <typename T>
struct Held {
  using Number = T;
};
template <typename T>
struct Held<std::optional<T>> {
  using Number = T;
};

/// Returns the number at the end of a path of members, as in `valueAt<&BakeRequest::haar,
/// &HaarRequest::error>`.
template <typename Options, auto... path>
std::optional<double> valueAt(const Options& options) {
  const auto& value = (options.*....*path);
  if constexpr (std::convertible_to<decltype(value), double>)
    return static_cast<double>(value);
  else
    return value ? std::optional<double>(static_cast<double>(*value)) : std::nullopt;
}

template <typename Options, auto... path>
void setAt(Options& options, double number) {
  auto& value = (options.*....*path);
  value = static_cast<typename Held<std::remove_reference_t<decltype(value)>>::Number>(number);
}

/// The part of a row that is not derived from the path of its member.
struct About {
  const char* field;
  const char* option;
  NumberRange range;
  const char* unit;
  const char* help;
};

template <typename Options, auto... path>
constexpr Parameter<Options> row(const About& about) {
  return {about.field,
          about.option,
          about.range,
          about.unit,
          about.help,
          valueAt<Options, path...>,
          setAt<Options, path...>};
}

constexpr NumberRange real(double least, double most, const char* zero = nullptr) {
  return {NumberKind::Real, least, most, zero};
}
constexpr NumberRange whole(double least, double most, const char* zero = nullptr) {
  return {NumberKind::Whole, least, most, zero};
}

}  // namespace prelight::parameters
