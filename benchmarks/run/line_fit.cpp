#include "benchmarks/run/line_fit.h"

#include <cassert>

namespace prelight::benchmarks {

LineFit fitLine(std::span<const Point> points) {
  const auto n = static_cast<double>(points.size());
  double meanX = 0.0, meanY = 0.0;
  for (const Point& p : points) meanX += p.x / n, meanY += p.y / n;
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const Point& p : points) {
    xx += (p.x - meanX) * (p.x - meanX);
    xy += (p.x - meanX) * (p.y - meanY);
    yy += (p.y - meanY) * (p.y - meanY);
  }
  assert(xx > 0.0);
  const double slope = xy / xx;
  return {meanY - slope * meanX, slope, yy > 0.0 ? slope * xy / yy : 1.0};
}

}  // namespace prelight::benchmarks
