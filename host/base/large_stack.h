#pragma once

#include <functional>

namespace prelight {

/// Runs `work` and returns what it returns. Where the stack is limited to less than compilers of kernels and
/// kernels need, it and all threads that it starts get the usual size all the same. `work` does not throw.
int onLargeStack(const std::function<int()>& work);

}  // namespace prelight
