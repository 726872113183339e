#pragma once

#include <array>
#include <string_view>

namespace prelight {

/// [CompressionMethod], as files and options name them.
inline constexpr std::array<std::string_view, 6> compressionMethodNames = {"half", "band8", "pca",
                                                                           "vq",   "cpca",  "rgbe"};

}  // namespace prelight
