#pragma once

#include <cstddef>
#include <functional>

namespace prelight {

/// Returns the number of threads that the machine runs at once, at least 1.
std::size_t hardwareThreads();

/// Calls work(begin, end) for consecutive ranges that cover [0, count), on all cores or on `threads` of them.
/// The ranges depend only on `grain`, never on the number of threads, so that sums over ranges are
/// reproducible; threads take the next range when they are free. If the system refuses further threads, the
/// existing ones do the work. The first exception of `work` (such as memory that runs out) is thrown again
/// once all threads have ended.
void parallelRanges(std::size_t count, std::size_t grain,
                    const std::function<void(std::size_t begin, std::size_t end)>& work,
                    std::size_t threads = hardwareThreads());

}  // namespace prelight
