#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/state_file.h"

namespace prelight {

/// Where the state of a computation that writes `output` is kept: beside it, with ".state" added.
std::filesystem::path stateFileOf(const std::filesystem::path& output);

/// The state of interrupted work in a file: named records and arrays. What is written joins the state with
/// the next commit(), all at once: whoever reads the file, whenever its writer ended, finds what a commit
/// left. Records that were replaced or erased stay in the file until they take more room than the others.
///
/// The file appears with the first commit, in place of an older one. Nobody but its owner may read it.
///
/// What writes throws Error (RuntimeFailure); the state is then that of the last commit.
class StateLog {
 public:
  /// A new state. `kind` says of which computation ("bake"), `key` to what it belongs.
  StateLog(std::filesystem::path path, std::string kind, StateKey key);
  StateLog(StateLog&&) noexcept;
  StateLog(const StateLog&) = delete;
  StateLog& operator=(const StateLog&) = delete;
  StateLog& operator=(StateLog&&) = delete;
  ~StateLog();

  /// The state that is there, to be read and gone on with; nothing when there is no such file. Throws
  /// InputError for a file that is damaged, none at all, of another kind or version, and UsageError for one
  /// that belongs to another key, naming the parts that differ, and for one that another process writes.
  static std::optional<StateLog> open(const std::filesystem::path& path, const std::string& kind,
                                      const StateKey& key);

  bool has(const std::string& name) const { return contents_.records.contains(name); }
  std::vector<std::string> names() const;
  std::vector<std::byte> read(const std::string& name) const;

  /// An array that there is.
  struct ArrayShape {
    std::string name;
    std::uint64_t epoch = 0;
    std::uint64_t count = 0;
    std::size_t elementSize = 0;
  };
  std::vector<ArrayShape> arrays() const;

  /// Replaces a record by what `fill` writes.
  void write(const std::string& name, const std::function<void(const StateWriter::Sink& sink)>& fill);

  /// Writes the elements of an array that are not there yet. Another epoch: all of them.
  void writeArray(const std::string& name, std::uint64_t epoch, std::uint64_t count, std::size_t elementSize,
                  const ReadElements& read);

  /// True where there is such an array.
  bool hasArray(const std::string& name, std::uint64_t epoch, std::uint64_t count,
                std::size_t elementSize) const;

  /// False, and nothing is read, unless the array has so many elements.
  bool readArray(const std::string& name, std::uint64_t count, std::size_t elementSize,
                 const WriteElements& write) const;

  /// Erases the records and arrays whose names begin so.
  void erase(const std::string& prefix);

  /// True where a record or array has a name that begins so.
  bool hasAny(std::string_view prefix) const;

  /// Makes what was written since the last commit the state. `seconds`: of work that led to it.
  void commit(double seconds);

  /// Forgets what was written since the last commit.
  void rollBack() noexcept;

  /// Of the last commit.
  double seconds() const { return committed_.seconds; }

  const std::filesystem::path& path() const { return path_; }

 private:
  class File;

  struct Place {
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
  };
  struct Array {
    std::uint64_t epoch = 0;
    std::uint64_t count = 0;
    std::uint64_t elementSize = 0;
    std::vector<Place> chunks;
  };
  struct Contents {
    std::map<std::string, Place, std::less<>> records;
    std::map<std::string, Array, std::less<>> arrays;
    std::uint64_t end = 0;    ///< of the file's part that counts
    std::uint64_t chain = 0;  ///< hash of all heads up to there
    std::uint64_t sequence = 0;
    double seconds = 0.0;

    std::uint64_t liveBytes() const;
  };
  enum class Kind : std::uint32_t { Record = 1, Array = 2, Erased = 3 };
  struct Head;
  struct Slot;

  void begin();
  void append(Kind kind, const std::string& name,
              const std::function<void(const StateWriter::Sink& sink)>& fill);
  void take(Kind kind, const std::string& name, const Place& place, const std::byte* arrayHead);
  void writeSlot();
  void compact();
  void scan(const Slot& slot);
  [[noreturn]] void damaged() const;

  std::filesystem::path path_;
  std::string kind_;
  StateKey key_;
  std::unique_ptr<File> file_;   ///< nullptr: made when something is written
  std::unique_ptr<File> older_;  ///< while file_ is a copy of it that is not in its place yet
  std::uint64_t headerBytes_ = 0;
  Contents contents_, committed_;
};

}  // namespace prelight
