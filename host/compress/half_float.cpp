#include "compress/half_float.h"

#include <Imath/half.h>

#include <cmath>

namespace prelight {

std::uint16_t toHalf(float value) {
  // One NaN of each sign: Imath keeps payloads, which differ from machine to machine.
  if (std::isnan(value)) return std::signbit(value) ? 0xfe00u : 0x7e00u;
  return imath_float_to_half(value);
}

float fromHalf(std::uint16_t half) { return imath_half_to_float(half); }

}  // namespace prelight
