#include "cli/bake_state.h"

#include <fmt/format.h>

namespace prelight::cli {

BakeStateFile::BakeStateFile(const std::filesystem::path& output, bool resume, const Console& console,
                             StopSignals& signals)
    : file_(stateFileOf(output)), resume_(resume), console_(console), signals_(signals) {}

std::optional<StateReader> BakeStateFile::load() {
  if (!resume_) return std::nullopt;
  std::optional<StateReader> state = file_.load();
  console_.note(
      state ? fmt::format("going on with {}", file_.path().string())
            : fmt::format("--resume: there is no {}; starting from the beginning", file_.path().string()));
  return state;
}

void BakeStateFile::save(const std::function<void(StateWriter&)>& write) {
  const StopSignals::Writing writing(signals_);
  const bool failedBefore = !file_.failure().empty();
  file_.save(write);
  saved_ = saved_ || file_.failure().empty();
  if (!file_.failure().empty() && !failedBefore && !signals_.stopRequested())
    console_.warn({fmt::format("the state of the bake cannot be kept: {}", file_.failure())});
}

std::string BakeStateFile::message() const {
  if (saved_ && file_.failure().empty())
    return fmt::format("interrupted; {} holds what is done, go on with --resume", file_.path().string());
  if (saved_)
    return fmt::format("interrupted; {} holds what was done a while ago ({}), go on with --resume",
                       file_.path().string(), file_.failure());
  if (!file_.failure().empty()) return "interrupted; what is done is lost: " + file_.failure();
  return "interrupted; no output was written";
}

}  // namespace prelight::cli
