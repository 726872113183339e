#pragma once

#include <OpenEXR/ImfIO.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "images/pixels.h"
#include "prelight/error.h"
#include "prelight/picture.h"

namespace prelight {

/// Memory that OpenEXR writes to. It supports seeking back, as the table of rows precedes the rows. Unlike
/// writing to a file, it cannot fail silently.
class ExrMemory final : public Imf::OStream {
 public:
  explicit ExrMemory(std::vector<std::byte>& bytes) : OStream("memory"), bytes_(bytes) {}

  void write(const char data[], int size) override {
    const auto count = static_cast<std::size_t>(size);
    bytes_.resize(std::max(bytes_.size(), at_ + count));
    std::memcpy(bytes_.data() + at_, data, count);
    at_ += count;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = position; }

 private:
  std::vector<std::byte>& bytes_;
  std::size_t at_ = 0;
};

/// Returns the bytes of a file, about `expected`, that `write` writes to an ExrMemory. Throws Error about
/// `shown`.
template <typename Write>
std::vector<std::byte> encodeExrFile(const std::filesystem::path& shown, std::size_t expected,
                                     const Write& write) {
  std::vector<std::byte> bytes;
  bytes.reserve(expected);
  ExrMemory memory(bytes);
  try {
    write(memory);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(ExitCode::RuntimeFailure, shown.string(), std::string("cannot be written: ") + error.what());
  }
  return bytes;
}

/// Encodes an .exr file of one part with R, G, B as 32-bit floats. It uses OpenEXR directly, because the
/// image library takes longer to load than many a picture takes to draw (images/image_library.h). Throws
/// Error about `shown`.
std::vector<std::byte> encodePlainExr(const std::filesystem::path& shown, const Picture& picture);

/// Decodes an .exr file of one part in scanlines with only R, G and B. Returns nullopt for other files and
/// for broken, truncated or too large ones. Throws std::bad_alloc.
std::optional<Pixels> decodePlainExr(std::span<const std::uint8_t> bytes);

/// One part of a multi-part .exr file.
struct ExrPart {
  std::string name;
  std::vector<std::string> channels;  ///< names of the channels
  std::span<const float> values;      ///< [row][column][channel]
};

/// Encodes a compressed .exr file whose parts have one size. Equal pictures give equal bytes. Throws Error
/// about `shown`.
std::vector<std::byte> encodeLayeredExr(const std::filesystem::path& shown, int width, int height,
                                        std::span<const ExrPart> parts);

}  // namespace prelight
