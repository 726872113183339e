#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "prelight/request.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// What to do about a baked file that does not fit.
constexpr const char* rebake = "bake the scene again";

constexpr std::uint64_t maxStoredOrder = BakeRequest::maxShOrder;  ///< of harmonics, that a file may have

/// Reads typed values of accessors of a baked file. Throws InputError naming the JSON path for those that do
/// not fit.
class ValueReader {
 public:
  /// The arguments outlive it; `root` is the whole glTF object.
  ValueReader(const GltfDocument& document, const JsonCursor& root) : document_(document), root_(root) {}

  /// Finite numbers; `count` elements of `type`, or as many as there are.
  std::vector<float> floats(const JsonCursor& reference, const char* type,
                            std::optional<std::size_t> count) const;

  /// Unsigned integers of 2 or 4 bytes, as the file has them.
  std::vector<std::uint32_t> shortOrLongIntegers(const JsonCursor& reference) const;

  /// Unsigned integers of 1, 2 or 4 bytes.
  template <typename T>
  std::vector<T> integers(const JsonCursor& reference, std::optional<std::size_t> count) const {
    constexpr int componentType = sizeof(T) == 4 ? 5125 : sizeof(T) == 2 ? 5123 : 5121;
    const auto values = open(reference, "SCALAR", componentType, count).unsignedIntegers();
    return std::vector<T>(values.begin(), values.end());
  }

 private:
  AccessorReader open(const JsonCursor& reference, const char* type, int componentType,
                      std::optional<std::size_t> count) const;

  const GltfDocument& document_;
  const JsonCursor& root_;
};

/// A whole number as wide as an int, within [least, most].
int readNumber(const JsonCursor& json, std::uint64_t least, std::uint64_t most);

/// Member `channels`: 1 or 3.
int readChannels(const JsonCursor& json);

/// Member `bounces`, which tells, and does not bind.
int readBounces(const JsonCursor& json);

}  // namespace prelight
