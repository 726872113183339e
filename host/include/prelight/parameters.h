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

/// What a number must be besides lying in its range.
enum class NumberKind : std::uint8_t { Real, Whole, PowerOfTwo, Bytes };

/// The values that a number of a structure of options may have.
struct NumberRange {
  NumberKind kind = NumberKind::Real;
  double least = 0.0;
  double most = 0.0;
  const char* zero = nullptr;  ///< meaning of 0 where `least` is above it, as "none"; nullptr: 0 has none

  /// Whether a value lies in the range and is of its kind. False for NaN and for a 0 outside the range.
  bool contains(double value) const;

  /// Whether a structure may hold this value: one in the range, or a 0 that has a meaning.
  bool allows(double value) const { return contains(value) || (value == 0.0 && zero != nullptr); }

  /// "a whole number from 1 to 32": what contains() takes.
  std::string text() const;

  /// "a whole number from 1 to 32, or 0 (none)": what allows() takes.
  std::string textWithZero() const;
};

/// A number of a structure of options: a row of the tables by which the library, the command line and the
/// Python package check what they are asked for.
template <typename Options>
struct Parameter {
  const char* field;   ///< as messages of the library name it, "HaarRequest::error"
  const char* option;  ///< of the command line, without dashes, "haar-error"; empty: it has none of its own
  NumberRange range;
  const char* unit;                              ///< "m", "s", "rad"; empty: a number without one
  const char* help;                              ///< what it is, without range and default
  std::optional<double> (*get)(const Options&);  ///< nothing: it is not given
  void (*set)(Options&, double);                 ///< takes what the range contains
};

/// The table of a structure's numbers.
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

/// Throws the UsageError about a number that its range does not allow: "FIELD: got X, expected ...".
[[noreturn]] void refuseNumber(const char* field, double got, const NumberRange& range);

/// Throws UsageError naming the first number of a structure that its range does not allow.
template <typename Options>
void requireRanges(const Options& options) {
  for (const Parameter<Options>& parameter : parametersOf<Options>())
    if (const std::optional<double> value = parameter.get(options); value && !parameter.range.allows(*value))
      refuseNumber(parameter.field, *value, parameter.range);
}

}  // namespace prelight
