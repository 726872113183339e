#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "techniques/technique.h"

namespace prelight {

/// Reads the data that techniques have stored in a document.
class BakeReader {
 public:
  /// `input` must outlive the object.
  explicit BakeReader(const BakedInput& input);

  /// Reads the PRELIGHT_transfer data for the vertices of the scene. Returns false when no node carries any
  /// and the root has no extension. Throws InputError for data that is inconsistent or does not fit the
  /// scene.
  bool readVertices();

  /// Returns everything that was read, including data that is not per vertex.
  Bake finish();

 private:
  void readEntry(const JsonCursor& entry, const PrimitiveRanges& ranges);

  const BakedInput& input_;
  std::vector<std::string_view> members_;  ///< members that must be present on all primitives or on none
  std::vector<std::unique_ptr<TechniqueReader>> readers_;
  std::optional<std::vector<bool>> there_;  ///< [member], whether the primitives so far have it
  Bake bake_;
};

}  // namespace prelight
