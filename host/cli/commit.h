#pragma once

namespace prelight::cli {

/// Returns the full hash of the commit that was built, or "unknown" if the sources came without one.
const char* commit();

/// Returns the commit's name for people, as `git describe` prints it.
const char* commitName();

}  // namespace prelight::cli
