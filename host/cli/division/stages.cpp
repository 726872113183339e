#include "cli/division/stages.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "cli/report.h"
#include "prelight/error.h"

namespace prelight::cli {

namespace {

using Json = nlohmann::ordered_json;

void tellSlice(Session& session, const std::string& command, const KeptState& state, const WorkSlice& slice) {
  const SliceChoice& choice = slice.choice();
  session.console().line(
      "slice", fmt::format("{} of {} of the stage {}: {} of its {} pieces{}", choice.index, choice.count,
                           slice.stage(), slice.own(), slice.pieces(),
                           slice.known() > 0 ? fmt::format(", {} of them known before", slice.known()) : ""));
  session.console().line(
      "wrote", fmt::format("{} in {}", slice.path().string(), shortSeconds(session.times().total())));
  Json report = reportOf(command, {{"output", slice.path().string()},
                                   {"slice", {{"index", choice.index}, {"count", choice.count}}},
                                   {"stage", slice.stage()},
                                   {"pieces", slice.pieces()},
                                   {"own", slice.own()},
                                   {"known", slice.known()},
                                   {"from", state.path().string()},
                                   {"seconds", session.times().total()},
                                   {"warnings", session.warnings()}});
  session.console().json(report);
}

/// Throws if no part has been of use: the work has gone past their stage, or has not reached it.
void requireUse(const GivenParts& parts) {
  if (!parts.stages().empty()) return;
  std::set<std::string> stages;
  for (const PartTitle& title : parts.titles()) stages.insert(title.stage);
  throw UsageError(
      "--parts", fmt::format("they are of the stage {}, which is not the next one", fmt::join(stages, ", ")),
      "merge the slices of one stage after the other, into the same output");
}

void tellParts(Session& session, const GivenParts& parts) {
  session.console().line(
      "parts",
      fmt::format("{} pieces of {} files{}", parts.given(), parts.titles().size(),
                  parts.here() > 0 ? fmt::format("; {} that none had were done here", parts.here()) : ""));
}

void tellStageEnd(Session& session, const std::string& command, const KeptState& state, const StageEnd& end) {
  session.progress().clear();
  if (state.slice()) return tellSlice(session, command, state, *state.slice());
  const GivenParts& parts = state.parts().value();
  requireUse(parts);
  tellParts(session, parts);
  session.console().line("wrote", state.path().string());
  session.console().line(
      "next", fmt::format("the stage {}: slices with --from {}, or the rest here with --resume", end.stage,
                          state.path().string()));
  session.console().json(reportOf(command, {{"finished", false},
                                            {"merged", parts.stages()},
                                            {"given", parts.given()},
                                            {"here", parts.here()},
                                            {"next", end.stage},
                                            {"state", state.path().string()},
                                            {"seconds", session.times().total()},
                                            {"warnings", session.warnings()}}));
}

void tellStages(Session& session, const std::string& command, const KeptState& state) {
  session.progress().clear();
  const std::vector<std::string>& stages = state.stages().value().stages();
  Json list = Json::array();
  for (std::size_t i = 0; i < stages.size(); ++i) {
    session.console().line(i == 0 ? "stages" : "", fmt::format("{:2}  {}", i + 1, stages[i]));
    list.push_back({{"stage", stages[i]}});
  }
  session.console().json(reportOf(
      command, {{"stages", list}, {"seconds", session.times().total()}, {"warnings", session.warnings()}}));
}

/// Tells what the end of all work was made of.
void tellWhole(Session& session, const KeptState& state) {
  if (state.slice())
    throw UsageError("--slice", "nothing is left that could be divided",
                     "finish the work on one machine, without --slice");
  if (!state.parts()) return;
  requireUse(*state.parts());
  session.progress().clear();
  tellParts(session, *state.parts());
}

}  // namespace

bool doStages(Session& session, const std::string& command, const KeptState& state,
              const std::function<void()>& work) {
  try {
    work();
  } catch (const StageEnd& end) {
    tellStageEnd(session, command, state, end);
    return false;
  }
  if (state.stages()) {
    tellStages(session, command, state);
    return false;
  }
  tellWhole(session, state);
  return true;
}

}  // namespace prelight::cli
