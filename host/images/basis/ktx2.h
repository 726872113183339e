#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "prelight/scene.h"

namespace prelight {

/// Decodes the largest level of a KTX 2 file of Basis Universal (ETC1S with BasisLZ; UASTC, plain or with
/// Zstandard), as used by KHR_texture_basisu, to 8-bit RGBA. Throws InputError about `where`, also for other
/// contents. The caller must check the size in the header.
Image decodeKtx2(std::span<const std::uint8_t> bytes, const std::string& where);

}  // namespace prelight
