#include "cli/stale_bake.h"

#include <fmt/format.h>

#include "io/scene_fingerprint.h"

namespace prelight::cli {
namespace {

std::string changeText(const std::string& changed) {
  return fmt::format("the scene's {} changed after it was baked", changed);
}

}  // namespace

void warnOfStaleBake(Session& session, const LoadedScene& loaded) {
  if (const auto changed = changedSinceBake(loaded.document, loaded.scene, loaded.compiled))
    session.warn(fmt::format("{}: {}: what it carries does not fit it; bake it again", loaded.path.string(),
                             changeText(*changed)));
}

void refuseStaleBake(const LoadedScene& loaded, const std::string& otherwise) {
  if (const auto changed = changedSinceBake(loaded.document, loaded.scene, loaded.compiled))
    throw InputError(loaded.path.string(), changeText(*changed), "bake it again, or " + otherwise);
}

}  // namespace prelight::cli
