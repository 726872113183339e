#pragma once

#include <string_view>

namespace prelight {

/// Returns the embedded irradiance.glsl of an encoding's folder, such as "ambient_cube". Throws
/// std::out_of_range for an unknown folder.
std::string_view encodingShader(std::string_view folder);

}  // namespace prelight
