#pragma once

#include <filesystem>
#include <string>

namespace prelight {

/// Returns the function of that name in a module, which is loaded, unless it is loaded already, by the run
/// path of the program or the library, and stays loaded. Throws Error naming the file when it cannot be
/// found.
void* moduleFunction(const char* file, const char* function);

/// Loads a module that a system may or may not have, and keeps it loaded. Returns nullptr if there is none,
/// with the reason in `reason`. Throws Error when memory is short.
void* findModule(const char* file, std::string& reason);

/// Returns a module's function, or nullptr if it has no such function.
void* findFunction(void* module, const char* function);

/// Returns a program of that name in the folders in which moduleFunction() searches for modules; empty if
/// there is none.
std::filesystem::path findProgramBesideModules(const char* file);

/// Returns the path of the file from which a function was loaded.
std::string fileOfFunction(void* function);

}  // namespace prelight
