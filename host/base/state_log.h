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

/// Returns the path of the state of a computation that writes `output`: beside it, with ".state" added.
std::filesystem::path stateFileOf(const std::filesystem::path& output);

/// The state of interrupted work in a file: named records and arrays. Writes become part of the state with
/// the next commit(), all at once: a reader finds the state of a commit, whenever its writer ended. Replaced
/// and erased records stay in the file until they take more room than the others.
///
/// The first commit creates the file, or replaces one that no run continues. Only its owner may read it.
///
/// Functions that write throw Error (RuntimeFailure); the state is then that of the last commit.
class StateLog {
 public:
  /// Starts a new state. `kind` names the computation ("bake"), `key` identifies what the state belongs to.
  StateLog(std::filesystem::path path, std::string kind, StateKey key);
  StateLog(StateLog&&) noexcept;
  StateLog(const StateLog&) = delete;
  StateLog& operator=(const StateLog&) = delete;
  StateLog& operator=(StateLog&&) = delete;
  ~StateLog();

  enum class Access : std::uint8_t {
    Continue,  ///< by one process at a time, which locks the file
    Read,      ///< by any number of processes; nothing may be written
  };

  /// Opens an existing state; returns nothing when there is no such file. Throws InputError for a file that
  /// is damaged, is no state, or has another kind or version. Throws UsageError for one that belongs to
  /// another key, naming the parts that differ, and for one to be continued that another process writes.
  static std::optional<StateLog> open(const std::filesystem::path& path, const std::string& kind,
                                      const StateKey& key, Access access = Access::Continue);

  /// Opens a state of any kind and key. Throws otherwise as open() does.
  static std::optional<StateLog> openAny(const std::filesystem::path& path, Access access);

  const std::string& kind() const { return kind_; }
  const StateKey& key() const { return key_; }

  bool has(const std::string& name) const { return contents_.records.contains(name); }
  std::vector<std::string> names() const;
  std::vector<std::byte> read(const std::string& name) const;

  /// An array in the state.
  struct ArrayShape {
    std::string name;
    std::uint64_t epoch = 0;
    std::uint64_t count = 0;
    std::size_t elementSize = 0;
  };
  std::vector<ArrayShape> arrays() const;

  /// Replaces a record by the bytes that `fill` writes.
  void write(const std::string& name, const std::function<void(const StateWriter::Sink& sink)>& fill);

  /// Writes the elements of an array that have not been written; with another epoch, all of them.
  void writeArray(const std::string& name, std::uint64_t epoch, std::uint64_t count, std::size_t elementSize,
                  const ReadElements& read);

  /// Returns true if there is such an array.
  bool hasArray(const std::string& name, std::uint64_t epoch, std::uint64_t count,
                std::size_t elementSize) const;

  /// Reads an array. Returns false, and reads nothing, unless it has `count` elements.
  bool readArray(const std::string& name, std::uint64_t count, std::size_t elementSize,
                 const WriteElements& write) const;

  /// Erases the records and arrays whose names begin with `prefix`.
  void erase(const std::string& prefix);

  /// Returns true if a record's or array's name begins with `prefix`.
  bool hasAny(std::string_view prefix) const;

  /// Makes everything written since the last commit part of the state. `seconds`: time of the work that led
  /// to it.
  void commit(double seconds);

  /// Discards everything written since the last commit.
  void rollBack() noexcept;

  /// Returns the time of work at the last commit, s.
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
    std::uint64_t end = 0;    ///< end of the used part of the file
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
  bool take(Kind kind, const std::string& name, const Place& place, const std::byte* arrayHead);
  void writeSlot();
  void compact();
  bool scan(const Slot& slot);
  [[noreturn]] void damaged() const;

  std::filesystem::path path_;
  std::string kind_;
  StateKey key_;
  std::unique_ptr<File> file_;   ///< nullptr: created by the next write
  std::unique_ptr<File> older_;  ///< the original, while file_ is a copy that is not in place yet
  std::uint64_t headerBytes_ = 0;
  Contents contents_, committed_;
};

}  // namespace prelight
