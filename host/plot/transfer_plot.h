#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>

#include "plot/basis_plots.h"
#include "plot/drawing.h"

namespace prelight::plot {

/// The transfer of a receiver, [channel][i]: 1 or 3 channels of order^2 coefficients.
struct TransferRow {
  std::string name;            ///< in captions
  EvaluateBasis evaluate;      ///< functions that the coefficients belong to
  std::span<const float> row;  ///< of 1 or 3 channels, which their number tells
};

/// Returns transfer as a function of direction: as a balloon, and as a map of all directions. Where channels
/// differ, their mean. Throws UsageError for a row of another length.
Drawing plotTransfer(const TransferRow& transfer);

}  // namespace prelight::plot
