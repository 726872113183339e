#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "prelight/scene.h"

namespace prelight {

/// Decodes the largest level of a KTX 2 file of Basis Universal (ETC1S with BasisLZ; UASTC, plain or with
/// Zstandard), as KHR_texture_basisu has it, to RGBA of 8 bits. Throws InputError about `where`, also for
/// other contents. The size that the header claims is the caller's to check.
Image decodeKtx2(std::span<const std::uint8_t> bytes, const std::string& where);

}  // namespace prelight
