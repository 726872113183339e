#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "projectors/technique.h"

namespace prelight {

/// Reads what techniques have stored in a document.
class BakeReader {
 public:
  /// `input` outlives it.
  explicit BakeReader(const BakedInput& input);

  /// What PRELIGHT_transfer holds for the vertices of the scene; false when no node carries any and the root
  /// has no extension. Throws InputError when the data does not fit the scene or itself.
  bool readVertices();

  /// All that was read, with what is not of vertices.
  Bake finish();

 private:
  void readEntry(const JsonCursor& entry, const PrimitiveRanges& ranges);

  const BakedInput& input_;
  std::vector<std::string_view> members_;  ///< that stand on all primitives or on none
  std::vector<std::unique_ptr<TechniqueReader>> readers_;
  std::optional<std::vector<bool>> there_;  ///< [member], on the primitives so far
  Bake bake_;
};

}  // namespace prelight
