#pragma once

#include <OpenEXR/ImfIO.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

#include "prelight/error.h"

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

}  // namespace prelight
