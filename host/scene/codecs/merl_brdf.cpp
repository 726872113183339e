#include "scene/codecs/merl_brdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "prelight/error.h"
#include "prelight/measured_brdf.h"

namespace prelight {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in the file");

constexpr std::array<int, 3> sizes = {MeasuredBrdf::halves, MeasuredBrdf::differences, MeasuredBrdf::turns};
constexpr std::array<const char*, 3> channelNames = {"red", "green", "blue"};
/// Factors of the channels' numbers, as in the database's own reader.
constexpr std::array<double, 3> scales = {1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};
// 1/sr; a greater peak would be sharper than the narrowest cell can hold.
constexpr double largestReflectance = 1e6;
constexpr const char* getAgain = "get the file from its source again";

void checkSizes(std::span<const std::uint8_t> bytes, const std::string& where) {
  if (bytes.size() < merlHeaderBytes)
    throw InputError(where, fmt::format("got {} bytes, expected {}", bytes.size(), merlBytes), getAgain);
  std::array<std::int32_t, 3> got{};
  std::memcpy(got.data(), bytes.data(), merlHeaderBytes);
  if (!std::equal(got.begin(), got.end(), sizes.begin()))
    throw InputError(where,
                     fmt::format("got a table of {} x {} x {} values, expected {} x {} x {}", got[0], got[1],
                                 got[2], sizes[0], sizes[1], sizes[2]),
                     "only MERL's binary format of isotropic materials is read");
  if (bytes.size() != merlBytes)
    throw InputError(where, fmt::format("got {} bytes, expected {}", bytes.size(), merlBytes), getAgain);
}

[[noreturn]] void fail(const std::string& where, int channel, std::size_t cell, double value) {
  constexpr std::size_t turns = MeasuredBrdf::turns, differences = MeasuredBrdf::differences;
  throw InputError(
      where,
      fmt::format("value {} of {} (half angle {}, difference angle {}, turn {}): got {}, expected "
                  "a number up to {:g}, or below 0 where nothing was measured",
                  cell, channelNames[static_cast<std::size_t>(channel)], cell / (turns * differences),
                  cell / turns % differences, cell % turns, value,
                  largestReflectance / scales[static_cast<std::size_t>(channel)]),
      getAgain);
}

}  // namespace

std::vector<glm::vec3> parseMerlBrdf(std::span<const std::uint8_t> bytes, const std::string& where) {
  checkSizes(bytes, where);
  std::vector<glm::vec3> values(MeasuredBrdf::cells);
  for (int c = 0; c < 3; ++c) {
    const std::uint8_t* channel =
        bytes.data() + merlHeaderBytes + values.size() * sizeof(double) * std::size_t(c);
    for (std::size_t cell = 0; cell < values.size(); ++cell) {
      double value = 0.0;
      std::memcpy(&value, channel + cell * sizeof(double), sizeof(double));
      const double scaled = value * scales[static_cast<std::size_t>(c)];
      if (!(scaled <= largestReflectance) || std::isinf(value)) fail(where, c, cell, value);
      values[cell][c] = scaled < 0.0 ? -1.0f : static_cast<float>(scaled);
    }
  }
  return values;
}

}  // namespace prelight
