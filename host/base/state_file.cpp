#include "base/state_file.h"

#include <algorithm>
#include <cmath>

#include "prelight/error.h"

namespace prelight {

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
  state_ ^= state_ >> 32;  // multiplication alone never moves high bits down
}

std::uint64_t StateHash::result() const {
  std::uint64_t x = state_ * 0xbf58476d1ce4e5b9u;
  x ^= x >> 31;
  x *= 0x94d049bb133111ebu;
  return x ^ (x >> 29);
}

void StateWriter::bytes(std::span<const std::byte> data) {
  if (arraysAlone_) return;
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

void StateWriter::growing(std::uint64_t epoch, std::uint64_t count, std::size_t elementSize,
                          const ReadElements& read) {
  value(count);
  if (arrays_ != nullptr) return arrays_->keep(epoch, count, elementSize, read);
  forPieces(count, elementSize, [&](std::uint64_t first, std::uint64_t some) { bytes(read(first, some)); });
}

std::uint64_t StateReader::grownCount() {
  std::uint64_t count = 0;
  value(count);
  return count;
}

void StateReader::growing(std::uint64_t count, std::size_t elementSize, const WriteElements& write) {
  require(grownCount() == count);
  fetchGrown(count, elementSize, write);
}

void StateReader::fetchGrown(std::uint64_t count, std::size_t elementSize, const WriteElements& write) {
  if (arrays_ != nullptr) return require(arrays_->fetch(count, elementSize, write));
  const std::byte* source = take(count, elementSize);
  forPieces(count, elementSize, [&](std::uint64_t first, std::uint64_t some) {
    write(first, {source + first * elementSize, some * elementSize});
  });
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
  throw InputError(path_.string(), "the state of the interrupted run is damaged", "delete it to start anew");
}

std::string differencesOf(const StateKey& found, const StateKey& expected) {
  std::string names;
  for (std::size_t i = 0; i < expected.size(); ++i)
    if (i >= found.size() || found[i] != expected[i])
      names += (names.empty() ? "" : ", ") + expected[i].first;
  return found.size() > expected.size() && names.empty() ? "version" : names;
}

}  // namespace prelight
