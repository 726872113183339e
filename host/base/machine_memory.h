#pragma once

#include <cstdint>

namespace prelight {

/// Returns the greatest number of bytes that this process may use: the machine's memory, or less if a control
/// group or a limit of the process (RLIMIT_AS, RLIMIT_DATA) says so. Never 0: if nothing is known, the
/// largest number.
std::uint64_t machineMemory();

}  // namespace prelight
