#include "cli/console/kept_state.h"

#include <fmt/format.h>

#include <cstdlib>
#include <system_error>

#include "prelight/error.h"

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
                     const Division& division, const Console& console, StopSignals& signals)
    : run_(division.slice || division.listsStages ? division.state : stateFileOf(output), kind,
           stateInterval(), [this] { tellOfSave(); }),
      output_(output),
      kind_(kind),
      resume_(resume),
      division_(division),
      console_(console),
      signals_(signals) {
  if (std::error_code ignored; !division.state.empty() && !std::filesystem::exists(division.state, ignored))
    throw InputError(division.state.string(), "there is no such file",
                     "name the state that prelight merge has left");
}

StateUse KeptState::use() const {
  if (division_.slice || division_.listsStages) return StateUse::Read;
  return resume_ || !division_.parts.empty() ? StateUse::Continue : StateUse::Replace;
}

WorkShare* KeptState::makeShare(const StateKey& key) {
  if (division_.slice) return &slice_.emplace(output_, kind_, key, *division_.slice, division_.arguments);
  if (division_.listsStages) return &stages_.emplace();
  if (division_.parts.empty()) return nullptr;
  return &parts_.emplace(division_.parts, kind_, key, division_.anyDevice);
}

Progress& KeptState::begin(const StateKey& key, Progress& outer) {
  progress_ = &run_.begin(key, outer, use(), makeShare(key));
  if (resume_)
    console_.note(run_.goesOn() ? fmt::format("continuing {}", run_.path().string())
                                : fmt::format("--resume: there is no {}; starting from the beginning",
                                              run_.path().string()));
  if (run_.goesOn() || slice_) signals_.setParting(message());
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
  if (slice_)
    return fmt::format(
        "interrupted; {} holds the finished part of the slice, the same command goes on with it",
        output_.string());
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
