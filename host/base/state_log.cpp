#include "base/state_log.h"

#define XXH_INLINE_ALL  // no library to link: this file alone uses it
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "base/atomic_file.h"
#include "base/file_lock.h"
#include "base/files.h"
#include "base/state_file.h"
#include "prelight/error.h"

namespace prelight {

namespace fs = std::filesystem;

namespace {

constexpr std::array<char, 8> magic = {'P', 'R', 'L', 'S', 'T', 'A', 'T', 'E'};
constexpr std::uint32_t version = 4;
constexpr const char* startAnew = "delete it to start anew";
constexpr const char* heldByAnother = "another run is continuing it";
constexpr const char* cannotRead = "cannot read the state of the interrupted run";
constexpr mode_t ownerOnly = 0600;
constexpr std::uint64_t toleratedWaste = std::uint64_t{64} << 20;  // bytes of a file that are no longer used
constexpr std::size_t longestName = 4096;

/// Returns the title of the file: the state's kind and key.
std::vector<std::byte> titleBytes(const std::string& kind, const StateKey& key) {
  StateWriter writer;
  writer.text(kind);
  writer.value(static_cast<std::uint32_t>(key.size()));
  for (const auto& [name, hash] : key) {
    writer.text(name);
    writer.value(hash);
  }
  return {writer.payload().begin(), writer.payload().end()};
}

/// Reads what titleBytes() wrote.
void readTitleBytes(StateReader& reader, std::string& kind, StateKey& key) {
  reader.text(kind);
  std::uint32_t parts = 0;
  reader.value(parts);
  for (std::uint32_t i = 0; i < parts; ++i) {
    std::string name;
    reader.text(name);
    std::uint64_t hash = 0;
    reader.value(hash);
    key.emplace_back(std::move(name), hash);
  }
}

template <typename T>
std::span<const std::byte> bytesOf(const T& value) {
  static_assert(std::has_unique_object_representations_v<T>);
  return std::as_bytes(std::span(&value, 1));
}

/// The first bytes of a file.
struct Preamble {
  std::array<char, 8> magic{};
  std::uint32_t version = 0;
  std::uint32_t titleBytes = 0;
  std::uint64_t titleHash = 0;
};

/// The first bytes of an array's record.
struct ArrayHead {
  std::uint64_t epoch = 0;
  std::uint64_t first = 0;
  std::uint64_t count = 0;
  std::uint64_t elementSize = 0;
};

std::uint64_t hashOf(std::span<const std::byte> bytes) { return StateHash().bytes(bytes).result(); }

/// Checksum of a record's payload, which may have gigabytes.
class PayloadChecksum {
 public:
  PayloadChecksum() { XXH3_64bits_reset(&state_); }
  void add(std::span<const std::byte> bytes) { XXH3_64bits_update(&state_, bytes.data(), bytes.size()); }
  std::uint64_t result() const { return XXH3_64bits_digest(&state_); }

 private:
  XXH3_state_t state_;
};

}  // namespace

/// Precedes the name and the bytes of a record.
struct StateLog::Head {
  std::uint64_t nameHash = 0;
  std::uint64_t payloadHash = 0;
  std::uint64_t payloadBytes = 0;
  std::uint32_t nameBytes = 0;
  Kind kind = Kind::Record;
};

/// The record of a commit. A file has those of the last two.
struct StateLog::Slot {
  std::uint64_t sequence = 0;  ///< counts commits
  std::uint64_t end = 0;
  std::uint64_t chain = 0;
  std::uint64_t seconds = 0;  ///< bits of a double
  std::uint64_t check = 0;

  std::uint64_t rightCheck() const {
    return StateHash().value(sequence).value(end).value(chain).value(seconds).result();
  }
};

/// The state's file, before and after it is moved into place.
class StateLog::File {
 public:
  explicit File(const fs::path& path) : path_(path), pending_(std::in_place, path, ownerOnly) {}
  File(const fs::path& path, int descriptor) : path_(path), descriptor_(descriptor) {}
  ~File() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  void write(std::uint64_t offset, std::span<const std::byte> bytes) {
    if (pending_) return pending_->overwrite(offset, bytes);
    while (!bytes.empty()) {
      const ssize_t count = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0)
        throw Error(ExitCode::RuntimeFailure, path_.string(),
                    std::string("cannot write: ") + std::strerror(count < 0 ? errno : ENOSPC),
                    "check the folder, its permissions and free space");
      bytes = bytes.subspan(static_cast<std::size_t>(count));
      offset += static_cast<std::uint64_t>(count);
    }
  }

  void read(std::uint64_t offset, std::span<std::byte> bytes) const {
    while (!bytes.empty()) {
      const ssize_t count = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) throw InputError(path_.string(), cannotRead, startAnew);
      bytes = bytes.subspan(static_cast<std::size_t>(count));
      offset += static_cast<std::uint64_t>(count);
    }
  }

  /// Cuts off bytes that no commit has made part of the state.
  void cut(std::uint64_t size) noexcept {
    if (descriptor_ >= 0 && ::ftruncate(descriptor_, static_cast<off_t>(size)) != 0) errno = 0;
  }

  std::uint64_t size() const {
    struct stat status {};
    return ::fstat(descriptor_, &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
  }

  bool inPlace() const { return !pending_; }

  /// Returns true if somebody has deleted the file or replaced it.
  bool isGone() const {
    struct stat own {};
    return !pending_ && (::fstat(descriptor_, &own) != 0 || own.st_nlink == 0);
  }

  /// Moves the file to its path. `replaced`: this process's own file there, or nullptr. Throws if another
  /// process is continuing the file there.
  void moveIn(const File* replaced) {
    if (!pending_) return;
    if ((replaced == nullptr || replaced->isGone()) && isLockedByAnother(path_))
      throw Error(ExitCode::RuntimeFailure, path_.string(), heldByAnother,
                  "wait for that run, or write to another file");
    // Locked before anybody can find it.
    const int descriptor = pending_->openAgain();
    lockFile(descriptor);
    try {
      pending_->close();
      pending_->moveIn();
    } catch (...) {
      ::close(descriptor);
      throw;
    }
    pending_.reset();
    descriptor_ = descriptor;
  }

  /// Opens a file, and locks it if it is to be continued. Returns nullptr if there is none.
  static std::unique_ptr<File> open(const fs::path& path, Access access) {
    for (;;) {
      std::error_code ignored;
      if (!fs::exists(path, ignored)) return nullptr;
      refuseSpecialFile(path);
      const int flags = (access == Access::Read ? O_RDONLY : O_RDWR) | O_CLOEXEC;
      const int descriptor = ::open(path.c_str(), flags);
      if (descriptor < 0) throw InputError(path.string(), cannotRead, startAnew);
      auto file = std::make_unique<File>(path, descriptor);
      if (access == Access::Read) return file;
      if (!lockFile(descriptor))
        throw UsageError(path.string(), heldByAnother, "wait for that run, or end it");
      // The run that had the lock may have replaced or removed the file meanwhile.
      if (!file->isGone()) return file;
    }
  }

 private:
  fs::path path_;
  std::optional<PendingFile> pending_;
  int descriptor_ = -1;
};

std::uint64_t StateLog::Contents::liveBytes() const {
  std::uint64_t sum = 0;
  for (const auto& [name, place] : records) sum += place.bytes;
  for (const auto& [name, array] : arrays)
    for (const Place& chunk : array.chunks) sum += chunk.bytes;
  return sum;
}

StateLog::StateLog(fs::path path, std::string kind, StateKey key)
    : path_(std::move(path)), kind_(std::move(kind)), key_(std::move(key)) {}
StateLog::StateLog(StateLog&&) noexcept = default;
StateLog::~StateLog() = default;

fs::path stateFileOf(const fs::path& output) {
  fs::path path = output;
  path += ".state";
  return path;
}

std::optional<StateLog> StateLog::open(const fs::path& path, const std::string& kind, const StateKey& key,
                                       Access access) {
  std::optional<StateLog> log = openAny(path, access);
  if (!log) return log;
  if (log->kind_ != kind)
    throw InputError(path.string(),
                     fmt::format("got the state of a {}, expected that of a {}", log->kind_, kind),
                     startAnew);
  if (log->key_ != key)
    throw UsageError(path.string(),
                     fmt::format("it was left by a run with another {}", differencesOf(log->key_, key)),
                     "use the options of the interrupted run, or delete it to start anew");
  return log;
}

std::optional<StateLog> StateLog::openAny(const fs::path& path, Access access) {
  std::unique_ptr<File> file = File::open(path, access);
  if (!file) return std::nullopt;
  StateLog log(path, {}, {});
  log.file_ = std::move(file);
  const std::uint64_t size = log.file_->size();
  Preamble preamble;
  if (size >= sizeof preamble) log.file_->read(0, std::as_writable_bytes(std::span(&preamble, 1)));
  if (preamble.magic != magic)
    throw InputError(path.string(), "is not a state of an interrupted run", startAnew);
  if (preamble.version != version)
    throw InputError(path.string(),
                     fmt::format("got a state of version {}, expected {}", preamble.version, version),
                     startAnew);
  std::array<Slot, 2> slots;
  log.headerBytes_ = sizeof preamble + preamble.titleBytes + sizeof slots;
  if (log.headerBytes_ > size) log.damaged();
  std::vector<std::byte> title(preamble.titleBytes);
  log.file_->read(sizeof preamble, title);
  if (hashOf(title) != preamble.titleHash) log.damaged();
  log.file_->read(sizeof preamble + title.size(), std::as_writable_bytes(std::span(slots)));
  StateReader reader(path, std::move(title));
  readTitleBytes(reader, log.kind_, log.key_);
  // A power failure may have destroyed the end of the last commit's data: the one before it counts then.
  if (slots[0].sequence < slots[1].sequence) std::swap(slots[0], slots[1]);
  for (const Slot& slot : slots)
    if (slot.sequence > 0 && slot.check == slot.rightCheck() && slot.end <= size && log.scan(slot))
      return log;
  log.damaged();
}

/// Reads all bytes that a commit used, so that damage is not found halfway through the work. Returns false if
/// there is any.
bool StateLog::scan(const Slot& slot) {
  contents_ = Contents();
  contents_.end = headerBytes_;
  std::vector<std::byte> piece;
  while (contents_.end < slot.end) {
    Head head;
    if (slot.end - contents_.end < sizeof head) return false;
    file_->read(contents_.end, std::as_writable_bytes(std::span(&head, 1)));
    const std::uint64_t left = slot.end - contents_.end - sizeof head;
    if (head.nameBytes > longestName || head.nameBytes > left || head.payloadBytes > left - head.nameBytes)
      return false;
    std::string name(head.nameBytes, '\0');
    file_->read(contents_.end + sizeof head, std::as_writable_bytes(std::span(name)));
    const Place place{contents_.end + sizeof head + head.nameBytes, head.payloadBytes};
    PayloadChecksum checksum;
    std::array<std::byte, sizeof(ArrayHead)> arrayHead{};
    forPieces(place.bytes, 1, [&](std::uint64_t first, std::uint64_t count) {
      piece.resize(count);
      file_->read(place.offset + first, piece);
      checksum.add(piece);
      if (first == 0) std::copy_n(piece.begin(), std::min(piece.size(), arrayHead.size()), arrayHead.begin());
    });
    if (checksum.result() != head.payloadHash || StateHash().text(name).result() != head.nameHash)
      return false;
    contents_.chain = StateHash().value(contents_.chain).bytes(bytesOf(head)).result();
    contents_.end = place.offset + place.bytes;
    if (!take(head.kind, name, place, arrayHead.data())) return false;
  }
  if (contents_.chain != slot.chain) return false;
  contents_.sequence = slot.sequence;
  std::memcpy(&contents_.seconds, &slot.seconds, sizeof contents_.seconds);
  committed_ = contents_;
  return true;
}

void StateLog::damaged() const {
  throw InputError(path_.string(), "the state of the interrupted run is damaged", startAnew);
}

/// Enters a record under its name. `arrayHead`: its first bytes. Returns false if it cannot be one.
bool StateLog::take(Kind kind, const std::string& name, const Place& place, const std::byte* arrayHead) {
  const auto eraseFrom = [&](auto& map) {
    for (auto at = map.lower_bound(name); at != map.end() && at->first.starts_with(name);) at = map.erase(at);
  };
  if (kind == Kind::Record) {
    contents_.records[name] = place;
  } else if (kind == Kind::Erased) {
    eraseFrom(contents_.records);
    eraseFrom(contents_.arrays);
  } else {
    ArrayHead head;
    if (kind != Kind::Array || place.bytes < sizeof head) return false;
    std::memcpy(&head, arrayHead, sizeof head);
    Array& array = contents_.arrays[name];
    if (head.first == 0) array = {head.epoch, 0, head.elementSize, {}};
    const std::uint64_t bytes = place.bytes - sizeof head;
    if (head.epoch != array.epoch || head.first != array.count || head.elementSize != array.elementSize ||
        head.elementSize == 0 || bytes / head.elementSize != head.count || bytes % head.elementSize != 0)
      return false;
    array.count += head.count;
    array.chunks.push_back({place.offset + sizeof head, bytes});
  }
  return true;
}

std::vector<std::string> StateLog::names() const {
  std::vector<std::string> names;
  for (const auto& [name, place] : contents_.records) names.push_back(name);
  return names;
}

std::vector<StateLog::ArrayShape> StateLog::arrays() const {
  std::vector<ArrayShape> shapes;
  for (const auto& [name, array] : contents_.arrays)
    shapes.push_back({name, array.epoch, array.count, static_cast<std::size_t>(array.elementSize)});
  return shapes;
}

bool StateLog::hasAny(std::string_view prefix) const {
  const auto any = [&](const auto& map) {
    const auto at = map.lower_bound(prefix);
    return at != map.end() && at->first.starts_with(prefix);
  };
  return any(contents_.records) || any(contents_.arrays);
}

std::vector<std::byte> StateLog::read(const std::string& name) const {
  const Place& place = contents_.records.at(name);
  std::vector<std::byte> bytes(place.bytes);
  file_->read(place.offset, bytes);
  return bytes;
}

/// Makes sure that the file exists and ends with the contents.
void StateLog::begin() {
  if (file_) return;
  file_ = std::make_unique<File>(path_);
  const std::vector<std::byte> title = titleBytes(kind_, key_);
  const Preamble preamble{magic, version, static_cast<std::uint32_t>(title.size()), hashOf(title)};
  file_->write(0, bytesOf(preamble));
  file_->write(sizeof preamble, title);
  const std::array<std::byte, 2 * sizeof(Slot)> slots{};
  file_->write(sizeof preamble + title.size(), slots);
  contents_ = Contents();
  contents_.end = headerBytes_ = sizeof preamble + title.size() + slots.size();
}

void StateLog::append(Kind kind, const std::string& name,
                      const std::function<void(const StateWriter::Sink& sink)>& fill) {
  begin();
  Head head;
  head.nameHash = StateHash().text(name).result();
  head.nameBytes = static_cast<std::uint32_t>(name.size());
  head.kind = kind;
  const std::uint64_t payload = contents_.end + sizeof head + name.size();
  PayloadChecksum checksum;
  std::array<std::byte, sizeof(ArrayHead)> first{};
  std::vector<std::byte> piece;
  const auto flush = [&] {
    if (piece.empty()) return;
    if (head.payloadBytes == 0)
      std::copy_n(piece.begin(), std::min(piece.size(), first.size()), first.begin());
    checksum.add(piece);
    file_->write(payload + head.payloadBytes, piece);
    head.payloadBytes += piece.size();
    piece.clear();
  };
  constexpr std::size_t pieceBytes = std::size_t{1} << 22;
  fill([&](std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      const std::size_t count = std::min(bytes.size(), pieceBytes - piece.size());
      piece.insert(piece.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
      bytes = bytes.subspan(count);
      if (piece.size() == pieceBytes) flush();
    }
  });
  flush();
  head.payloadHash = checksum.result();
  file_->write(contents_.end + sizeof head, std::as_bytes(std::span(name)));
  file_->write(contents_.end, bytesOf(head));
  contents_.chain = StateHash().value(contents_.chain).bytes(bytesOf(head)).result();
  contents_.end = payload + head.payloadBytes;
  take(kind, name, {payload, head.payloadBytes}, first.data());
}

void StateLog::write(const std::string& name,
                     const std::function<void(const StateWriter::Sink& sink)>& fill) {
  append(Kind::Record, name, fill);
}

void StateLog::writeArray(const std::string& name, std::uint64_t epoch, std::uint64_t count,
                          std::size_t elementSize, const ReadElements& read) {
  const auto known = contents_.arrays.find(name);
  const bool goesOn = known != contents_.arrays.end() && known->second.epoch == epoch &&
                      known->second.elementSize == elementSize && known->second.count <= count;
  const std::uint64_t first = goesOn ? known->second.count : 0;
  if (goesOn && first == count) return;
  append(Kind::Array, name, [&](const StateWriter::Sink& sink) {
    sink(bytesOf(ArrayHead{epoch, first, count - first, elementSize}));
    forPieces(count - first, elementSize,
              [&](std::uint64_t at, std::uint64_t some) { sink(read(first + at, some)); });
  });
}

bool StateLog::hasArray(const std::string& name, std::uint64_t epoch, std::uint64_t count,
                        std::size_t elementSize) const {
  const auto found = contents_.arrays.find(name);
  return found != contents_.arrays.end() && found->second.epoch == epoch && found->second.count == count &&
         found->second.elementSize == elementSize;
}

bool StateLog::readArray(const std::string& name, std::uint64_t count, std::size_t elementSize,
                         const WriteElements& write) const {
  const auto found = contents_.arrays.find(name);
  if (found == contents_.arrays.end()) return count == 0;
  const Array& array = found->second;
  if (array.count != count || array.elementSize != elementSize) return false;
  std::uint64_t first = 0;
  std::vector<std::byte> piece;
  for (const Place& chunk : array.chunks)
    forPieces(chunk.bytes / elementSize, elementSize, [&](std::uint64_t at, std::uint64_t some) {
      piece.resize(some * elementSize);
      file_->read(chunk.offset + at * elementSize, piece);
      write(first, piece);
      first += some;
    });
  return true;
}

void StateLog::erase(const std::string& prefix) {
  if (hasAny(prefix)) append(Kind::Erased, prefix, [](const StateWriter::Sink&) {});
}

void StateLog::commit(double seconds) {
  begin();
  const std::uint64_t live = contents_.liveBytes();
  const bool wasteful = contents_.end > 2 * live + toleratedWaste;
  if (file_->isGone() || wasteful) compact();
  contents_.seconds = seconds;
  ++contents_.sequence;
  writeSlot();
  file_->moveIn(older_.get());
  older_.reset();
  committed_ = contents_;
}

void StateLog::writeSlot() {
  Slot slot{contents_.sequence, contents_.end, contents_.chain, 0, 0};
  std::memcpy(&slot.seconds, &contents_.seconds, sizeof slot.seconds);
  slot.check = slot.rightCheck();
  file_->write(headerBytes_ - (slot.sequence % 2 + 1) * sizeof slot, bytesOf(slot));
}

/// Copies the used bytes to a new file.
void StateLog::compact() {
  StateLog fresh(path_, kind_, key_);
  const auto copy = [&](const Place& place, const StateWriter::Sink& sink) {
    forPieces(place.bytes, 1, [&](std::uint64_t first, std::uint64_t count) {
      std::vector<std::byte> piece(count);
      file_->read(place.offset + first, piece);
      sink(piece);
    });
  };
  fresh.begin();
  for (const auto& record : contents_.records)
    fresh.append(Kind::Record, record.first,
                 [&](const StateWriter::Sink& sink) { copy(record.second, sink); });
  for (const auto& array : contents_.arrays)
    fresh.append(Kind::Array, array.first, [&](const StateWriter::Sink& sink) {
      const auto& kept = array.second;
      sink(bytesOf(ArrayHead{kept.epoch, 0, kept.count, kept.elementSize}));
      for (const Place& chunk : kept.chunks) copy(chunk, sink);
    });
  fresh.contents_.sequence = contents_.sequence;
  older_ = std::exchange(file_, std::move(fresh.file_));
  contents_ = std::move(fresh.contents_);
}

void StateLog::rollBack() noexcept {
  if (file_ && !file_->inPlace()) file_ = std::move(older_);
  if (!file_) committed_ = Contents();
  contents_ = committed_;
  if (file_) file_->cut(committed_.end);
}

}  // namespace prelight
