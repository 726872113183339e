#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "cli/options/bake_options.h"
#include "cli/session.h"

namespace prelight::cli {

/// Returns a command's report as JSON: the command's name, the version and the commit, then `contents`.
nlohmann::ordered_json reportOf(const std::string& command,
                                nlohmann::ordered_json::initializer_list_t contents);

nlohmann::ordered_json toJson(const DeviceInfo& device);
nlohmann::ordered_json toJson(const BakeRequest& request);
nlohmann::ordered_json toJson(const StageTimes& times);

/// Returns the report of a bake for --report and --json.
nlohmann::ordered_json bakeReport(const std::string& command, const LoadedScene& loaded,
                                  const std::filesystem::path& output, const BakeRequest& request,
                                  const BakeRun& run, Session& session);

/// Prints a bake's report for people, in a few lines.
void printBakeSummary(const Console& console, const BakeRequest& request, const BakeRun& run,
                      const StageTimes& times);

/// Returns a text such as "5 meshes, 9.8 k triangles, ...".
std::string sceneText(const LoadedScene& loaded);

/// Prints the passes of a picture that are skipped, with reasons, and with --verbose all passes.
void printPasses(const Console& console, std::span<const PlannedPass> passes);

/// Prints "passes that run; skipped: PASS (why)", with --verbose one line per pass.
void printPlan(const Console& console, const Plan& plan);

}  // namespace prelight::cli
