#include "images/basis/uastc.h"

#include "images/basis/huffman.h"

namespace prelight {

namespace {

/// Kind of digit that an endpoint's value has besides its bits.
enum class Digits : std::uint8_t { None = 1, Trits = 3, Quints = 5 };

/// Layout of the blocks of a mode.
struct Mode {
  unsigned code = 0;  ///< the first bits of the block
  unsigned codeBits = 0;
  unsigned hintBits = 0;  ///< bits that only transcoders need
  unsigned subsets = 1;
  unsigned channels = 3;  ///< per endpoint; 2 are luminance and alpha
  unsigned planes = 1;
  unsigned endpointBits = 0;
  Digits digits = Digits::None;
  unsigned weightBits = 0;
};

constexpr std::size_t solidMode = 8;
constexpr std::array<Mode, 19> modes = {{{0x01, 4, 15, 1, 3, 1, 6, Digits::Trits, 4},
                                         {0x35, 6, 15, 1, 3, 1, 8, Digits::None, 2},
                                         {0x1D, 5, 15, 2, 3, 1, 4, Digits::None, 3},
                                         {0x03, 5, 15, 3, 3, 1, 2, Digits::Trits, 2},
                                         {0x13, 5, 15, 2, 3, 1, 3, Digits::Quints, 2},
                                         {0x0B, 5, 15, 1, 3, 1, 8, Digits::None, 3},
                                         {0x1B, 5, 15, 1, 3, 2, 5, Digits::Quints, 2},
                                         {0x07, 5, 15, 2, 3, 1, 3, Digits::Quints, 2},
                                         {0x17, 5, 0, 1, 4, 1, 8, Digits::None, 0},
                                         {0x0F, 5, 23, 2, 4, 1, 4, Digits::None, 2},
                                         {0x02, 3, 17, 1, 4, 1, 4, Digits::Trits, 4},
                                         {0x00, 2, 17, 1, 4, 2, 4, Digits::Trits, 2},
                                         {0x06, 3, 17, 1, 4, 1, 6, Digits::Trits, 3},
                                         {0x1F, 5, 23, 1, 4, 2, 8, Digits::None, 1},
                                         {0x0D, 5, 23, 1, 4, 1, 8, Digits::None, 2},
                                         {0x05, 7, 23, 1, 2, 1, 8, Digits::None, 4},
                                         {0x15, 6, 23, 2, 2, 1, 8, Digits::None, 2},
                                         {0x25, 6, 23, 1, 2, 2, 8, Digits::None, 2},
                                         {0x09, 4, 15, 1, 3, 1, 5, Digits::None, 5}}};

// Subset of each texel, in raster order from the lowest bit on.
constexpr std::array<std::uint16_t, 30> twoSubsets = {
    0xcccc, 0x8888, 0x1111, 0xecc8, 0x377f, 0xfeec, 0x0137, 0x137f, 0xc800, 0x0013,
    0xfe80, 0x17ff, 0x0017, 0x00ff, 0xfff0, 0x0fff, 0xff71, 0x8eff, 0x08ce, 0x008c,
    0x7310, 0xceff, 0x7331, 0x088c, 0xceef, 0x6666, 0xf00f, 0x5555, 0x0f0f, 0x36c9};
constexpr std::array<std::uint16_t, 19> twoSubsetsOfMode7 = {
    0x00f0, 0x4444, 0x0133, 0xcc80, 0xf0ff, 0x2222, 0xffc8, 0xccce, 0x3c03, 0x00ee,
    0x7700, 0x3003, 0x00ce, 0xff80, 0x6fff, 0x1333, 0x11ff, 0x136c, 0x00ef};
constexpr std::array<std::uint32_t, 11> threeSubsets = {0xa5a50000, 0xaa005555, 0xaa000055, 0x0000aa55,
                                                        0x25252525, 0x94949494, 0x58585858, 0x56560202,
                                                        0x92929292, 0x55aa0055, 0xa05050a0};

using Subsets = std::array<std::uint8_t, 16>;
using Endpoints = std::array<std::uint8_t, 18>;
/// [plane][texel]
using Weights = std::array<std::array<unsigned, 16>, 2>;
using Color = std::array<unsigned, 4>;

/// Returns the mode whose code the block begins with, or the number of modes if there is none.
std::size_t modeOf(unsigned firstBits) {
  std::size_t mode = 0;
  while (mode < modes.size() && (firstBits & ((1u << modes[mode].codeBits) - 1)) != modes[mode].code) ++mode;
  return mode;
}

/// Reads the subset of each texel. Returns false for an invalid pattern.
bool readSubsets(BitReader& reader, std::size_t mode, Subsets& subsets) {
  subsets = {};
  if (modes[mode].subsets == 1) return true;
  const unsigned pattern = reader.bits(mode == 3 ? 4 : 5);
  const std::size_t patterns = mode == 3   ? threeSubsets.size()
                               : mode == 7 ? twoSubsetsOfMode7.size()
                                           : twoSubsets.size();
  if (pattern >= patterns) return false;
  for (unsigned i = 0; i < 16; ++i)
    subsets[i] = static_cast<std::uint8_t>(mode == 3   ? threeSubsets[pattern] >> (2 * i) & 3
                                           : mode == 7 ? twoSubsetsOfMode7[pattern] >> i & 1
                                                       : twoSubsets[pattern] >> i & 1);
  return true;
}

/// Converts bits and a trit or quint to a byte (Khronos Data Format, ASTC, colour unquantisation).
std::uint8_t unquantised(unsigned bits, unsigned digit, const Mode& mode) {
  if (mode.digits == Digits::None) {
    unsigned value = bits << (8 - mode.endpointBits);
    for (unsigned filled = mode.endpointBits; filled < 8; filled *= 2) value |= value >> filled;
    return static_cast<std::uint8_t>(value);
  }
  const unsigned lowest = (bits & 1) != 0 ? 0x1FF : 0;
  const unsigned upper = bits >> 1;  // one to five bits
  unsigned factor = 0, pattern = 0;
  switch (mode.endpointBits) {
    case 2:  // trits; b000b0bb0
      factor = 93;
      pattern = upper * 0x116;
      break;
    case 3:  // quints; cb0000cbc
      factor = 26;
      pattern = upper << 7 | upper << 1 | upper >> 1;
      break;
    case 4:  // trits; dcb000dcb
      factor = 22;
      pattern = upper << 6 | upper;
      break;
    case 5:  // quints; edcb0000e
      factor = 6;
      pattern = upper << 5 | upper >> 3;
      break;
    default:  // trits of six bits; fedcb000f
      factor = 5;
      pattern = upper << 4 | upper >> 4;
      break;
  }
  const unsigned value = (digit * factor + pattern) ^ lowest;
  return static_cast<std::uint8_t>((lowest & 0x80) | value >> 2);
}

/// Reads the low and high values of each channel in turn, for each subset.
Endpoints readEndpoints(BitReader& reader, const Mode& mode) {
  const unsigned count = mode.subsets * mode.channels * 2;
  const auto base = static_cast<unsigned>(mode.digits);
  std::array<unsigned, 18> digits{};
  if (mode.digits != Digits::None) {
    const unsigned group = mode.digits == Digits::Trits ? 5 : 3;
    constexpr std::array<unsigned, 6> tritBits = {0, 2, 4, 5, 7, 8};
    for (unsigned first = 0; first < count; first += group) {
      const unsigned size = count - first < group ? count - first : group;
      unsigned packed = reader.bits(mode.digits == Digits::Trits ? tritBits[size] : 7);
      for (unsigned i = 0; i < size; ++i, packed /= base) digits[first + i] = packed % base;
    }
  }
  Endpoints endpoints{};
  for (unsigned i = 0; i < count; ++i)
    endpoints[i] = unquantised(reader.bits(mode.endpointBits), digits[i], mode);
  return endpoints;
}

/// Converts a weight of `bits` bits to 0..64.
unsigned unquantisedWeight(unsigned weight, unsigned bits) {
  unsigned value = weight << (6 - bits);
  for (unsigned filled = bits; filled < 6; filled *= 2) value |= value >> filled;
  return value > 32 ? value + 1 : value;
}

Weights readWeights(BitReader& reader, const Mode& mode, const Subsets& subsets) {
  Weights weights{};
  unsigned seen = 0;  // subsets as bits; the highest bit of the first texel of each is 0 and not stored
  for (std::size_t i = 0; i < 16; ++i) {
    const unsigned subset = 1u << subsets[i];
    const unsigned bits = mode.weightBits - ((seen & subset) == 0 ? 1 : 0);
    seen |= subset;
    for (std::size_t plane = 0; plane < mode.planes; ++plane)
      weights[plane][i] = unquantisedWeight(reader.bits(bits), mode.weightBits);
  }
  return weights;
}

/// Returns the low (0) or high (1) endpoint of a subset as RGBA.
Color endpointColor(const Endpoints& endpoints, const Mode& mode, unsigned subset, unsigned end) {
  const auto value = [&](unsigned channel) {
    return unsigned{endpoints[(subset * mode.channels + channel) * 2 + end]};
  };
  if (mode.channels == 2) return {value(0), value(0), value(0), value(1)};
  return {value(0), value(1), value(2), mode.channels == 4 ? value(3) : 255};
}

void fill(const Color& color, std::array<std::uint8_t, 64>& rgba) {
  for (std::size_t i = 0; i < rgba.size(); ++i) rgba[i] = static_cast<std::uint8_t>(color[i % 4]);
}

}  // namespace

void decodeUastc(std::span<const std::uint8_t, uastcBlockBytes> block, bool isSrgb,
                 std::array<std::uint8_t, 64>& rgba) {
  constexpr Color error = {255, 0, 255, 255};
  const std::size_t index = modeOf(block[0]);
  if (index == modes.size()) return fill(error, rgba);
  const Mode& mode = modes[index];
  BitReader reader(block);
  reader.bits(mode.codeBits);
  if (index == solidMode) {
    Color color{};
    for (unsigned& channel : color) channel = reader.bits(8);
    return fill(color, rgba);
  }
  reader.bits(mode.hintBits);
  Subsets subsets;
  if (!readSubsets(reader, index, subsets)) return fill(error, rgba);
  constexpr unsigned alpha = 3;
  const unsigned second = mode.planes == 2 && mode.channels > 2 ? reader.bits(2) : alpha;
  const Endpoints endpoints = readEndpoints(reader, mode);
  const Weights weights = readWeights(reader, mode, subsets);
  for (std::size_t i = 0; i < 16; ++i) {
    const Color low = endpointColor(endpoints, mode, subsets[i], 0);
    const Color high = endpointColor(endpoints, mode, subsets[i], 1);
    for (std::size_t c = 0; c < 4; ++c) {
      const unsigned weight = weights[mode.planes == 2 && c == second ? 1 : 0][i];
      const unsigned from = low[c] << 8 | (isSrgb ? 0x80 : low[c]);
      const unsigned to = high[c] << 8 | (isSrgb ? 0x80 : high[c]);
      rgba[4 * i + c] = static_cast<std::uint8_t>((from * (64 - weight) + to * weight + 32) >> 6 >> 8);
    }
  }
}

}  // namespace prelight
