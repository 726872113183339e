#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "io/values/baked_ranges.h"
#include "prelight/techniques.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// The name of the glTF extension that holds baked data.
constexpr const char* transferExtensionName = "PRELIGHT_transfer";

/// Returns the PRELIGHT_transfer object of a glTF object, if it has one.
std::optional<JsonCursor> transferExtension(const JsonCursor& object);

/// Advice in messages about a baked file that does not fit.
constexpr const char* rebake = "bake the scene again";

constexpr std::uint64_t maxStoredOrder = BakeRequest::maxShOrder;  ///< greatest order of harmonics in a file

/// Reads typed values of a baked file's accessors. Throws InputError naming the JSON path for values that do
/// not fit.
class ValueReader {
 public:
  /// The arguments must outlive the object; `root` is the whole glTF object.
  ValueReader(const GltfDocument& document, const JsonCursor& root) : document_(document), root_(root) {}

  /// Returns finite numbers: `count` elements of `type`, or all if `count` is none. The reference is an
  /// accessor of floats or a column of bytes (quantized_column.h), which is decoded; `ends` are the groups of
  /// its scales if these differ in length.
  std::vector<float> floats(const JsonCursor& reference, const char* type, std::optional<std::size_t> count,
                            std::span<const std::uint32_t> ends = {}) const;

  /// Returns the bytes of an accessor of signed or unsigned bytes, as they are stored.
  struct StoredBytes {
    bool isSigned = false;
    std::vector<std::uint8_t> bytes;
  };
  StoredBytes storedBytes(const JsonCursor& reference, const char* type,
                          std::optional<std::size_t> count) const;

  /// Returns unsigned integers that the file stores in 2 or 4 bytes.
  std::vector<std::uint32_t> shortOrLongIntegers(const JsonCursor& reference) const;

  /// Returns unsigned integers that the file stores with the size of T: 1, 2 or 4 bytes.
  template <typename T>
  std::vector<T> integers(const JsonCursor& reference, std::optional<std::size_t> count) const {
    const auto values = open(reference, "SCALAR", componentTypeOf<T>(), count).unsignedIntegers();
    return std::vector<T>(values.begin(), values.end());
  }

 private:
  AccessorReader open(const JsonCursor& reference, const char* type, int componentType,
                      std::optional<std::size_t> count) const;

  const GltfDocument& document_;
  const JsonCursor& root_;
};

/// Returns an integer within [least, most], which must fit an int.
int readNumber(const JsonCursor& json, std::uint64_t least, std::uint64_t most);

/// Reads member `channels`, which is 1 or 3.
int readChannels(const JsonCursor& json);

/// Reads member `bounces`, which is informative only.
int readBounces(const JsonCursor& json);

/// Copies `values`, `width` per vertex of a primitive, to their places in the values of the whole scene.
template <typename T>
void placeVertices(const std::vector<T>& values, const PrimitiveRanges& ranges, std::size_t width,
                   const CompiledScene& scene, std::vector<T>& target) {
  target.resize(width * scene.vertexCount());
  scatterVertices(values, ranges, width, target);
}

/// Reads one vector per vertex of a primitive.
std::vector<glm::vec3> readVectors(const ValueReader& values, const JsonCursor& json,
                                   const PrimitiveRanges& ranges);

/// Throws InputError unless a value that all primitives share is the same on all of them; the first one sets
/// it.
void expectSame(const JsonCursor& json, bool same, const char* what);

}  // namespace prelight
