#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "prelight/device.h"

namespace prelight {

/// Returns the value of POCL_WORK_GROUP_METHOD that a device needs, or an empty text if the runtime's default
/// works. The default "loopvec" of PoCL 6 has LLVM verify that one round suffices to combine a kernel's
/// instructions, and LLVM aborts for kernels that need more. The method "cbs" is as fast.
std::string neededPoclMethod(const DeviceInfo& info);

/// Sets variables of the environment that PoCL reads at every compilation and launch, unless they are set:
/// POCL_WORK_GROUP_METHOD to neededPoclMethod(), and POCL_WORK_GROUP_SPECIALIZATION to 0. PoCL otherwise compiles
/// each kernel again at its first launch, for the launch's group size, and once more for launches of more than
/// 65535 work-items; that code is no faster, and a crash of the compiler there would end the calling program.
void configurePocl(const DeviceInfo& info);

/// Returns why PoCL cannot keep compiled kernels in a folder, in a few words, or nothing if it can. A missing
/// folder is judged by the parent that it would be created in. Leaves no files behind.
std::optional<std::string> whyUnusableForPocl(const std::filesystem::path& folder);

/// Returns the folder in which PoCL keeps compiled kernels according to the environment.
std::filesystem::path poclCacheFolder();

/// Replacement of a PoCL cache folder that is unusable.
struct PoclCacheReplacement {
  std::string problem;           ///< names the unusable folder and the reason
  std::filesystem::path folder;  ///< empty where none was found
};

/// Replaces PoCL's cache folder if it is unusable, because PoCL then ends the process or claims that there is
/// no device. Must be called before the first call of OpenCL. Sets POCL_CACHE_DIR to a temporary folder,
/// which is removed when the process ends, or by a later process if it is killed. Decides once per process.
/// Returns nothing if PoCL's own folder is usable.
const std::optional<PoclCacheReplacement>& replaceUnusablePoclCache();

/// Returns a warning for users of PoCL that names the unusable folder, the folder used instead and a remedy,
/// or nothing if PoCL's own folder is usable.
std::optional<std::string> poclCacheWarning();

/// Returns what is wrong with PoCL's folder at this moment, or nothing: disks may fill up while kernels are
/// compiled.
std::optional<std::string> problemOfPoclCache();

}  // namespace prelight
