#pragma once

#include <array>
#include <string_view>

namespace prelight {

/// Names of the methods in files and options, [CompressionMethod].
inline constexpr std::array<std::string_view, 6> compressionMethodNames = {"half", "band8", "pca",
                                                                           "vq",   "cpca",  "rgbe"};

}  // namespace prelight
