#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace prelight {

/// Throws InputError that names a converter when a file is one of the usual formats of models other than
/// glTF: by its first bytes, or by its name where they are not those of JSON.
void refuseOtherFormats(std::span<const std::uint8_t> bytes, const std::string& file);

}  // namespace prelight
