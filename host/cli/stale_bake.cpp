#include "cli/stale_bake.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace prelight::cli {
namespace {

BakedScene bakedScene(const LoadedScene& loaded, const Bake& bake) {
  return {loaded.document, loaded.scene, loaded.compiled, bake};
}

/// "a", "a and b", "a, b and c"
std::string listOf(const std::vector<std::string>& names) {
  if (names.size() < 2) return fmt::format("{}", fmt::join(names, ""));
  const std::vector<std::string> first(names.begin(), names.end() - 1);
  return fmt::format("{} and {}", fmt::join(first, ", "), names.back());
}

std::string changeText(const StaleScene& change) {
  return fmt::format("the scene's {} changed after it was baked", listOf(change.parts));
}

std::string staleText(const StaleScene& change) {
  if (change.all) return "what it carries does not fit it";
  return fmt::format("of what it carries, {} {} not fit it", listOf(change.stale),
                     change.stale.size() == 1 ? "does" : "do");
}

}  // namespace

void warnOfStaleBake(Session& session, const LoadedScene& loaded, const Bake& bake) {
  if (const auto change = changedSinceBake(bakedScene(loaded, bake)))
    session.warn(fmt::format("{}: {}: {}; bake it again", loaded.path.string(), changeText(*change),
                             staleText(*change)));
}

void refuseStaleBake(const LoadedScene& loaded, const Bake& bake, const BakeSubject& used,
                     const std::string& otherwise) {
  if (const auto change = changedSinceBake(bakedScene(loaded, bake), used))
    throw InputError(loaded.path.string(), fmt::format("{}: {}", changeText(*change), staleText(*change)),
                     "bake it again, or " + otherwise);
}

}  // namespace prelight::cli
