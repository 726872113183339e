#include "base/state_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <system_error>

#include "base/pending_file.h"
#include "base/special_file.h"
#include "prelight/error.h"

namespace prelight {

namespace fs = std::filesystem;

namespace {

constexpr std::array<char, 8> magic = {'P', 'R', 'L', 'S', 'T', 'A', 'T', 'E'};
constexpr std::uint32_t version = 2;
constexpr const char* startAnew = "delete it to start anew";

/// Everything before the payload: kind, key, the payload's size and hash.
struct Header {
  std::string kind;
  StateKey key;
  std::uint64_t payloadBytes = 0;
  std::uint64_t payloadHash = 0;
};

void writeText(StateWriter& writer, const std::string& text) {
  writer.values(std::vector<char>(text.begin(), text.end()));
}

std::string readText(StateReader& reader) {
  std::vector<char> text;
  reader.values(text);
  return {text.begin(), text.end()};
}

std::vector<std::byte> headerBytes(const Header& header) {
  StateWriter writer;
  writer.value(magic);
  writer.value(version);
  writeText(writer, header.kind);
  writer.value(static_cast<std::uint32_t>(header.key.size()));
  for (const auto& [name, hash] : header.key) {
    writeText(writer, name);
    writer.value(hash);
  }
  writer.value(header.payloadBytes);
  writer.value(header.payloadHash);
  return {writer.payload().begin(), writer.payload().end()};
}

Header readHeader(const fs::path& path, StateReader& reader) {
  std::array<char, 8> foundMagic{};
  std::uint32_t foundVersion = 0, parts = 0;
  reader.value(foundMagic);
  if (foundMagic != magic) throw InputError(path.string(), "is not a state of an interrupted run", startAnew);
  reader.value(foundVersion);
  if (foundVersion != version)
    throw InputError(path.string(),
                     fmt::format("got a state of version {}, expected {}", foundVersion, version), startAnew);
  Header header;
  header.kind = readText(reader);
  reader.value(parts);
  for (std::uint32_t i = 0; i < parts; ++i) {
    std::string name = readText(reader);
    std::uint64_t hash = 0;
    reader.value(hash);
    header.key.emplace_back(std::move(name), hash);
  }
  reader.value(header.payloadBytes);
  reader.value(header.payloadHash);
  return header;
}

/// Block by block, as it is written.
std::uint64_t hashOf(std::span<const std::byte> payload) {
  StateHash hash;
  for (std::size_t at = 0; at < payload.size(); at += StateWriter::blockSize)
    hash.bytes(payload.subspan(at, std::min(StateWriter::blockSize, payload.size() - at)));
  return hash.result();
}

std::vector<std::byte> readAll(const fs::path& path) {
  refuseSpecialFile(path);
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  std::ifstream file(path, std::ios::binary);
  if (error || !file)
    throw InputError(path.string(), "cannot read the state of the interrupted run", startAnew);
  std::vector<std::byte> bytes(size);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(file.gcount()) != size)
    throw InputError(path.string(), "cannot read the state of the interrupted run", startAnew);
  return bytes;
}

/// "scene, seed": the parts in which the state is another run's.
std::string differences(const StateKey& found, const StateKey& expected) {
  std::string names;
  for (std::size_t i = 0; i < expected.size(); ++i)
    if (i >= found.size() || found[i] != expected[i])
      names += (names.empty() ? "" : ", ") + expected[i].first;
  return found.size() > expected.size() && names.empty() ? "version" : names;
}

}  // namespace

StateHash& StateHash::bytes(std::span<const std::byte> data) {
  word(data.size());
  for (; data.size() >= 8; data = data.subspan(8)) {
    std::uint64_t next = 0;
    std::memcpy(&next, data.data(), 8);
    word(next);
  }
  std::uint64_t last = 0;
  if (!data.empty()) std::memcpy(&last, data.data(), data.size());
  word(last);
  return *this;
}

StateHash& StateHash::text(const std::string& text) { return bytes(std::as_bytes(std::span(text))); }

void StateHash::word(std::uint64_t word) {
  state_ = (state_ ^ word) * 0x100000001b3u;
  state_ ^= state_ >> 32;  // multiplication alone never carries high bits down
}

std::uint64_t StateHash::result() const {
  std::uint64_t x = state_ * 0xbf58476d1ce4e5b9u;
  x ^= x >> 31;
  x *= 0x94d049bb133111ebu;
  return x ^ (x >> 29);
}

void StateWriter::bytes(std::span<const std::byte> data) {
  while (!data.empty()) {
    const std::size_t count = sink_ ? std::min(data.size(), blockSize - bytes_.size()) : data.size();
    bytes_.insert(bytes_.end(), data.begin(), data.begin() + static_cast<std::ptrdiff_t>(count));
    data = data.subspan(count);
    if (sink_ && bytes_.size() == blockSize) flush();
  }
}

void StateWriter::flush() {
  if (!sink_ || bytes_.empty()) return;
  sink_(bytes_);
  bytes_.clear();
}

void StateReader::requireFinite(std::span<const float> numbers) const {
  for (const float number : numbers) require(std::isfinite(number));
}

void StateReader::requireFinite(std::span<const double> numbers) const {
  for (const double number : numbers) require(std::isfinite(number));
}

const std::byte* StateReader::take(std::uint64_t count, std::size_t size) {
  if (count > (payload_.size() - at_) / size) damaged();
  const std::byte* data = payload_.data() + at_;
  at_ += count * size;
  return data;
}

void StateReader::damaged() const {
  throw InputError(path_.string(), "the state of the interrupted run is damaged", startAnew);
}

fs::path stateFileOf(const fs::path& output) {
  fs::path path = output;
  path += ".state";
  return path;
}

void writeStateFile(const fs::path& path, const std::string& kind, const StateKey& key,
                    const std::function<void(StateWriter&)>& write) {
  constexpr mode_t ownerOnly = 0600;
  PendingFile file(path, ownerOnly);
  Header header{kind, key, 0, 0};
  file.write(headerBytes(header));
  StateHash hash;
  StateWriter writer([&](std::span<const std::byte> block) {
    hash.bytes(block);
    header.payloadBytes += block.size();
    file.write(block);
  });
  write(writer);
  writer.flush();
  header.payloadHash = hash.result();
  file.overwrite(0, headerBytes(header));
  file.close();
  file.moveIn();
}

void writeStateFile(const fs::path& path, const std::string& kind, const StateKey& key,
                    std::span<const std::byte> payload) {
  writeStateFile(path, kind, key, [&](StateWriter& writer) { writer.bytes(payload); });
}

std::optional<StateReader> readStateFile(const fs::path& path, const std::string& kind, const StateKey& key) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return std::nullopt;
  StateReader reader(path, readAll(path));
  const Header header = readHeader(path, reader);
  if (reader.rest().size() != header.payloadBytes || hashOf(reader.rest()) != header.payloadHash)
    reader.damaged();
  if (header.kind != kind)
    throw InputError(path.string(), fmt::format("got the state of a {}, expected of a {}", header.kind, kind),
                     startAnew);
  if (header.key != key)
    throw UsageError(path.string(),
                     fmt::format("it was left by a run with another {}", differences(header.key, key)),
                     "ask for what the interrupted run was asked for, or delete it to start anew");
  return reader;
}

}  // namespace prelight
