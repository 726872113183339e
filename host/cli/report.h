#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "cli/bake_options.h"
#include "cli/session.h"

namespace prelight::cli {

/// What a command reports as JSON: its name, the version and the commit, then `contents`.
nlohmann::ordered_json reportOf(const std::string& command,
                                nlohmann::ordered_json::initializer_list_t contents);

nlohmann::ordered_json toJson(const DeviceInfo& device);
nlohmann::ordered_json toJson(const BakeRequest& request);
nlohmann::ordered_json toJson(const StageTimes& times);

/// What a bake did, for --report and --json.
nlohmann::ordered_json bakeReport(const std::string& command, const LoadedScene& loaded,
                                  const std::filesystem::path& output, const BakeRequest& request,
                                  const BakeRun& run, Session& session);

/// The same in a few lines for people.
void printBakeSummary(const Console& console, const BakeRequest& request, const BakeRun& run,
                      const StageTimes& times);

/// "5 meshes, 9.8 k triangles, ...".
std::string sceneText(const LoadedScene& loaded);

/// Passes of a picture that are skipped, and why; where details are wanted all of them.
void printPasses(const Console& console, std::span<const PlannedPass> passes);

/// "passes that run; skipped: PASS (why)", a line a pass.
void printPlan(const Console& console, const Plan& plan);

}  // namespace prelight::cli
