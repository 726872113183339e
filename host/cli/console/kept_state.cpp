#include "cli/console/kept_state.h"

#include <fmt/format.h>

#include <cstdlib>

namespace prelight::cli {
namespace {

/// Returns the seconds between two states. Tests set them by an environment variable, so that short work has
/// states, too.
double stateInterval() {
  const char* text = std::getenv("PRELIGHT_STATE_SECONDS");
  if (text == nullptr) return usualStateInterval;
  char* end = nullptr;
  const double seconds = std::strtod(text, &end);
  return end != text && seconds >= 0.0 && seconds <= usualStateInterval ? seconds : usualStateInterval;
}

}  // namespace

KeptState::KeptState(const std::filesystem::path& output, const std::string& kind, bool resume,
                     const Console& console, StopSignals& signals)
    : run_(stateFileOf(output), kind, stateInterval(), [this] { tellOfSave(); }),
      kind_(kind),
      resume_(resume),
      console_(console),
      signals_(signals) {}

Progress& KeptState::begin(const StateKey& key, Progress& outer) {
  progress_ = &run_.begin(key, outer, resume_);
  if (resume_)
    console_.note(run_.goesOn() ? fmt::format("continuing {}", run_.path().string())
                                : fmt::format("--resume: there is no {}; starting from the beginning",
                                              run_.path().string()));
  if (run_.goesOn()) signals_.setParting(message());
  return *progress_;
}

void KeptState::tellOfSave() {
  const std::string failure = run_.failure();
  const bool warns = !failure.empty() && !warned_ && !signals_.stopRequested();
  warned_ = !failure.empty();
  if (warns) console_.warn({fmt::format("the state of the {} cannot be kept: {}", kind_, failure)});
  signals_.setParting(message());
}

void KeptState::remove() {
  run_.remove();
  signals_.setParting({});
}

std::string KeptState::message() const {
  const std::string failure = run_.failure();
  if (run_.hasState() && failure.empty())
    return fmt::format("interrupted; {} holds the finished part, continue it with --resume",
                       run_.path().string());
  if (run_.hasState())
    return fmt::format("interrupted; {} holds an earlier state ({}), continue it with --resume",
                       run_.path().string(), failure);
  if (!failure.empty()) return "interrupted; the finished part is lost: " + failure;
  return "interrupted; no output was written";
}

}  // namespace prelight::cli
