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

/// Bytes of one component of glTF's `componentType`; 0 for an unknown one.
std::size_t componentBytes(std::uint64_t componentType);

/// Number of components of glTF's accessor `type`; 0 for an unknown one.
std::size_t componentCount(const std::string& type);

/// Bytes of one element, columns of small matrices padded to 4 bytes as glTF demands.
std::size_t elementBytes(const std::string& type, std::uint64_t componentType);

/// Padding bytes of a matrix's last column, which the last element of a buffer view may lack.
std::size_t columnPadding(const std::string& type, std::uint64_t componentType);

/// Reads an accessor of a document: strides, sparse values, normalised integers, and zeros where it has no
/// buffer view.
class AccessorReader {
 public:
  /// Throws InputError when the accessor, or what it refers to, is broken: files may carry broken ones that
  /// nothing uses.
  AccessorReader(const GltfDocument& document, std::size_t accessor);

  std::size_t count() const { return count_; }
  std::size_t components() const { return components_; }
  int componentType() const { return componentType_; }
  const std::string& type() const { return type_; }
  /// Whether the file gives values: else all are 0.
  bool hasData() const { return json_.contains("bufferView") || json_.contains("sparse"); }

  /// Values [element][component]; integers in [-1, 1] or [0, 1] when the accessor is normalised or
  /// `forceNormalized` is set.
  std::vector<float> floats(bool forceNormalized = false) const;

  /// Values [element][component] of an accessor of unsigned integers.
  std::vector<std::uint32_t> unsignedIntegers() const;

  /// Elements as they are stored, tightly one after the other, sparse values filled in.
  std::vector<std::uint8_t> elements() const;

  /// Indices of the sparse substitutes, as stored; empty when the accessor is not sparse.
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
  const nlohmann::ordered_json& json_;  ///< as validateAccessor accepts it
  std::string type_;
  std::size_t components_ = 0;
  int componentType_ = 0;
  std::size_t count_ = 0;
  bool normalized_ = false;
};

}  // namespace prelight
