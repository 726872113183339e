#pragma once

#include <functional>

namespace prelight {

/// Runs `work` and returns its result. If the stack is limited to less than kernels and their compilers need,
/// `work` and all threads that it starts get the usual size nevertheless. `work` must not throw.
int onLargeStack(const std::function<int()>& work);

}  // namespace prelight
