#pragma once

#include <cstdint>
#include <string>

namespace prelight {

/// What the compressed parts of a document may be decoded to, all together: 2^26 bytes and 256 for each byte
/// of its data, as parts may share their data.
class DecodedBytes {
 public:
  explicit DecodedBytes(std::uint64_t documentBytes);

  std::uint64_t left() const { return left_; }
  /// Takes bytes off before they are allocated. Throws InputError about `where` when there are not so many.
  void take(std::uint64_t bytes, const std::string& where);

 private:
  std::uint64_t left_;
};

}  // namespace prelight
