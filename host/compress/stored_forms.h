#pragma once

#include <optional>

#include "compress/quantized_occluders.h"
#include "prelight/transfer.h"

namespace prelight {

/// Forms in which a file stores parts of a bake in place of the bake's own.
struct StoredForms {
  std::optional<QuantizedOccluders> occluders = {};
  /// Transfer matrices by their principal components: rows of as many bands as the square of their order.
  std::optional<CompressedTransfer> matrices = {};
  bool columns = false;  ///< numbers of vertices are stored as bytes
};

}  // namespace prelight
