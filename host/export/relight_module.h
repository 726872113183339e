#pragma once

#include <map>
#include <string>

namespace prelight {

/// Returns the shaders that prelight.js runs, by the names by which they include one another.
const std::map<std::string, std::string>& relightShaders();

/// Returns the embedded parts of prelight.js, files of export/module, by their names.
const std::map<std::string, std::string>& relightModuleParts();

/// Returns prelight.js: an ES module that relights baked models in browsers. It needs no other file.
std::string relightModule();

}  // namespace prelight
