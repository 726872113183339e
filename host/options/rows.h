#pragma once

#include <concepts>
#include <optional>
#include <type_traits>

#include "prelight/options.h"

namespace prelight::options {

template <typename T>
struct Held {
  using Value = T;
};
template <typename T>
struct Held<std::optional<T>> {
  using Value = T;
};

/// Functions that make rows of a table of `Options`. A path of members, as in `<&BakeRequest::haar,
/// &HaarRequest::error>`, leads to the value that a row sets.
template <typename Options>
struct Rows {
  template <auto... path>
  static std::optional<double> get(const Options& options) {
    const auto& value = (options.*....*path);
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::same_as<Value, typename Held<Value>::Value>)
      return static_cast<double>(value);
    else
      return value ? std::optional<double>(static_cast<double>(*value)) : std::nullopt;
  }

  template <auto... path>
  static void set(Options& options, double number) {
    auto& value = (options.*....*path);
    value = static_cast<typename Held<std::remove_cvref_t<decltype(value)>>::Value>(number);
  }

  template <auto... path>
  static constexpr Option<Options> number(NumberRange range, OptionInfo info) {
    info.kind = OptionKind::Number;
    info.range = range;
    return {info, get<path...>, set<path...>};
  }

  template <auto... path>
  static constexpr Option<Options> flag(OptionInfo info) {
    info.kind = OptionKind::Flag;
    return {info, get<path...>, set<path...>};
  }

  /// `choices` must be in the order of the enumeration.
  template <auto... path>
  static constexpr Option<Options> choice(std::span<const Choice> choices, OptionInfo info) {
    info.kind = OptionKind::Choice;
    info.choices = choices;
    return {info, get<path...>, set<path...>};
  }

  static constexpr Option<Options> own(OptionInfo info) { return {info}; }
};

constexpr NumberRange real(double least, double most, const char* zero = nullptr) {
  return {NumberKind::Real, least, most, zero};
}
constexpr NumberRange whole(double least, double most, const char* zero = nullptr) {
  return {NumberKind::Whole, least, most, zero};
}
constexpr NumberRange powerOfTwo(double least, double most, const char* zero = nullptr) {
  return {NumberKind::PowerOfTwo, least, most, zero};
}

}  // namespace prelight::options
