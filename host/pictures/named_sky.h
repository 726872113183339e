#pragma once

#include <filesystem>
#include <string>

#include "prelight/bake.h"
#include "prelight/picture.h"

namespace prelight::pictures {

constexpr const char* studioName = "studio";
constexpr const char* neutralName = "neutral";
constexpr const char* dayName = "preetham:";  ///< TURBIDITY:ELEVATION[:AZIMUTH] and `sunName` follow
constexpr const char* sunName = ":sun";

/// Returns whether a name is that of a built-in sky, or of a kind of them.
bool isBuiltinSky(const std::string& name);

/// Reads the sky of a file, or makes a built-in one by its name. Throws as readEnvironment(), and UsageError
/// for numbers that a built-in sky cannot have.
Environment readNamedSky(const std::filesystem::path& nameOrFile);

/// Returns the record, for a baked file at `output`, of a sky that was asked for. `rotation`: radians.
BakedSky recordOf(const std::filesystem::path& asked, const Environment& sky, double rotation,
                  const std::filesystem::path& output);

}  // namespace prelight::pictures
