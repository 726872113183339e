#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "prelight/light_map.h"
#include "prelight/picture.h"

namespace prelight {

/// Charts grouped by brightness, so that an 8-bit picture per range has fine enough steps for its texels.
struct ChartRanges {
  int count = 1;
  std::vector<std::uint8_t> rangeOf;  ///< [chart], 0 is the brightest range; empty: there is one range

  /// Returns the range of a face, 0 for a face without a chart.
  int at(const LightMapLayout& layout, std::size_t face) const;
};

/// Groups charts by their largest value.
ChartRanges findChartRanges(const Picture& picture, const LightMapLayout& layout);

/// Returns a map whose texels in charts of a range are kept; all others are filled from nearby ones, as in
/// irradiancePicture().
Picture pictureOfRange(const Picture& picture, const LightMapLayout& layout, const ChartRanges& ranges,
                       int range);

}  // namespace prelight
