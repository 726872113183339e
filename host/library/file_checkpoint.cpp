#include "library/file_checkpoint.h"

#include <new>
#include <system_error>
#include <utility>

#include "prelight/error.h"

namespace prelight {

namespace {

constexpr const char* kind = "bake";

}  // namespace

FileCheckpoint::FileCheckpoint(std::filesystem::path path) : path_(std::move(path)) {}

std::optional<StateReader> FileCheckpoint::load() { return readStateFile(path_, kind, key_); }

void FileCheckpoint::save(const std::function<void(StateWriter&)>& write) {
  try {
    writeStateFile(path_, kind, key_, write);
    failure_.clear();
  } catch (const Error& error) {
    failure_ = error.what();
  } catch (const std::bad_alloc&) {
    failure_ = "out of memory";
  }
}

void FileCheckpoint::remove() const {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace prelight
