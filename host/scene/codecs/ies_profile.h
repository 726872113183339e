#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "prelight/light_profile.h"

namespace prelight {

/// Largest file of a profile that is read, and of all profiles of a scene together.
constexpr std::size_t mostProfileBytes = std::size_t{1} << 24, mostProfilesBytes = std::size_t{1} << 26;
/// Most intensities of a scene's profiles together, with what symmetry fills in.
constexpr std::size_t mostProfilesIntensities = std::size_t{1} << 22;

/// Reads a photometric profile: LM-63 of 1986 to 2019, of types A, B and C. What the file leaves to symmetry
/// is filled in; candelas count as W/sr. Throws InputError, which names `where` and the line.
LightProfile parseIesProfile(std::string_view text, const std::string& where);

}  // namespace prelight
