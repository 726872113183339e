#pragma once

#include <cstddef>
#include <functional>

namespace prelight {

/// Threads that the machine runs at once, at least 1.
std::size_t hardwareThreads();

/// Calls work(begin, end) for consecutive ranges that cover [0, count), on all cores or on `threads` of them.
/// The ranges depend on `grain` alone, never on the number of threads, so that sums over ranges are
/// reproducible; who is free takes the next. Where the system refuses further threads, those that there are
/// do the work. What `work` throws (memory that runs out) is thrown again once all have ended: the first that
/// was.
void parallelRanges(std::size_t count, std::size_t grain,
                    const std::function<void(std::size_t begin, std::size_t end)>& work,
                    std::size_t threads = hardwareThreads());

}  // namespace prelight
