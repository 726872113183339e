#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/spans.h"

namespace prelight {

/// Calls use(first, count) for consecutive pieces of [0, count) of about four megabytes each, for elements of
/// `elementSize` bytes.
template <typename Use>
void forPieces(std::uint64_t count, std::size_t elementSize, const Use& use) {
  constexpr std::size_t pieceBytes = std::size_t{1} << 22;
  const std::uint64_t most = std::max<std::uint64_t>(1, pieceBytes / std::max<std::size_t>(1, elementSize));
  for (std::uint64_t first = 0; first < count; first += most) use(first, std::min(most, count - first));
}

/// 64-bit hash of a sequence of values, equal in every run: FNV-1a over 64-bit words, mixed at the end. Not
/// cryptographic.
class StateHash {
 public:
  StateHash& bytes(std::span<const std::byte> data);
  StateHash& text(const std::string& text);

  template <typename T>
  StateHash& value(const T& value) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>,
                  "padding has no fixed value");
    return bytes(std::as_bytes(std::span(&value, 1)));
  }

  /// Elements without padding: numbers and vectors of them.
  template <typename T>
  StateHash& values(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    value(values.size());
    return bytes(std::as_bytes(std::span(values)));
  }

  std::uint64_t result() const;

 private:
  void word(std::uint64_t word);

  std::uint64_t state_ = 0xcbf29ce484222325u;
};

/// Identifies what a state belongs to, part by part: name (as error messages call it) and hash.
using StateKey = std::vector<std::pair<std::string, std::uint64_t>>;

/// Returns the names of the parts in which a key differs from the expected one, as "scene, seed".
std::string differencesOf(const StateKey& found, const StateKey& expected);

/// Returns elements [first, first + count) of an array, as bytes that are valid until the next call.
using ReadElements = std::function<std::span<const std::byte>(std::uint64_t first, std::uint64_t count)>;

/// Takes consecutive elements of an array, from number `first` on.
using WriteElements = std::function<void(std::uint64_t first, std::span<const std::byte> elements)>;

/// Stores append-only arrays apart from the rest of a payload, so that stored elements are not written again.
/// The arrays of a payload are identified by their order.
class GrownArrays {
 public:
  virtual ~GrownArrays() = default;

  /// Stores the elements that have not been stored before. Stored elements do not change as long as `epoch`
  /// is the same.
  virtual void keep(std::uint64_t epoch, std::uint64_t count, std::size_t elementSize,
                    const ReadElements& read) = 0;

  /// Passes all elements of the next array to `write`. Returns false, and passes none, unless it has `count`.
  virtual bool fetch(std::uint64_t count, std::size_t elementSize, const WriteElements& write) = 0;
};

/// Collects a state's payload, or passes it on block by block, so that a large one is never in memory as a
/// whole. It has the same functions as StateReader, so that one function can write and read a state.
class StateWriter {
 public:
  using Sink = std::function<void(std::span<const std::byte>)>;
  static constexpr std::size_t blockSize = std::size_t{1} << 20;

  /// Keeps everything for payload().
  StateWriter() = default;

  /// Passes blocks of `blockSize` bytes to `sink`, the last one with flush(). Append-only arrays go to
  /// `arrays`; nullptr: into the payload. Both must outlive the writer.
  explicit StateWriter(Sink sink, GrownArrays* arrays = nullptr) : sink_(std::move(sink)), arrays_(arrays) {}

  /// Stores only append-only arrays.
  explicit StateWriter(GrownArrays& arrays) : arrays_(&arrays), arraysAlone_(true) {}

  template <typename T>
  void value(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes(std::as_bytes(std::span(&value, 1)));
  }

  template <typename T>
  void values(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    value(std::uint64_t{values.size()});
    bytes(std::as_bytes(std::span(values)));
  }

  void text(const std::string& text) { values(std::vector<char>(text.begin(), text.end())); }

  template <typename T>
  void sameSize(const std::vector<T>& out) {
    values(out);
  }

  /// Writes elements whose number the reader knows.
  template <typename T>
  void elements(std::span<T> elements) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes(std::as_bytes(elements));
  }

  /// Writes the first `count` elements of a vector. They must not have changed since the state was last
  /// written, unless `epoch` has.
  template <typename T>
  void growing(const std::vector<T>& values, std::uint64_t count, std::uint64_t epoch = 0) {
    static_assert(std::is_trivially_copyable_v<T>);
    growing(epoch, count, sizeof(T), [&](std::uint64_t first, std::uint64_t some) {
      return std::as_bytes(std::span(values).subspan(first, some));
    });
  }
  template <typename T>
  void growing(const std::vector<T>& values) {
    growing(values, values.size());
  }

  /// Writes an append-only array that is read piece by piece.
  void growing(std::uint64_t epoch, std::uint64_t count, std::size_t elementSize, const ReadElements& read);

  void bytes(std::span<const std::byte> data);
  void flush();

  /// These do nothing: what is written satisfies all requirements of a reader.
  void require(bool /*holds*/) const {}
  void requireFinite(std::span<const float> /*numbers*/) const {}
  void requireFinite(std::span<const double> /*numbers*/) const {}
  template <typename Holds>
  void check(const Holds& /*holds*/) const {}

  std::span<const std::byte> payload() const { return bytes_; }

 private:
  Sink sink_;
  GrownArrays* arrays_ = nullptr;
  bool arraysAlone_ = false;
  std::vector<std::byte> bytes_;
};

/// Reads a payload in the order in which it was written. Throws InputError when it ends too early or a length
/// is impossible.
class StateReader {
 public:
  /// `path` is named in errors. `arrays`: where append-only arrays were stored; nullptr: in the payload. It
  /// must outlive the reader.
  StateReader(std::filesystem::path path, std::vector<std::byte> payload, GrownArrays* arrays = nullptr)
      : path_(std::move(path)), payload_(std::move(payload)), arrays_(arrays) {}

  template <typename T>
  void value(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::byte* source = take(1, sizeof value);
    if constexpr (std::is_same_v<T, bool>) require(*source == std::byte{0} || *source == std::byte{1});
    std::memcpy(&value, source, sizeof value);
  }

  template <typename T>
  void values(std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::uint64_t size = 0;
    value(size);
    const std::byte* source = take(size, sizeof(T));
    values.resize(size);
    if (size > 0) std::memcpy(values.data(), source, size * sizeof(T));
  }

  void text(std::string& text) {
    std::vector<char> characters;
    values(characters);
    text.assign(characters.begin(), characters.end());
  }

  /// Reads as values() does, and requires as many elements as the given vector has.
  template <typename T>
  void sameSize(std::vector<T>& out) {
    const std::size_t expected = out.size();
    values(out);
    require(out.size() == expected);
  }

  template <typename T>
  void elements(std::span<T> out) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::memcpy(out.data(), take(out.size(), sizeof(T)), out.size_bytes());
  }

  /// Reads the first `count` elements of a vector of at least that size; the state must have as many.
  template <typename T>
  void growing(std::vector<T>& values, std::uint64_t count, std::uint64_t /*epoch*/ = 0) {
    require(grownCount() == count && count <= values.size());
    fillGrown(values, count);
  }

  /// Reads all elements of an array; the vector takes its size.
  template <typename T>
  void growing(std::vector<T>& values) {
    values.clear();
    fillGrown(values, grownCount());
  }

  /// Reads an append-only array that is written piece by piece and has `count` elements, or any number.
  void growing(std::uint64_t count, std::size_t elementSize, const WriteElements& write);
  void growing(std::size_t elementSize, const WriteElements& write) {
    fetchGrown(grownCount(), elementSize, write);
  }

  /// Requires a condition that every state written by this program satisfies. A payload is not trusted merely
  /// because its hash is right.
  void require(bool holds) const {
    if (!holds) damaged();
  }

  /// Throws unless all numbers are finite.
  void requireFinite(std::span<const float> numbers) const;
  void requireFinite(std::span<const double> numbers) const;

  /// Requires the result of holds(), for conditions that take time to check.
  template <typename Holds>
  void check(const Holds& holds) const {
    require(holds());
  }

  /// True for a process that does pieces of the work for others: what decides which pieces there are is
  /// enough, and the rest need not be read. States begin with the former.
  bool partial() const { return partial_; }
  void setPartial() { partial_ = true; }

  /// Returns the bytes that have not been read yet.
  std::span<const std::byte> rest() const { return std::span(payload_).subspan(at_); }

  [[noreturn]] void damaged() const;

 private:
  /// Resizes the vector only once it is known that there are as many elements.
  template <typename T>
  void fillGrown(std::vector<T>& values, std::uint64_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    fetchGrown(count, sizeof(T), [&](std::uint64_t first, std::span<const std::byte> elements) {
      values.resize(std::max<std::size_t>(values.size(), count));
      std::memcpy(values.data() + first, elements.data(), elements.size());
    });
  }

  std::uint64_t grownCount();
  void fetchGrown(std::uint64_t count, std::size_t elementSize, const WriteElements& write);
  const std::byte* take(std::uint64_t count, std::size_t size);

  std::filesystem::path path_;
  std::vector<std::byte> payload_;
  GrownArrays* arrays_ = nullptr;
  std::size_t at_ = 0;
  bool partial_ = false;
};

}  // namespace prelight
