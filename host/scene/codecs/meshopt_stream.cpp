#include "scene/codecs/meshopt_stream.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "prelight/error.h"

namespace prelight {

// Numbers in brackets refer to KHR_meshopt_compression, appendix A, mode 0.

namespace {

constexpr std::uint8_t headerVersion1 = 0xa1;
constexpr std::size_t groupSize = 16;
constexpr std::size_t mostBlockElements = 256;

/// Reads the compressed bytes from front to back; reading beyond the end marks the stream as broken.
class Source {
 public:
  explicit Source(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  /// Returns the next bytes, or none when there are fewer.
  std::span<const std::uint8_t> take(std::size_t count) {
    if (count > bytes_.size()) {
      broken_ = true;
      return {};
    }
    const auto taken = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return taken;
  }
  bool isBroken() const { return broken_; }
  bool isEmpty() const { return bytes_.empty(); }

 private:
  std::span<const std::uint8_t> bytes_;
  bool broken_ = false;
};

using Group = std::array<std::uint8_t, groupSize>;

/// Reads sixteen deltas of `bits` bits; a delta with all bits set stands for a byte behind them.
bool readGroup(Source& source, unsigned bits, std::uint8_t* out) {
  if (bits == 0) {
    std::fill_n(out, groupSize, std::uint8_t{0});
    return true;
  }
  const auto packed = source.take(groupSize * bits / 8);
  if (source.isBroken()) return false;
  if (bits == 8) {
    std::copy(packed.begin(), packed.end(), out);
    return true;
  }
  const unsigned sentinel = (1u << bits) - 1;
  const unsigned perByte = 8 / bits;
  for (std::size_t i = 0; i < groupSize; ++i) {
    const unsigned place = static_cast<unsigned>(i) % perByte;
    // Single bits begin at the low end, pairs and fours at the high end.
    const unsigned shift = bits == 1 ? place : 8 - bits * (place + 1);
    const unsigned delta = packed[i / perByte] >> shift & sentinel;
    out[i] = static_cast<std::uint8_t>(delta);
    if (delta != sentinel) continue;
    const auto whole = source.take(1);
    if (source.isBroken()) return false;
    out[i] = whole[0];
  }
  return true;
}

/// Reads the deltas of one byte of a block's elements.
bool readDeltas(Source& source, unsigned control, std::size_t elements, std::span<std::uint8_t> out) {
  constexpr std::array<std::array<unsigned, 4>, 2> bitsOf = {{{0, 1, 2, 4}, {1, 2, 4, 8}}};
  if (control == 2) {
    std::fill(out.begin(), out.end(), std::uint8_t{0});
    return true;
  }
  if (control == 3) {
    const auto whole = source.take(elements);
    std::copy(whole.begin(), whole.end(), out.begin());
    return !source.isBroken();
  }
  const std::size_t groups = (elements + groupSize - 1) / groupSize;
  const auto header = source.take((groups + 3) / 4);
  if (source.isBroken()) return false;
  for (std::size_t g = 0; g < groups; ++g) {
    const unsigned mode = header[g / 4] >> (g % 4 * 2) & 3;
    if (!readGroup(source, bitsOf[control][mode], &out[g * groupSize])) return false;
  }
  return true;
}

template <class Number>
Number unzigzag(Number v) {
  return static_cast<Number>((v & 1) != 0 ? ~(v >> 1) : v >> 1);
}

/// Adds the deltas of four bytes of an element to `last`, according to their channel.
void addDeltas(std::uint8_t channel, const std::array<std::uint8_t, 4>& delta, std::uint8_t* last) {
  const unsigned mode = channel & 15u;
  if (mode == 0) {
    for (std::size_t k = 0; k < 4; ++k) last[k] = static_cast<std::uint8_t>(last[k] + unzigzag(delta[k]));
  } else if (mode == 1) {
    for (std::size_t k = 0; k < 4; k += 2) {
      const auto stored = static_cast<std::uint16_t>(delta[k] | delta[k + 1] << 8);
      const auto before = static_cast<std::uint16_t>(last[k] | last[k + 1] << 8);
      const auto sum = static_cast<std::uint16_t>(before + unzigzag(stored));
      last[k] = static_cast<std::uint8_t>(sum);
      last[k + 1] = static_cast<std::uint8_t>(sum >> 8);
    }
  } else {
    std::uint32_t stored = 0;
    for (std::size_t k = 0; k < 4; ++k) stored |= std::uint32_t{delta[k]} << (8 * k);
    stored = std::rotr(stored, channel >> 4);
    for (std::size_t k = 0; k < 4; ++k) last[k] ^= static_cast<std::uint8_t>(stored >> (8 * k));
  }
}

bool areChannels(std::span<const std::uint8_t> channels) {
  return std::all_of(channels.begin(), channels.end(),
                     [](std::uint8_t c) { return (c & 15) == 2 || c == 0 || c == 1; });
}

/// Reads a block of consecutive elements to `out`; `last` is the element before the block and becomes its
/// last one.
bool readBlock(Source& source, std::size_t elements, std::span<const std::uint8_t> channels,
               std::vector<std::uint8_t>& last, std::uint8_t* out) {
  const std::size_t stride = last.size();
  const auto controls = source.take(channels.size());
  if (source.isBroken()) return false;
  std::vector<std::uint8_t> deltas(4 * mostBlockElements);
  for (std::size_t channel = 0; channel < channels.size(); ++channel) {
    for (std::size_t k = 0; k < 4; ++k) {
      const unsigned control = controls[channel] >> (2 * k) & 3;
      if (!readDeltas(source, control, elements,
                      std::span(deltas).subspan(k * mostBlockElements, mostBlockElements)))
        return false;
    }
    for (std::size_t i = 0; i < elements; ++i) {
      const std::array<std::uint8_t, 4> delta = {deltas[i], deltas[mostBlockElements + i],
                                                 deltas[2 * mostBlockElements + i],
                                                 deltas[3 * mostBlockElements + i]};
      addDeltas(channels[channel], delta, &last[4 * channel]);
      std::copy_n(&last[4 * channel], 4, out + i * stride + 4 * channel);
    }
  }
  return true;
}

}  // namespace

std::size_t attributeBlockElements(std::size_t stride) {
  return std::min((8192 / stride) & ~(groupSize - 1), mostBlockElements);
}

bool isVersion1(std::span<const std::uint8_t> stream) {
  return !stream.empty() && stream[0] == headerVersion1;
}

bool decodeVersion1(std::span<const std::uint8_t> stream, std::size_t stride,
                    std::vector<std::uint8_t>& out) {
  // The tail: padding up to 24 bytes, the element before the first, and the channel of each four bytes of an
  // element.
  constexpr std::size_t leastTail = 24;
  const std::size_t channelCount = stride / 4;
  const std::size_t tail = std::max(leastTail, stride + channelCount);
  if (stream.size() < 1 + tail) return false;
  const auto channels = stream.last(channelCount);
  const auto baseline = stream.last(channelCount + stride).first(stride);
  if (!areChannels(channels)) return false;
  std::vector<std::uint8_t> last(baseline.begin(), baseline.end());
  Source source(stream.subspan(1, stream.size() - 1 - tail));
  const std::size_t blockElements = attributeBlockElements(stride);
  const std::size_t count = out.size() / stride;
  for (std::size_t first = 0; first < count; first += blockElements) {
    const std::size_t elements = std::min(blockElements, count - first);
    if (!readBlock(source, elements, channels, last, &out[first * stride])) return false;
  }
  return source.isEmpty();
}

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

namespace {

constexpr const char* exportWithout = "the data are damaged, or export the scene without meshopt compression";

/// Decodes without applying the filter. Returns false when the stream is broken.
bool decodeElements(std::span<const std::uint8_t> stream, const MeshoptLayout& layout,
                    std::vector<std::uint8_t>& out) {
  switch (layout.mode) {
    case MeshoptMode::Triangles:
      return meshopt_decodeIndexBuffer(out.data(), layout.count, layout.stride, stream.data(),
                                       stream.size()) == 0;
    case MeshoptMode::Indices:
      return meshopt_decodeIndexSequence(out.data(), layout.count, layout.stride, stream.data(),
                                         stream.size()) == 0;
    default:
      break;
  }
  if (isVersion1(stream)) return decodeVersion1(stream, layout.stride, out);
  return meshopt_decodeVertexBuffer(out.data(), layout.count, layout.stride, stream.data(), stream.size()) ==
         0;
}

void applyFilter(const MeshoptLayout& layout, std::vector<std::uint8_t>& data) {
  switch (layout.filter) {
    case MeshoptFilter::None:
      return;
    case MeshoptFilter::Octahedral:
      return meshopt_decodeFilterOct(data.data(), layout.count, layout.stride);
    case MeshoptFilter::Quaternion:
      return meshopt_decodeFilterQuat(data.data(), layout.count, layout.stride);
    case MeshoptFilter::Exponential:
      return meshopt_decodeFilterExp(data.data(), layout.count, layout.stride);
    case MeshoptFilter::Color:
      return decodeColors(data, layout.stride);
  }
}

}  // namespace

std::uint64_t leastMeshoptBytes(const MeshoptLayout& layout) {
  constexpr std::uint64_t tableBytes = 16;
  constexpr std::uint64_t sequenceTail = 4;
  switch (layout.mode) {
    case MeshoptMode::Triangles:  // one code per triangle
      return 1 + layout.count / 3 + tableBytes;
    case MeshoptMode::Indices:  // one byte per index
      return 1 + layout.count + sequenceTail;
    default:
      break;
  }
  // For each block two bits per four bytes of an element, as in version 1, and the first element.
  const std::uint64_t blocks = (layout.count - 1) / attributeBlockElements(layout.stride) + 1;
  return 1 + blocks * (layout.stride / 4) + layout.stride;
}

std::vector<std::uint8_t> decodeMeshopt(std::span<const std::uint8_t> stream, const MeshoptLayout& layout,
                                        const std::string& where) {
  const std::uint64_t least = leastMeshoptBytes(layout);
  if (stream.size() < least)
    throw InputError(where,
                     fmt::format("{} elements of {} bytes in {} compressed bytes, they take {} at least",
                                 layout.count, layout.stride, stream.size(), least),
                     exportWithout);
  std::vector<std::uint8_t> data(layout.bytes());
  if (!decodeElements(stream, layout, data))
    throw InputError(where,
                     fmt::format("the meshopt stream cannot be decoded (header byte {:#04x})", stream[0]),
                     exportWithout);
  applyFilter(layout, data);
  return data;
}

}  // namespace prelight
