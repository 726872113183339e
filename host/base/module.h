#pragma once

namespace prelight {

/// The function of that name in a module, which is loaded, if it is not there yet, from where the program's
/// or the library's run path tells, and stays. Throws Error naming the file when it cannot be found.
void* moduleFunction(const char* file, const char* function);

}  // namespace prelight
