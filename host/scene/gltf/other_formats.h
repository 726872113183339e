#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace prelight {

/// Throws InputError that says what to do when a file is a picture, an archive, a web page or one of the
/// usual formats of models other than glTF: by its first bytes, or by its name where they are not those of
/// JSON.
void refuseOtherFormats(std::span<const std::uint8_t> bytes, const std::string& file);

}  // namespace prelight
