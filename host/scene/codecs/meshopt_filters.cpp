#include "scene/codecs/meshopt_filters.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace prelight {

namespace {

/// Decodes one element as in KHR_meshopt_compression, appendix B, filter 4.
template <class Stored, class Signed>
void decodeElement(std::uint8_t* element) {
  std::array<Stored, 4> in{};
  std::memcpy(in.data(), element, sizeof(in));
  const int luma = in[0];
  const int orange = static_cast<Signed>(in[1]);
  const int green = static_cast<Signed>(in[2]);
  // The highest bit of alpha determines how many bits the other channels have.
  const int most = (1 << std::bit_width(in[3])) - 1;
  const int alpha = in[3] & most >> 1;
  const std::array<int, 4> rgba = {luma + orange - green, luma + green, luma - orange - green,
                                   alpha << 1 | (alpha & 1)};
  const float scale =
      most > 0 ? static_cast<float>(std::numeric_limits<Stored>::max()) / static_cast<float>(most) : 0.0f;
  std::array<Stored, 4> out{};
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = static_cast<Stored>(std::clamp(std::lround(static_cast<float>(rgba[i]) * scale), 0L,
                                            static_cast<long>(std::numeric_limits<Stored>::max())));
  std::memcpy(element, out.data(), sizeof(out));
}

}  // namespace

void decodeColors(std::span<std::uint8_t> data, std::size_t stride) {
  for (std::size_t at = 0; at + stride <= data.size(); at += stride) {
    if (stride == 4) {
      decodeElement<std::uint8_t, std::int8_t>(&data[at]);
    } else {
      decodeElement<std::uint16_t, std::int16_t>(&data[at]);
    }
  }
}

}  // namespace prelight
