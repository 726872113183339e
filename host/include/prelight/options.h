#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "prelight/bake_animation.h"
#include "prelight/load.h"
#include "prelight/photons.h"
#include "prelight/render.h"
#include "prelight/techniques.h"

namespace prelight {

struct RefineRequest;

/// Kinds of numbers, which restrict the values within a range.
enum class NumberKind : std::uint8_t { Real, Whole, PowerOfTwo, Bytes };

/// Permitted values of a numeric option.
struct NumberRange {
  NumberKind kind = NumberKind::Real;
  double least = 0.0;
  double most = 0.0;
  /// Meaning of 0, such as "none", if `least` is above 0; nullptr: 0 has no meaning.
  const char* zero = nullptr;

  /// Returns whether a value lies in the range and is of its kind: false for NaN and for a 0 outside the
  /// range.
  bool contains(double value) const;

  /// Returns whether an option may have this value: one in the range, or a 0 that has a meaning.
  bool allows(double value) const { return contains(value) || (value == 0.0 && zero != nullptr); }

  /// Describes the values that contains() accepts, such as "a whole number from 1 to 32".
  std::string text() const;

  /// Describes the values that allows() accepts, such as "a whole number from 1 to 32, or 0 (none)".
  std::string textWithZero() const;
};

/// A value that is chosen by its name.
struct Choice {
  const char* name;
  const char* help = nullptr;  ///< explanation that follows the name; nullptr: the name says enough
};

/// Kinds of options by what they are set to.
enum class OptionKind : std::uint8_t {
  Flag,    ///< 0 or 1
  Number,  ///< a number in OptionInfo::range
  Choice,  ///< an index into OptionInfo::choices, which are in the order of an enumeration
  Own,     ///< text with a syntax of its own, which front ends read and check themselves
};

/// Ends of a slider. Equal ends: those of the option's range.
struct UsualRange {
  double least = 0.0;
  double most = 0.0;
};

/// The part of an option that is the same for all structures: how it is called and explained.
struct OptionInfo {
  const char* field;  ///< member that it sets, as messages of the library call it: "HaarRequest::error"
  /// Words joined by dashes, such as "haar-error". The command line puts -- before them, and Python joins
  /// them by underscores.
  const char* name;
  const char* help = "";              ///< one sentence without its range and default
  const char* unit = "";              ///< such as "m", "s", "deg" or "rad"
  const char* argument = nullptr;     ///< Python's argument where it has another name
  const char* commandLine = nullptr;  ///< command-line option where another one sets it: "size"
  const char* shadings = "";          ///< shadings that it applies to, parted by spaces; empty: it is no
                                      ///< option of shadings
  UsualRange usual = {};
  const char* example = nullptr;  ///< a value in the command line's syntax where that is not plain
  // Members below are set by the functions that make rows.
  OptionKind kind = OptionKind::Own;
  NumberRange range = {};
  std::span<const Choice> choices = {};

  /// Returns the shadings that it applies to.
  std::vector<std::string_view> shadingNames() const;
  bool appliesTo(std::string_view shading) const;

  /// Describes its values: "a number from 0 to 1", "one of lobe, thesis", "True or False".
  std::string expected() const;
};

/// An option of a structure: one row of the tables that the library, the command line, the window and the
/// Python package read.
template <typename Options>
struct Option : OptionInfo {
  std::optional<double> (*get)(const Options&) = nullptr;  ///< returns the value, or nothing if none is given
  void (*set)(Options&, double) = nullptr;                 ///< accepts permitted values
  /// Kind Own: returns the value as the command line takes it, or an empty text if nothing is set.
  std::string (*text)(const Options&) = nullptr;

  /// Returns whether a structure has another value than by default.
  bool isSet(const Options& options) const {
    return get != nullptr ? get(options) != usualValue() : text != nullptr && !text(options).empty();
  }

  /// Returns the value that a structure has if nothing is set.
  std::optional<double> usualValue() const { return get == nullptr ? std::nullopt : get({}); }
};

/// Returns the table of a structure's options.
template <typename Options>
std::span<const Option<Options>> optionsOf();

template <>
std::span<const Option<BakeRequest>> optionsOf<BakeRequest>();
template <>
std::span<const Option<AnimationKeys>> optionsOf<AnimationKeys>();
template <>
std::span<const Option<RenderOptions>> optionsOf<RenderOptions>();
template <>
std::span<const Option<ReferenceGoal>> optionsOf<ReferenceGoal>();
template <>
std::span<const Option<PhotonOptions>> optionsOf<PhotonOptions>();
template <>
std::span<const Option<LoadOptions>> optionsOf<LoadOptions>();
template <>
std::span<const Option<RefineRequest>> optionsOf<RefineRequest>();

/// Throws UsageError for a number out of its range: "FIELD: got X, expected ...".
[[noreturn]] void refuseNumber(const char* field, double got, const NumberRange& range);

/// Throws UsageError naming the first number of a structure that is out of its range.
template <typename Options>
void requireRanges(const Options& options) {
  for (const Option<Options>& row : optionsOf<Options>())
    if (row.kind == OptionKind::Number)
      if (const std::optional<double> value = row.get(options); value && !row.range.allows(*value))
        refuseNumber(row.field, *value, row.range);
}

}  // namespace prelight
