#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace prelight {

/// 64-bit hash of a sequence of values, the same on every run: FNV-1a over 64-bit words, mixed at the end.
/// Not meant to withstand attackers.
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

/// What a state belongs to, part by part: name (as an error message calls it) and hash.
using StateKey = std::vector<std::pair<std::string, std::uint64_t>>;

/// Collects a state's payload, or hands it on block by block, so that a large one never lies in memory as a
/// whole.
class StateWriter {
 public:
  using Sink = std::function<void(std::span<const std::byte>)>;
  static constexpr std::size_t blockSize = std::size_t{1} << 20;

  /// Keeps everything for payload().
  StateWriter() = default;

  /// Gives blocks of `blockSize` bytes to `sink`, and the last with flush().
  explicit StateWriter(Sink sink) : sink_(std::move(sink)) {}

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

  void bytes(std::span<const std::byte> data);
  void flush();

  std::span<const std::byte> payload() const { return bytes_; }

 private:
  Sink sink_;
  std::vector<std::byte> bytes_;
};

/// Reads a payload back, in the order in which it was written. Throws InputError when it ends too early or a
/// length makes no sense.
class StateReader {
 public:
  /// `path` is named in errors.
  StateReader(std::filesystem::path path, std::vector<std::byte> payload)
      : path_(std::move(path)), payload_(std::move(payload)) {}

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

  /// Does as values() for a vector that must have as many elements as the one given.
  template <typename T>
  void sameSize(std::vector<T>& out) {
    const std::size_t expected = out.size();
    values(out);
    require(out.size() == expected);
  }

  /// What a state that this program has written always keeps to. A payload is not trusted because its hash is
  /// right.
  void require(bool holds) const {
    if (!holds) damaged();
  }

  /// Throws unless all are finite numbers.
  void requireFinite(std::span<const float> numbers) const;
  void requireFinite(std::span<const double> numbers) const;

  /// What has not been read yet.
  std::span<const std::byte> rest() const { return std::span(payload_).subspan(at_); }

  [[noreturn]] void damaged() const;

 private:
  const std::byte* take(std::uint64_t count, std::size_t size);

  std::filesystem::path path_;
  std::vector<std::byte> payload_;
  std::size_t at_ = 0;
};

/// Where the state of a computation that writes `output` is kept: beside it, with ".state" added.
std::filesystem::path stateFileOf(const std::filesystem::path& output);

/// Writes beside, then renames: an older state stays whole until the new one is. Nobody but its owner may
/// read it. `kind` says which computation it is ("bake"). Throws Error (RuntimeFailure).
void writeStateFile(const std::filesystem::path& path, const std::string& kind, const StateKey& key,
                    const std::function<void(StateWriter&)>& write);
void writeStateFile(const std::filesystem::path& path, const std::string& kind, const StateKey& key,
                    std::span<const std::byte> payload);

/// The payload, or nothing when there is no such file. Throws InputError for a file that is damaged, none at
/// all, of another kind or version, and UsageError for a whole one that belongs to another key, naming the
/// parts that differ.
std::optional<StateReader> readStateFile(const std::filesystem::path& path, const std::string& kind,
                                         const StateKey& key);

}  // namespace prelight
