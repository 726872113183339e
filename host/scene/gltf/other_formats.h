#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace prelight {

/// Throws InputError with a remedy when a file is an image, an archive, a web page or one of the usual model
/// formats other than glTF: recognised by its first bytes or, if these are not JSON's, by its name.
void refuseOtherFormats(std::span<const std::uint8_t> bytes, const std::string& file);

}  // namespace prelight
