#include "pictures/session/stale_bake.h"

#include <fmt/format.h>

namespace prelight::pictures {
namespace {

BakedScene bakedScene(const LoadedScene& loaded, const Bake& bake) {
  return {*loaded.document, loaded.scene, loaded.compiled, bake};
}

}  // namespace

void warnOfStaleBake(DrawingSession& session, const LoadedScene& loaded, const Bake& bake) {
  if (const auto change = changedSinceBake(bakedScene(loaded, bake)))
    session.warn(fmt::format("{}: {}; bake it again", loaded.path.string(), textOf(*change)));
}

void refuseStaleBake(const LoadedScene& loaded, const Bake& bake, const BakeSubject& used,
                     const std::string& otherwise) {
  if (const auto change = changedSinceBake(bakedScene(loaded, bake), used))
    throw InputError(loaded.path.string(), textOf(*change), "bake it again, or " + otherwise);
}

}  // namespace prelight::pictures
