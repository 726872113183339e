#pragma once

#include "cli/session.h"

namespace prelight::cli {

/// Warns of a file whose scene is no longer what was baked.
void warnOfStaleBake(Session& session, const LoadedScene& loaded);

/// Throws InputError for such a file; `otherwise` says how to go on nevertheless.
void refuseStaleBake(const LoadedScene& loaded, const std::string& otherwise);

}  // namespace prelight::cli
