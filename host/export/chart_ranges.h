#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "prelight/light_map.h"
#include "prelight/picture.h"

namespace prelight {

/// Charts told apart by how bright they are: a picture of 8 bits a range has steps that are fine enough for
/// what is in it.
struct ChartRanges {
  int count = 1;
  std::vector<std::uint8_t> rangeOf;  ///< [chart], the brightest range is 0; empty: there is one range

  /// 0 for a face without a chart.
  int at(const LightMapLayout& layout, std::size_t face) const;
};

/// By each chart's largest value.
ChartRanges findChartRanges(const Picture& picture, const LightMapLayout& layout);

/// A map's texels of the charts in a range; all others hold what is near them, as in irradiancePicture().
Picture pictureOfRange(const Picture& picture, const LightMapLayout& layout, const ChartRanges& ranges,
                       int range);

}  // namespace prelight
