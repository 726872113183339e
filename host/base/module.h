#pragma once

#include <filesystem>
#include <string>

namespace prelight {

/// The function of that name in a module, which is loaded, if it is not there yet, from where the program's
/// or the library's run path tells, and stays. Throws Error naming the file when it cannot be found.
void* moduleFunction(const char* file, const char* function);

/// A module that a system may have or not, loaded to stay; nullptr where it has none, and `reason` tells why.
/// Throws Error when memory is short.
void* findModule(const char* file, std::string& reason);

/// nullptr: the module has no such function.
void* findFunction(void* module, const char* function);

/// A program of that name in the folders in which moduleFunction() looks for modules; empty where there is
/// none.
std::filesystem::path findProgramBesideModules(const char* file);

/// The path of the file that a function was loaded from.
std::string fileOfFunction(void* function);

}  // namespace prelight
