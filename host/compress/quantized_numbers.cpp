#include "compress/quantized_numbers.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "compress/small_floats.h"

namespace prelight {

namespace {

constexpr std::uint8_t longGap = 255;

double greatestByte(const ByteForm& form) { return form.isSigned ? 127.0 : 255.0; }

std::uint8_t encode(double number, double scale, const ByteForm& form) {
  if (!(scale > 0.0)) return 0;
  const double share = std::clamp(number / scale, form.isSigned ? -1.0 : 0.0, 1.0);
  const double t = form.square ? std::copysign(std::sqrt(std::abs(share)), share) : share;
  return static_cast<std::uint8_t>(static_cast<int>(std::nearbyint(t * greatestByte(form))));
}

float decode(std::uint8_t byte, double scale, const ByteForm& form) {
  const int whole = form.isSigned ? static_cast<std::int8_t>(byte) : byte;
  const double t = std::max(-1.0, whole / greatestByte(form));
  return static_cast<float>(scale * (form.square ? t * std::abs(t) : t));
}

/// Returns the least half that is not below a number in the range of halves.
std::uint16_t halfAbove(float number) {
  const std::uint16_t nearest = toHalf(number);
  return fromHalf(nearest) < number ? static_cast<std::uint16_t>(nearest + 1) : nearest;
}

/// Returns where the numbers of a group begin, and with its successor where they end.
std::size_t beginOf(std::size_t group, const ByteForm& form, std::span<const std::uint32_t> ends) {
  if (ends.empty()) return group * form.group;
  return group == 0 ? 0 : ends[group - 1];
}

std::size_t groupCount(std::size_t numbers, const ByteForm& form, std::span<const std::uint32_t> ends) {
  if (!ends.empty()) return ends.size();
  return form.group == 0 ? 0 : numbers / form.group;
}

}  // namespace

std::optional<QuantizedNumbers> quantize(std::span<const float> numbers, const ByteForm& form,
                                         std::span<const std::uint32_t> ends) {
  QuantizedNumbers quantized{form, std::vector<std::uint8_t>(numbers.size()), {}};
  if (!std::ranges::all_of(numbers, [](float number) { return std::isfinite(number); })) return std::nullopt;
  const auto encodeRange = [&](std::size_t begin, std::size_t end, double scale) {
    for (std::size_t i = begin; i < end; ++i) quantized.bytes[i] = encode(numbers[i], scale, form);
  };
  const std::size_t groups = groupCount(numbers.size(), form, ends);
  if (form.group == 0 && ends.empty()) encodeRange(0, numbers.size(), form.scale);
  for (std::size_t group = 0; group < groups; ++group) {
    const std::size_t begin = beginOf(group, form, ends), end = beginOf(group + 1, form, ends);
    float greatest = 0.0f;
    for (std::size_t i = begin; i < end; ++i) greatest = std::max(greatest, std::abs(numbers[i]));
    if (greatest > halfMax) return std::nullopt;
    quantized.scales.push_back(halfAbove(greatest));
    encodeRange(begin, end, fromHalf(quantized.scales.back()));
  }
  return quantized;
}

std::vector<float> dequantize(const QuantizedNumbers& quantized, std::span<const std::uint32_t> ends) {
  const ByteForm& form = quantized.form;
  std::vector<float> numbers(quantized.bytes.size());
  const auto decodeRange = [&](std::size_t begin, std::size_t end, double scale) {
    for (std::size_t i = begin; i < end; ++i) numbers[i] = decode(quantized.bytes[i], scale, form);
  };
  if (form.group == 0 && ends.empty()) decodeRange(0, numbers.size(), form.scale);
  const std::size_t groups = groupCount(numbers.size(), form, ends);
  assert(quantized.scales.size() == groups);
  for (std::size_t group = 0; group < groups; ++group)
    decodeRange(beginOf(group, form, ends), beginOf(group + 1, form, ends),
                fromHalf(quantized.scales[group]));
  return numbers;
}

std::vector<std::uint8_t> encodeGaps(std::span<const std::uint32_t> indices,
                                     std::span<const std::uint32_t> ends) {
  std::vector<std::uint8_t> gaps;
  std::uint32_t i = 0;
  for (const std::uint32_t end : ends) {
    std::uint32_t before = 0;
    for (; i < end; before = indices[i++]) {
      std::uint32_t gap = indices[i] - before;
      for (; gap >= longGap; gap -= longGap) gaps.push_back(longGap);
      gaps.push_back(static_cast<std::uint8_t>(gap));
    }
  }
  return gaps;
}

std::optional<std::vector<std::uint32_t>> decodeGaps(std::span<const std::uint8_t> gaps,
                                                     std::span<const std::uint32_t> ends) {
  std::vector<std::uint32_t> indices;
  auto gap = gaps.begin();
  for (const std::uint32_t end : ends) {
    std::uint64_t index = 0;
    while (indices.size() < end) {
      for (; gap != gaps.end() && *gap == longGap; ++gap) index += longGap;
      if (gap == gaps.end()) return std::nullopt;
      index += *gap++;
      if (index > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
      indices.push_back(static_cast<std::uint32_t>(index));
    }
  }
  if (gap != gaps.end()) return std::nullopt;
  return indices;
}

}  // namespace prelight
