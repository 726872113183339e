#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// The buffer index of views whose buffer could not be read: a document has only buffer 0.
constexpr int missingBuffer = 1;

/// Returns true when an accessor's data lie in a buffer that the file leaves out.
bool lacksData(const GltfDocument& document, std::size_t accessor);

/// Returns true when data of an attribute or of the indices of a mesh primitive lie in such a buffer.
bool lacksData(const GltfDocument& document, const JsonCursor& primitive);

/// Returns the bytes of one component of glTF's `componentType`; 0 for an unknown one.
std::size_t componentBytes(std::uint64_t componentType);

/// Returns the number of components of glTF's accessor `type`; 0 for an unknown one.
std::size_t componentCount(const std::string& type);

/// Returns the bytes of one element; columns of small matrices are padded to 4 bytes as glTF requires.
std::size_t elementBytes(const std::string& type, std::uint64_t componentType);

/// Returns the padding bytes of a matrix's last column, which the last element of a buffer view may lack.
std::size_t columnPadding(const std::string& type, std::uint64_t componentType);

/// Reads an accessor of a document: strides, sparse values, normalised integers, and zeros where it has no
/// buffer view.
class AccessorReader {
 public:
  /// Throws InputError when the accessor, or what it refers to, is broken. Files may contain broken accessors
  /// that nothing uses.
  AccessorReader(const GltfDocument& document, std::size_t accessor);

  std::size_t count() const { return count_; }
  std::size_t components() const { return components_; }
  int componentType() const { return componentType_; }
  const std::string& type() const { return type_; }
  /// Returns true when the file gives values; otherwise all are 0.
  bool hasData() const { return json_.contains("bufferView") || json_.contains("sparse"); }

  /// Returns values [element][component]; integers become [-1, 1] or [0, 1] when the accessor is normalised
  /// or `forceNormalized` is set.
  std::vector<float> floats(bool forceNormalized = false) const;

  /// Returns values [element][component] of an accessor of unsigned integers.
  std::vector<std::uint32_t> unsignedIntegers() const;

  /// Returns the elements as they are stored, without gaps, with sparse values filled in.
  std::vector<std::uint8_t> elements() const;

  /// Returns the indices of the sparse substitutes, as stored; empty when the accessor is not sparse.
  std::vector<std::uint32_t> sparseIndices() const;

 private:
  struct Source {
    const std::uint8_t* data = nullptr;
    std::size_t stride = 0;
  };

  Source source(const nlohmann::ordered_json& holder, std::size_t tightStride) const;
  template <class T, class Stored, class Convert>
  std::vector<T> read(Convert convert) const;
  void checkSparseIndices(const JsonCursor& accessor) const;

  const GltfDocument& document_;
  const nlohmann::ordered_json& json_;  ///< accepted by validateAccessor
  std::string type_;
  std::size_t components_ = 0;
  int componentType_ = 0;
  std::size_t count_ = 0;
  bool normalized_ = false;
};

}  // namespace prelight
