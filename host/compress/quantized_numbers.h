#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace prelight {

/// How numbers become bytes: number = scale x t, or scale x t |t| if `square` is set, with t = byte / 127 for
/// signed bytes from -127 to 127, or byte / 255 for unsigned ones. Squares keep small numbers exact: the step
/// between neighbours shrinks with their size.
struct ByteForm {
  bool isSigned = true;
  bool square = false;
  /// Numbers that share a scale, which is a half; 0: all have `scale`.
  std::size_t group = 0;
  float scale = 1.0f;
};

/// Bytes of accessibilities, which are 0 to 1: squares, because corners are dark.
inline constexpr ByteForm accessibilityForm{.isSigned = false, .square = true};

/// Numbers as bytes. Signed bytes are stored as two's complements.
struct QuantizedNumbers {
  ByteForm form;
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint16_t> scales;  ///< [group], IEEE half, >= 0; empty if `form.group` is 0

  std::size_t byteCount() const { return bytes.size() + scales.size() * sizeof(std::uint16_t); }
};

/// Quantises numbers to their nearest bytes. A scale is the least half that is at least the group's greatest
/// magnitude; beyond `form.scale`, or below 0 if bytes are unsigned, numbers saturate. With `ends`, groups
/// have different lengths: the numbers of group i end before ends[i]. Returns nothing if a number is not
/// finite or a group's scale exceeds halves.
std::optional<QuantizedNumbers> quantize(std::span<const float> numbers, const ByteForm& form,
                                         std::span<const std::uint32_t> ends = {});

/// Decodes them, one number per byte. `ends` are those of quantize(). Requires as many scales as groups.
std::vector<float> dequantize(const QuantizedNumbers& quantized, std::span<const std::uint32_t> ends = {});

/// Encodes ascending indices of sparse rows as their gaps: the first index of a row, then differences. 255
/// adds 255 to the gap that goes on in the next byte. The indices of row i end before ends[i].
std::vector<std::uint8_t> encodeGaps(std::span<const std::uint32_t> indices,
                                     std::span<const std::uint32_t> ends);

/// Decodes ends.back() indices. Returns nothing if there are fewer or more bytes than they take, or an index
/// exceeds 32 bits.
std::optional<std::vector<std::uint32_t>> decodeGaps(std::span<const std::uint8_t> gaps,
                                                     std::span<const std::uint32_t> ends);

}  // namespace prelight
