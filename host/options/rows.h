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

  /// Returns a flag that also sets the one at the end of a path.
  template <bool Options::*own, auto... included>
  static constexpr Option<Options> flagWith(const OptionInfo& info) {
    Option<Options> row = flag<own>(info);
    row.set = [](Options& options, double value) {
      options.*own = value != 0.0;
      if (value != 0.0) (options.*....*included) = true;
    };
    return row;
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

/// Edge of a texel or an element, m.
constexpr NumberRange edge(const char* zero) { return real(1e-6, 1e6, zero); }

using BakeRow = Rows<BakeRequest>;

}  // namespace prelight::options
