#pragma once

#include <cstdint>

namespace prelight {

/// Bytes that this process may take at most: the machine's memory, or less where a control group or a limit
/// of the process (RLIMIT_AS, RLIMIT_DATA) says so. Never 0: where nothing is known, the largest number.
std::uint64_t machineMemory();

}  // namespace prelight
