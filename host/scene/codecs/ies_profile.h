#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "prelight/light_profile.h"

namespace prelight {

/// Greatest size in bytes of a profile's file, and of all profiles of a scene together.
constexpr std::size_t mostProfileBytes = std::size_t{1} << 24, mostProfilesBytes = std::size_t{1} << 26;
/// Greatest number of intensities in all of a scene's profiles, including those that symmetry fills in.
constexpr std::size_t mostProfilesIntensities = std::size_t{1} << 22;

/// Reads a photometric profile: LM-63 of 1986 to 2019, types A, B and C. Values that the file leaves to
/// symmetry are filled in; candelas count as W/sr. Throws InputError, which names `where` and the line.
LightProfile parseIesProfile(std::string_view text, const std::string& where);

}  // namespace prelight
