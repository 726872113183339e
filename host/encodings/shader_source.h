#pragma once

#include <string_view>

namespace prelight {

/// Text of the irradiance.glsl of an encoding's folder, "ambient_cube", embedded when the library is built.
/// Throws std::out_of_range: there is no such folder.
std::string_view encodingShader(std::string_view folder);

}  // namespace prelight
