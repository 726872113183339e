#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "prelight/bake_animation.h"
#include "prelight/load.h"
#include "prelight/photons.h"
#include "prelight/render.h"
#include "prelight/request.h"

namespace prelight {

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

/// A numeric option of a structure: one row of the tables by which the library, the command line and the
/// Python package check their input.
template <typename Options>
struct Parameter {
  const char* field;   ///< name in messages of the library, such as "HaarRequest::error"
  const char* option;  ///< option of the command line without dashes, such as "haar-error"; empty: none
  NumberRange range;
  const char* unit;                              ///< such as "m", "s" or "rad"; empty: none
  const char* help;                              ///< description without range and default
  std::optional<double> (*get)(const Options&);  ///< returns the value, or nothing if it is not given
  void (*set)(Options&, double);                 ///< accepts values in the range
};

/// Returns the table of a structure's numeric options.
template <typename Options>
std::span<const Parameter<Options>> parametersOf();

template <>
std::span<const Parameter<BakeRequest>> parametersOf<BakeRequest>();
template <>
std::span<const Parameter<AnimationKeys>> parametersOf<AnimationKeys>();
template <>
std::span<const Parameter<RenderOptions>> parametersOf<RenderOptions>();
template <>
std::span<const Parameter<ReferenceGoal>> parametersOf<ReferenceGoal>();
template <>
std::span<const Parameter<PhotonOptions>> parametersOf<PhotonOptions>();
template <>
std::span<const Parameter<LoadOptions>> parametersOf<LoadOptions>();

/// Throws UsageError for a number out of its range: "FIELD: got X, expected ...".
[[noreturn]] void refuseNumber(const char* field, double got, const NumberRange& range);

/// Throws UsageError naming the first number of a structure that is out of its range.
template <typename Options>
void requireRanges(const Options& options) {
  for (const Parameter<Options>& parameter : parametersOf<Options>())
    if (const std::optional<double> value = parameter.get(options); value && !parameter.range.allows(*value))
      refuseNumber(parameter.field, *value, parameter.range);
}

}  // namespace prelight
