#pragma once

#include "io/scene_fingerprint.h"
#include "pictures/session/drawing_session.h"

namespace prelight::pictures {

/// Warns of a file whose scene has changed since it was baked.
void warnOfStaleBake(DrawingSession& session, const LoadedScene& loaded, const Bake& bake);

/// Throws InputError if the `used` part of a file's bake no longer fits its scene; `otherwise` says how to go
/// on nevertheless.
void refuseStaleBake(const LoadedScene& loaded, const Bake& bake, const BakeSubject& used,
                     const std::string& otherwise);

}  // namespace prelight::pictures
