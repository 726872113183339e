#include "cli/bake_state.h"

#include <fmt/format.h>

#include <new>
#include <system_error>

namespace prelight::cli {

namespace {

constexpr const char* kind = "bake";

}  // namespace

BakeStateFile::BakeStateFile(const std::filesystem::path& output, bool resume, const Console& console,
                             StopSignals& signals)
    : path_(stateFileOf(output)), resume_(resume), console_(console), signals_(signals) {}

std::optional<StateReader> BakeStateFile::load() {
  if (!resume_) return std::nullopt;
  std::optional<StateReader> state = readStateFile(path_, kind, key_);
  console_.note(state ? fmt::format("going on with {}", path_.string())
                      : fmt::format("--resume: there is no {}; starting from the beginning", path_.string()));
  return state;
}

// A full disk or little memory must neither end a bake nor turn an interruption into something else.
void BakeStateFile::save(const std::function<void(StateWriter&)>& write) {
  const StopSignals::Writing writing(signals_);
  const bool failedBefore = !failure_.empty();
  try {
    writeStateFile(path_, kind, key_, write);
    saved_ = true;
    failure_.clear();
    return;
  } catch (const Error& error) {
    failure_ = error.what();
  } catch (const std::bad_alloc&) {
    failure_ = "out of memory";
  }
  if (!failedBefore && !signals_.stopRequested())
    console_.warn({fmt::format("the state of the bake cannot be kept: {}", failure_)});
}

void BakeStateFile::remove() const {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

std::string BakeStateFile::message() const {
  if (saved_ && failure_.empty())
    return fmt::format("interrupted; {} holds what is done, go on with --resume", path_.string());
  if (saved_)
    return fmt::format("interrupted; {} holds what was done a while ago ({}), go on with --resume",
                       path_.string(), failure_);
  if (!failure_.empty()) return "interrupted; what is done is lost: " + failure_;
  return "interrupted; no output was written";
}

}  // namespace prelight::cli
