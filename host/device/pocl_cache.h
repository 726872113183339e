#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace prelight {

/// Why PoCL cannot keep compiled kernels in a folder, in a few words; nothing where it can. A folder that is
/// missing is judged by the one that it would be made in. Leaves nothing behind.
std::optional<std::string> whyUnusableForPocl(const std::filesystem::path& folder);

/// The folder in which PoCL keeps what it compiles, as the environment tells it.
std::filesystem::path poclCacheFolder();

/// A folder in place of the one that PoCL would use and cannot.
struct PoclCacheReplacement {
  std::string problem;           ///< which folder is unusable, and why
  std::filesystem::path folder;  ///< empty where none was found
};

/// PoCL ends the process, or claims that there is no device, where it cannot write to its cache folder.
/// Called before the first call of OpenCL, this gives it a temporary folder by POCL_CACHE_DIR instead, which
/// is removed when the process ends, or by a later process where it is killed. Decides once for the process;
/// nothing where PoCL's own folder is usable.
const std::optional<PoclCacheReplacement>& replaceUnusablePoclCache();

/// What to tell somebody who uses PoCL: which folder is unusable, what is used instead and what helps.
/// Nothing where PoCL's own folder is usable.
std::optional<std::string> poclCacheWarning();

/// What is wrong with PoCL's folder at this moment: disks fill up while kernels are compiled. Nothing where
/// it is usable.
std::optional<std::string> problemOfPoclCache();

}  // namespace prelight
