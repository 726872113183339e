#include "scene/gltf/decoded_bytes.h"

#include <fmt/format.h>

#include "prelight/error.h"

namespace prelight {

DecodedBytes::DecodedBytes(std::uint64_t documentBytes)
    : left_((std::uint64_t{1} << 26) + 256 * documentBytes) {}

void DecodedBytes::take(std::uint64_t bytes, const std::string& where) {
  if (bytes > left_)
    throw InputError(
        where,
        fmt::format("decoding takes {} bytes, expected at most {} more for so small a file", bytes, left_),
        "the data are damaged, or export the scene without compression");
  left_ -= bytes;
}

}  // namespace prelight
