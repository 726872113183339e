#include "cli/bake_state.h"

#include <fmt/format.h>

#include <system_error>

namespace prelight::cli {

namespace {

constexpr const char* kind = "bake";

}  // namespace

BakeStateFile::BakeStateFile(const std::filesystem::path& output, bool resume, const Console& console)
    : path_(stateFileOf(output)), resume_(resume), console_(console) {}

std::optional<StateReader> BakeStateFile::load() {
  if (!resume_) return std::nullopt;
  std::optional<StateReader> state = readStateFile(path_, kind, key_);
  console_.note(state ? fmt::format("going on with {}", path_.string())
                      : fmt::format("--resume: there is no {}; starting from the beginning", path_.string()));
  return state;
}

// The bake is being interrupted: a full disk must not turn that into something else.
void BakeStateFile::save(std::span<const std::byte> payload) {
  try {
    writeStateFile(path_, kind, key_, payload);
    saved_ = true;
  } catch (const Error& error) {
    failure_ = error.what();
  }
}

void BakeStateFile::remove() const {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

std::string BakeStateFile::message() const {
  if (saved_) return fmt::format("interrupted; {} holds what is done, go on with --resume", path_.string());
  if (!failure_.empty()) return "interrupted; what is done is lost: " + failure_;
  return "interrupted; no output was written";
}

}  // namespace prelight::cli
