#pragma once

namespace prelight::cli {

/// The commit that was built, in full; "unknown" where the sources came without one.
const char* commit();

/// The same for people, as `git describe` names it.
const char* commitName();

}  // namespace prelight::cli
