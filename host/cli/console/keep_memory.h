#pragma once

namespace prelight::cli {

/// Makes the allocator keep freed memory for the next allocations until the process ends. A bake frees and
/// allocates arrays of many megabytes from stage to stage, and pages that go back to the system in between
/// cost page faults, a tenth of its time. Does nothing if the C library is not glibc.
void keepFreedMemory();

}  // namespace prelight::cli
