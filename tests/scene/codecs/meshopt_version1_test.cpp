// Attributes of version 1 and the colour filter, against an encoder that the test implements from the text of
// KHR_meshopt_compression: libmeshoptimizer 0.18 supports neither.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <random>

#include "scene/codecs/meshopt_stream.h"

namespace prelight {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// How one byte of the elements is stored: a control mode, and in modes 0 and 1 the header of every group.
struct Storage {
  unsigned control = 0;
  unsigned header = 0;

  unsigned bits() const {
    constexpr std::array<std::array<unsigned, 4>, 2> bitsOf = {{{0, 1, 2, 4}, {1, 2, 4, 8}}};
    return bitsOf[control][header];
  }
};

template <class Number>
Number zigzag(Number v) {
  constexpr unsigned top = 8 * sizeof(Number) - 1;
  const auto twice = static_cast<Number>(v << 1);
  return static_cast<Number>((v >> top & 1) != 0 ? ~twice : twice);
}

/// The four delta bytes of a channel between one element and the next.
std::array<std::uint8_t, 4> deltaOf(const std::uint8_t* before, const std::uint8_t* after,
                                    std::uint8_t channel) {
  std::array<std::uint8_t, 4> delta{};
  if (channel == 0) {
    for (std::size_t k = 0; k < 4; ++k) delta[k] = zigzag(static_cast<std::uint8_t>(after[k] - before[k]));
  } else if (channel == 1) {
    for (std::size_t k = 0; k < 4; k += 2) {
      const auto number = [&](const std::uint8_t* at) {
        return static_cast<std::uint16_t>(at[k] | at[k + 1] << 8);
      };
      const std::uint16_t stored = zigzag(static_cast<std::uint16_t>(number(after) - number(before)));
      delta[k] = static_cast<std::uint8_t>(stored);
      delta[k + 1] = static_cast<std::uint8_t>(stored >> 8);
    }
  } else {
    std::uint32_t difference = 0;
    for (std::size_t k = 0; k < 4; ++k) difference |= std::uint32_t(before[k] ^ after[k]) << (8 * k);
    difference = std::rotl(difference, channel >> 4);
    for (std::size_t k = 0; k < 4; ++k) delta[k] = static_cast<std::uint8_t>(difference >> (8 * k));
  }
  return delta;
}

void appendGroup(Bytes& stream, const std::uint8_t* deltas, unsigned bits) {
  if (bits == 0) return;
  if (bits == 8) {
    stream.insert(stream.end(), deltas, deltas + 16);
    return;
  }
  const auto sentinel = static_cast<std::uint8_t>((1u << bits) - 1);
  Bytes packed(16 * bits / 8), whole;
  for (unsigned i = 0; i < 16; ++i) {
    const std::uint8_t small = std::min(deltas[i], sentinel);
    if (small == sentinel) whole.push_back(deltas[i]);
    const unsigned place = i % (8 / bits);
    const unsigned shift = bits == 1 ? place : 8 - bits - bits * place;
    packed[i * bits / 8] |= static_cast<std::uint8_t>(small << shift);
  }
  stream.insert(stream.end(), packed.begin(), packed.end());
  stream.insert(stream.end(), whole.begin(), whole.end());
}

Bytes encodeVersion1(const Bytes& data, std::size_t stride, const Storage& storage, std::uint8_t channel) {
  const std::size_t count = data.size() / stride;
  const std::size_t blockElements = std::min<std::size_t>((8192 / stride) & ~std::size_t{15}, 256);
  Bytes stream = {0xa1};
  Bytes last(data.begin(), data.begin() + static_cast<std::ptrdiff_t>(stride));
  const Bytes baseline = last;
  for (std::size_t first = 0; first < count; first += blockElements) {
    const std::size_t elements = std::min(blockElements, count - first);
    stream.insert(stream.end(), stride / 4, static_cast<std::uint8_t>(storage.control * 0x55));
    const std::size_t groups = (elements + 15) / 16;
    for (std::size_t c = 0; c < stride / 4; ++c) {
      std::array<Bytes, 4> deltas;
      for (Bytes& d : deltas) d.resize(groups * 16);
      for (std::size_t i = 0; i < elements; ++i) {
        const std::uint8_t* after = &data[(first + i) * stride + 4 * c];
        const auto delta = deltaOf(&last[4 * c], after, channel);
        for (std::size_t k = 0; k < 4; ++k) deltas[k][i] = delta[k];
        std::copy_n(after, 4, &last[4 * c]);
      }
      for (const Bytes& d : deltas) {
        if (storage.control == 2) continue;
        if (storage.control == 3) {
          stream.insert(stream.end(), d.begin(), d.begin() + static_cast<std::ptrdiff_t>(elements));
          continue;
        }
        Bytes headers((groups + 3) / 4);
        for (std::size_t g = 0; g < groups; ++g)
          headers[g / 4] |= static_cast<std::uint8_t>(storage.header << (g % 4 * 2));
        stream.insert(stream.end(), headers.begin(), headers.end());
        for (std::size_t g = 0; g < groups; ++g) appendGroup(stream, &d[16 * g], storage.bits());
      }
    }
  }
  const std::size_t tail = stride + stride / 4;
  if (tail < 24) stream.insert(stream.end(), 24 - tail, 0);
  stream.insert(stream.end(), baseline.begin(), baseline.end());
  stream.insert(stream.end(), stride / 4, channel);
  return stream;
}

/// Bytes that rise and fall a little, with occasional jumps.
Bytes wavy(std::size_t size) {
  std::mt19937 random(5);
  Bytes data(size);
  for (std::size_t i = 0; i < size; ++i)
    data[i] = static_cast<std::uint8_t>(random() % 20 == 0 ? random() : i / 40 + random() % 3);
  return data;
}

TEST(MeshoptVersion1, EveryStorage_GivesWhatWentIn) {
  for (const std::size_t stride : {4u, 12u, 64u, 256u}) {
    for (const std::size_t count : {1u, 15u, 16u, 33u, 300u}) {
      const Bytes data = wavy(stride * count);
      for (const std::uint8_t channel : Bytes{0x00, 0x01, 0x02, 0x52}) {
        for (const Storage storage :
             {Storage{0, 1}, {0, 2}, {0, 3}, {1, 0}, {1, 1}, {1, 2}, {1, 3}, {3, 0}}) {
          const Bytes stream = encodeVersion1(data, stride, storage, channel);
          Bytes decoded(data.size());
          ASSERT_TRUE(isVersion1(stream));
          ASSERT_TRUE(decodeVersion1(stream, stride, decoded))
              << stride << " " << count << " " << storage.control;
          ASSERT_EQ(decoded, data) << stride << " " << count << " " << storage.control << storage.header;
        }
      }
    }
  }
}

TEST(MeshoptVersion1, NoDeltas_RepeatTheFirstElement) {
  const Bytes element = {1, 2, 3, 4, 250, 6, 7, 8};
  Bytes data;
  for (int i = 0; i < 40; ++i) data.insert(data.end(), element.begin(), element.end());
  for (const Storage storage : {Storage{2, 0}, {0, 0}}) {
    Bytes decoded(data.size());
    ASSERT_TRUE(decodeVersion1(encodeVersion1(data, 8, storage, 0), 8, decoded));
    EXPECT_EQ(decoded, data);
  }
}

TEST(MeshoptVersion1, CutShortOrTooLong_IsBroken) {
  const Bytes data = wavy(12 * 50);
  const Bytes good = encodeVersion1(data, 12, {0, 3}, 0);
  Bytes decoded(data.size());
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_FALSE(
        decodeVersion1(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)), 12, decoded));
  Bytes longer = good;
  longer.insert(longer.end() - 24, 0);
  EXPECT_FALSE(decodeVersion1(longer, 12, decoded));
  Bytes unknown = good;
  unknown.back() = 3;
  EXPECT_FALSE(decodeVersion1(unknown, 12, decoded));
}

/// Luma and chroma have 8 bits; alpha has 7 with the marker bit above. The colour is red 200, green 100, blue
/// 40, alpha 1.
TEST(MeshoptColors, FullPrecision_GivesTheColour) {
  // Integer arithmetic: co = (r - b) / 2, t = (r + b) / 2, y = (g + t) / 2, cg = (g - t) / 2.
  Bytes data = {110, 80, static_cast<std::uint8_t>(-10), 0xFF};
  decodeColors(data, 4);
  EXPECT_EQ(data, (Bytes{200, 100, 40, 255}));
}

TEST(MeshoptColors, FewerBits_AreScaledToAll) {
  // Five bits: y is 16 without chroma, and alpha is 0 in four bits below bit 4.
  Bytes data = {16, 0, 0, 0x10};
  decodeColors(data, 4);
  EXPECT_EQ(data, (Bytes{132, 132, 132, 0}));  // 16 / 31 x 255 = 131.6.
  Bytes wide = {16, 0, 0, 0, 0, 0, 0x10, 0};
  decodeColors(wide, 8);
  EXPECT_EQ(wide[0] | wide[1] << 8, 33825);  // 16 / 31 x 65535 = 33824.5.
}

}  // namespace
}  // namespace prelight
