#pragma once

#include "cli/session.h"
#include "io/scene_fingerprint.h"

namespace prelight::cli {

/// Warns of a file whose scene is no longer what was baked.
void warnOfStaleBake(Session& session, const LoadedScene& loaded, const Bake& bake);

/// Throws InputError where what is `used` of a file's bake no longer fits its scene; `otherwise` says how to
/// go on nevertheless.
void refuseStaleBake(const LoadedScene& loaded, const Bake& bake, const BakeSubject& used,
                     const std::string& otherwise);

}  // namespace prelight::cli
