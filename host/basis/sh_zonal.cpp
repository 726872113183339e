#include "basis/sh_zonal.h"

#include <cassert>

#include "basis/sh_evaluate.h"

// [1] Ramamoorthi and Hanrahan, "An efficient representation for irradiance environment maps", 2001.

namespace prelight::sh {

double clampedCosine(int band) {
  assert(band >= 0);
  if (band == 1) return 2.0 / 3.0;
  if (band % 2 == 1) return 0.0;
  // [1] Eq. 8, over pi: A_0 = 1, and A_l = -A_(l-2) (l-3)/(l+2) for even l, from the ratio of its factorials.
  double value = 1.0;
  for (int l = 2; l <= band; l += 2) value *= -(l - 3.0) / (l + 2.0);
  return value;
}

void openTransfer(const glm::dvec3& normal, int order, std::span<double> values) {
  evaluate(normal, order, values);
  for (int l = 0; l < order; ++l) {
    const double factor = clampedCosine(l);
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) values[i] *= factor;
  }
}

}  // namespace prelight::sh
