#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "prelight/transfer.h"

/// How a baked file calls the ways of compression.
namespace prelight {

inline constexpr std::array<std::string_view, 5> compressionMethods = {"half", "band8", "pca", "vq", "cpca"};
inline constexpr std::array<std::string_view, 3> weightStorages = {"float", "half", "byte"};

inline std::string_view methodName(CompressionMethod method) {
  return compressionMethods[static_cast<std::size_t>(method)];
}

inline std::string_view weightStorageName(WeightStorage storage) {
  return weightStorages[static_cast<std::size_t>(storage)];
}

}  // namespace prelight
