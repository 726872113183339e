#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "prelight/bake.h"
#include "viewer/core/render_options.h"

namespace prelight::viewer {

/// Reads "NAME=S" or "NAME=R,G,B", factors >= 0. The last = counts, so that a name may hold one. Throws
/// UsageError that says what is wrong and shows an example.
GroupFactor parseGroupFactor(std::string_view text);

/// Factors of all groups, [group]; of several for one name the last counts. Throws UsageError that lists the
/// groups for a name that none of them has.
std::vector<glm::vec3> groupFactors(std::span<const std::string> groups, std::span<const GroupFactor> asked);

std::vector<std::string> namesOf(const LightGroupTransfer& transfer);

}  // namespace prelight::viewer
